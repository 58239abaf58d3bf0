"""Gravity twice: what pulls at the blocks, and the unit in which records and PGA are stated."""

GRAVITY_M_S2 = 9.81
STANDARD_GRAVITY_M_S2 = 9.80665
