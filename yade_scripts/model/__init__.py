"""Cases and scenes as plain data; nothing here imports YADE.

`models` builds the scene of a case: `facade` of one block with its `return_walls`, `interlocking`
of a wall of bricks, `building.complete` of a whole building. They take blocks, nodes and bars from
`scene` and `bars`; `shape`, `base`, `hinges`, `ties`, `floors`, `panels` and `chain` say what a
façade consists of, `floor_motions` and `motion` what shakes it. `stiffness` assembles M, K and C of
a scene, and the critical step. What differs from one model to another stands in `registry`.
"""
