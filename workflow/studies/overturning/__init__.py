"""Fell or stood: two natural blocks on a shake table, predicted before their outcome is known.

`geometry` takes from a scanned surface what a block rocks about, `blocks` makes scenes of it,
`table` reads the tests, `predict` runs and writes, `score` sets predictions against outcomes.
"""
