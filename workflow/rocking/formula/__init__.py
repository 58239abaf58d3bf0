"""The formula: half collapse of a façade within stated limits, without a history."""
