"""Critical step as it is seen; imported inside YADE's Python."""

from studies.accuracy.yade import stability


def limit(config, name, stiffness_factor, beta_s):
    """Observed over predicted critical step."""
    job = {**config, "beta_s": beta_s}
    scene = stability.scene_of(job, name, stiffness_factor, beta_s)
    return stability.bisect(scene, {}, tolerance=0.03)[0]
