"""Compile the step loops ahead of the first run: `python -m rocking.solver`."""

import numpy as np

from rocking.collapse.scan import layouts
from rocking.configuration.config import resolve
from yade_scripts.model.models import build_scene

from . import Motions, moving_supports, peaks, prepare

STILL = np.zeros(3)

for model in ("W2", "W3"):
    config = resolve({})
    numerics = layouts(config["numerics"])[0]
    scene = build_scene({**config, "numerics": numerics, "model": model, "beta_s": 0.0})
    supports = [STILL for _ in moving_supports(scene)]
    peaks(prepare(scene), Motions(np.arange(3.0), STILL, supports), numerics, 1.0, step_s=1e-3)
