"""Brick buildings: plan, running bond, timber floors, and the scene made of them."""
