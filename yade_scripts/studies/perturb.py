"""Perturbed ensembles: their members, where they are needed, and at which intensities.

Pure functions; `run_ensemble` runs what they ask for. Near collapse, and with
floor motions that differ up the height, a relative change of amplitude of one
millionth can decide between a third of the thickness and overturning. There one
history says little; the share of slightly perturbed runs that collapse does.
"""

import itertools
import math
from dataclasses import dataclass

import numpy as np

from yade_scripts.studies.intensities import DIGITS

NODE_KEYS = ("nodes_thickness", "nodes_height", "nodes_per_block")
STEP_SPREAD = 0.1  # members step at 0.9 to 1 of the stated step: never beyond the critical one
NODE_CHOICES = 3  # members use the stated number of nodes, or one or two more
NEAR_COLLAPSE = 0.5  # share of the collapse intensity from which sensitivity is measured
FINE = 0.2  # of the window of an ensemble: distance between its amplitudes where outcomes change


@dataclass(frozen=True)
class Member:
    """One perturbed run: factors on amplitude and step, and nodes added along each edge."""

    number: int
    amplitude_factor: float
    step_factor: float = 1.0
    extra_nodes: int = 0


def draw_members(settings):
    """Members of an ensemble, from the stated seed.

    Amplitude factors are uniform in 1 ± amplitude_spread, step factors uniform in
    0.9 to 1, added nodes 0, 1 or 2; what `perturb` does not name stays as it is.
    An ensemble of more members begins with the members of a smaller one.

    Parameters
    ----------
    settings : dict
        Section ensemble: members, amplitude_spread, seed, perturb.

    Returns
    -------
    list of Member
    """
    u = np.random.default_rng(settings["seed"]).random((settings["members"], 3))
    spread, vary = settings["amplitude_spread"], settings["perturb"]
    return [
        Member(
            number + 1,
            1.0 + spread * (2.0 * float(a) - 1.0) if "amplitude" in vary else 1.0,
            1.0 - STEP_SPREAD * float(s) if "step" in vary else 1.0,
            int(NODE_CHOICES * n) if "nodes" in vary else 0,
        )
        for number, (a, s, n) in enumerate(u)
    ]


def perturbed_numerics(numerics, member):
    """Section numerics of a member: its step and its nodes; what a model has none of stays null."""
    out = dict(numerics)
    for key in (key for key in NODE_KEYS if numerics[key] is not None):
        out[key] = numerics[key] + member.extra_nodes
    for key in (key for key in ("step_fraction", "step_s") if numerics[key] is not None):
        out[key] = numerics[key] * member.step_factor
    return out


def sensitivity(value, perturbed):
    """Change of peak d/b under a perturbation; overturned runs count as 1, failed ones NaN."""
    return abs(min(perturbed, 1.0) - min(value, 1.0))


def probe_intensities(curve):
    """Intensities of a curve whose sensitivity is measured [g]: near its first collapse.

    From NEAR_COLLAPSE of the first collapse up to it; without a collapse, all. Within
    that range sensitivity does not grow steadily: an intensity that repeats may lie
    above one that does not, so none is left out.

    Parameters
    ----------
    curve : dict of float to str
        Status by PGA.
    """
    first = min((g for g, s in curve.items() if s == "overturned"), default=float("inf"))
    lowest = NEAR_COLLAPSE * first if first < float("inf") else 0.0
    return sorted(g for g, s in curve.items() if s != "failed" and lowest <= g <= first)


def next_amplitude(outcomes, settings, ida):
    """Next amplitude of a search for the collapse band [g], or None when the band is known.

    From the lowest collapse on, gaps wider than `search_ratio` are closed up to a factor
    `search_beyond` over the highest amplitude that stood; then neighbours of different outcome are
    halved, the lowest first, down to FINE of the window ± amplitude_spread, and what is left of
    that window about each change is filled as densely. Gaps in which a run failed are left.

    Parameters
    ----------
    outcomes : dict of float to str
        Status by PGA, of everything that was run.
    settings, ida : dict
        Sections ensemble (amplitude_spread) and ida (search_ratio, search_beyond, max_pga_g).
    """
    valid = sorted(g for g, status in outcomes.items() if status != "failed")
    fell = [g for g in valid if outcomes[g] == "overturned"]
    if not fell:
        return None
    spread = settings["amplitude_spread"]
    fine, step = 2.0 * spread * FINE, ida["search_ratio"]
    highest = max([fell[0], *(g for g in valid if outcomes[g] == "ok")])
    top = min(highest * ida["search_beyond"], ida["max_pga_g"])
    pairs = list(itertools.pairwise(valid))
    changes = [(a, b) for a, b in pairs if outcomes[a] != outcomes[b]]
    low, high = 1.0 - spread, 1.0 + spread
    centres = [math.sqrt(a * b) for a, b in changes]
    near = [(a, b) for a, b in pairs if any(b > low * c and a < high * c for c in centres)]
    if valid[-1] < top:
        pairs.append((valid[-1], top))
    above = [(a, b) for a, b in pairs if fell[0] <= a < top]
    for gaps, width in ((above, step), (changes, fine), (near, fine)):
        for a, b in gaps:
            parts = max(2, math.ceil(math.log(b / a) / math.log1p(width))) if gaps is above else 2
            middle = round(a * (b / a) ** (1.0 / parts), DIGITS)
            if b / a > 1.0 + 1.25 * width and a < middle < b and middle not in outcomes:
                return middle
    return None
