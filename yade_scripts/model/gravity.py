"""Gravity twice: what pulls at the blocks, and the unit in which records and PGA are stated.

Scenes weigh with the study's 9.81 m/s². Everything in g (records, PGA, spectra, and what the codes'
checks compare with them, α g included) is in standard gravity, 0.034 % less. The two meet where a
check's PGA stands beside that of a scene.
"""

GRAVITY_M_S2 = 9.81
STANDARD_GRAVITY_M_S2 = 9.80665
