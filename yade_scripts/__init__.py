"""Scene descriptions and the one adapter that turns them into YADE.

Everything here imports numpy and the standard library alone, because YADE's
own Python has nothing else; only `engine` imports YADE, and only when a run
starts. The workflow's environment imports the same modules for stiffness,
modes and critical steps.
"""
