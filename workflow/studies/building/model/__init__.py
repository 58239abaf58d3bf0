"""Bricks of a building on a plan, their joints and floors: plain data, numpy alone."""
