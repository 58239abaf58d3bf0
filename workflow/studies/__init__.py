"""Studies of the façade, one folder each; README.md says what a folder holds."""
