"""What several studies stand on, and the main job does not.

`fragility`, `hazard`, `rates`, `nrml`, `sufficiency`
    From curves to the annual rate of collapse: a hazard curve and a fit go in, a rate comes out.
`restitution`
    What an impact leaves, of a simulation or of a test.
`drawings`, `frames.smk`
    A model in motion: its frames by YADE, and how they are drawn.
`statements`
    What a published study says beside what a run measured.
"""
