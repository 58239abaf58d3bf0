"""Modal analysis, time histories and drawings of brick buildings."""
