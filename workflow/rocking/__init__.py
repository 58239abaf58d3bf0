"""Post-processing, records and configuration of the workflow: importable, without rules."""
