"""Risk: hazard curves, the rate at which a façade collapses, fragilities for OpenQuake.

Nothing here runs an analysis: a hazard curve and a fitted fragility go in, a rate comes out.
"""
