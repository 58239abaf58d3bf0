"""One module a study: what is varied, what the collapse intensities are reduced to."""
