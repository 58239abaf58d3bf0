"""Fragility of a run's façade, and the rate of collapse at a site."""
