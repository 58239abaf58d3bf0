"""The published study compared with a run: its claims, and its page row by row."""
