"""Runs side by side: a grid, scenarios, or finished runs by name."""
