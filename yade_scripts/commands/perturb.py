"""Realisations of perturbed ensembles, as pure functions; `ensemble` runs them.

Near collapse, and with floor motions that differ up the height, a relative change of amplitude of
one millionth can decide between a third of the thickness and overturning. There one history says
little; the share of slightly perturbed runs that collapse does.
"""

from dataclasses import dataclass

import numpy as np

NODE_KEYS = ("nodes_thickness", "nodes_height", "nodes_per_block")
STEP_SPREAD = 0.1  # realisations step at 0.9 to 1 of the stated step: never beyond the critical one
NODE_CHOICES = 3  # realisations use the stated number of nodes, or one or two more


@dataclass(frozen=True)
class Realisation:
    """One perturbed run: factors on amplitude and step, and nodes added along each edge."""

    number: int
    amplitude_factor: float
    step_factor: float = 1.0
    extra_nodes: int = 0


ALONE = Realisation(0, 1.0)  # a run as it is


def draw_realisations(settings):
    """`Realisation`s of an ensemble, from the seed of section ensemble.

    Amplitude factors are uniform in 1 ± amplitude_spread, step factors uniform in 0.9 to 1, added
    nodes 0, 1 or 2; what `perturb` does not name stays as it is. An ensemble of more realisations
    begins with the realisations of a smaller one.
    """
    u = np.random.default_rng(settings["seed"]).random((settings["realisations"], 3))
    spread, vary = settings["amplitude_spread"], settings["perturb"]
    return [
        Realisation(
            number + 1,
            1.0 + spread * (2.0 * float(a) - 1.0) if "amplitude" in vary else 1.0,
            1.0 - STEP_SPREAD * float(s) if "step" in vary else 1.0,
            int(NODE_CHOICES * n) if "nodes" in vary else 0,
        )
        for number, (a, s, n) in enumerate(u)
    ]


def perturbed_numerics(numerics, realisation):
    """Section numerics of a realisation: its step and nodes; null stays where a model has none."""
    out = dict(numerics)
    for key in (key for key in NODE_KEYS if numerics[key] is not None):
        out[key] = numerics[key] + realisation.extra_nodes
    for key in (key for key in ("step_fraction", "step_s") if numerics[key] is not None):
        out[key] = numerics[key] * realisation.step_factor
    return out
