"""Dense searches for weaker mechanisms than a report lists, by PGA, of drawn façades.

Feet every 5 cm, hinges every 10 cm, corners (`weakest_cases`). Pairs of foot and hinge of bending
are searched every 20 cm first, and every 5 and 10 cm about those within a fifth of the least.

    .venv/bin/python workflow/studies/assess/trials/weakest.py --count 150 --seed 1
    .venv/bin/python workflow/studies/assess/trials/weakest.py --first 45 --count 15 --seed 64

Prints a façade a line, with the least ratio of a dense PGA to that of the list, by kind
(overturning, each span, each corner), and at the end those below 0.98.
"""

import argparse
import math
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[4]
OWN = Path(__file__).resolve().parents[1] / "tests"
sys.path[:0] = [str(ROOT), str(ROOT / "workflow"), str(ROOT / "tests" / "cases"), str(OWN)]
FOOT_M, HINGE_M, COARSE_M = 0.05, 0.10, 0.20
ROUNDED_M = 1e-9
NEAR = 1.2  # times the least of the coarse search: searched finely about
WEAKER = 0.98


def bending(family, low, high, next_m, known):
    """Least PGA of bending between two levels that hold [g]: coarse, then fine about the best."""
    next_m -= ROUNDED_M  # a foot at the next level is another kind's

    def pga_g(foot, hinge):
        candidate = family.span(low, float(foot), float(hinge), high)
        return family.slv(candidate) if onset_g(family, candidate) < known else math.inf

    coarse_g = {}
    for foot in np.arange(low, next_m, COARSE_M):
        for hinge in np.arange(foot + 0.1, high - 0.1 + 1e-9, COARSE_M):
            coarse_g[foot, hinge] = pga_g(foot, hinge)
    least = min(coarse_g.values(), default=math.inf)
    if not math.isfinite(least):
        return least
    near = [pair for pair, value in coarse_g.items() if value < NEAR * least]
    for foot, hinge in near:
        for fine_foot in np.arange(foot - COARSE_M / 2, foot + COARSE_M / 2, FOOT_M):
            for at in (hinge - HINGE_M, hinge, hinge + HINGE_M):
                if low <= fine_foot < next_m and fine_foot + 0.1 <= at <= high - 0.1:
                    least = min(least, pga_g(fine_foot, at))
    return least


def dense(family, listed):
    """Least PGA by kind of dense searches [g]."""
    candidates = dense_mechanisms(family, FOOT_M, math.inf)
    least_g = least_by_kind(family, (each for each in candidates if each.held_m is None))
    levels = family.levels()
    for k, low in enumerate(levels[:-1]):
        for high in levels[k + 1 :]:
            kind = f"bending from {low:g} to {high:g}"
            known = listed.get(kind, math.inf)
            least_g[kind] = bending(family, low, high, levels[k + 1], known)
    return least_g


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=150)
    parser.add_argument("--first", type=int, default=0, help="which façade of the seed is first")
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    weaker = tried = 0
    end = given.first + given.count
    for k, drawn in enumerate(several(end, given.seed)[given.first :], given.first):
        resolved = config.resolve(drawn)
        assessment = resolved["assessment"]
        demand = CodeDemand(
            assessment["ag_g"], assessment["f0"], assessment["tc_star_s"], assessment["soil"]
        )
        slv = Slv(resolved, demand)
        family = Family(resolved, slv=slv)
        listed = least_by_kind(family, map(family.at, family.sites()))
        dense_g = dense(family, listed)
        ratios = {
            kind: pga_g / listed.get(kind, math.inf)
            for kind, pga_g in dense_g.items()
            if math.isfinite(pga_g)
        }
        kind = min(ratios, key=ratios.get)
        tried, weaker = tried + 1, weaker + (ratios[kind] < WEAKER)
        print(f"{k}: {ratios[kind]:.4f} of {kind}, {len(ratios)} kinds", flush=True)
    print(f"{weaker} of {tried} façades have a kind below {WEAKER:g} of the list")


if __name__ == "__main__":
    from drawn_facades import several
    from rocking.configuration import config
    from studies.assess.code_spectrum import CodeDemand
    from studies.assess.family import Family
    from studies.assess.slv import Slv
    from weakest_cases import dense_mechanisms, least_by_kind, onset_g

    main()
