"""Uncertainty that is not numerical: samples of material and model, and what each part is worth."""
