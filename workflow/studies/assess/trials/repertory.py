"""Dense searches for weaker wedges, horizontal bending and part widths than a report lists.

Of façades drawn at random (`drawn_facades`), with interlocked courses in every second one: crack
angles every 2.5° and feet every 25 cm; of horizontal bending feet every 10 cm, open every tenth of
the span, no nearer to a line than the wall is thick; every pair of lines.

    .venv/bin/python workflow/studies/assess/trials/repertory.py --first 0 --count 50 --seed 71

Prints a façade a line: by kind the least PGA of the dense search over that of the same kind in the
list (of compound overturning over the list's overturning too, since a vertical crack is that), and
at the end how many are below 0.98.
"""

import argparse
import itertools
import math
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[4]
sys.path[:0] = [str(ROOT), str(ROOT / "workflow"), str(ROOT / "tests" / "cases")]
FOOT_M, CRACK_DEG, WEAKER = 0.25, 2.5, 0.98
BENDING_M, SHARE = 0.1, 0.1  # of horizontal bending: feet, and of a span


def feet(last_m, step_m=FOOT_M):
    """Feet of a dense search."""
    return np.arange(0.0, last_m, step_m).tolist()


def whole(family, foot_m, ends):
    """Whether at every height at least half of what lies between two lines is masonry."""
    m = family.masonry
    edges = sorted({foot_m, m.height_m, *(z for z in m.edges_m if foot_m < z < m.height_m)})
    middles = [0.5 * (a + b) for a, b in itertools.pairwise(edges)]
    return all(region.length(m, z, ends) >= 0.5 * (ends[1] - ends[0]) for z in middles)


def dense(family):
    """Least PGA by kind [g]."""
    least_g, last = {}, family.height_m - LEAST_PART_M
    if (steps := repertory.steepest_deg(family)) is not None:
        least_g[COMPOUND] = min(
            family.slv(repertory.compound(family, z, float(deg)))
            for z in feet(last)
            for deg in np.arange(0.0, steps, CRACK_DEG)
        )
    for left, right, top in repertory.supports(family):
        near = min(family.facade.thickness_m, 0.5 * (right - left))
        middles = np.arange(left + near, right - near + 1e-9, SHARE * (right - left)).tolist()
        bending_g = [
            family.slv(repertory.horizontal(family, z, top, (left, x, right)))
            for z in feet(top - LEAST_PART_M, BENDING_M)
            for x in middles
        ]
        least_g[HORIZONTAL] = min([least_g.get(HORIZONTAL, math.inf), *bending_g])
    places, half = partial_width.lines(family), round(0.5 * family.masonry.width_m, 6)
    for ends in itertools.combinations(places, 2):
        if ends == (-half, half) or ends[1] - ends[0] < family.facade.thickness_m:
            continue
        for z in sorted({*family.feet(), *feet(last)}):
            if z < last and whole(family, z, ends):
                pga_g = family.slv(partial_width.part_width(family, z, ends))
                least_g[PART_WIDTH] = min(least_g.get(PART_WIDTH, math.inf), pga_g)
    return least_g


def listed(family):
    """Least PGA by kind of the list [g]; a wedge with a vertical crack is an overturning part."""
    least_g = {}
    for site in family.sites():
        candidate = family.at(site)
        kind = kind_of(candidate)
        least_g[kind] = min(least_g.get(kind, math.inf), family.slv(candidate))
    least_g[COMPOUND] = min(least_g.get(COMPOUND, math.inf), least_g["overturning"])
    return least_g


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--count", type=int, default=50)
    parser.add_argument("--seed", type=int, default=71)
    given = parser.parse_args()
    weaker = {}
    rows = several(given.first + given.count, given.seed)
    for k, drawn in list(enumerate(rows))[given.first :]:
        assessment = drawn["assessment"] | {"mechanisms": [COMPOUND, HORIZONTAL, PART_WIDTH]}
        if k % 2:
            assessment |= {"interlocking_course_m": 0.25, "interlocking_overlap_m": 0.12}
        resolved = config.resolve({**drawn, "assessment": assessment})
        demand = CodeDemand(
            assessment["ag_g"], assessment["f0"], assessment["tc_star_s"], assessment["soil"]
        )
        family = Family(resolved, slv=Slv(resolved, demand))
        listed_g, dense_g = listed(family), dense(family)
        ratios = {kind: v / listed_g.get(kind, math.inf) for kind, v in dense_g.items()}
        for kind, ratio in ratios.items():
            weaker.setdefault(kind, []).append(ratio)
        print(k, " ".join(f"{kind} {ratio:.4f}" for kind, ratio in ratios.items()), flush=True)
    for kind, ratios in weaker.items():
        below = sum(ratio < WEAKER for ratio in ratios)
        print(f"{kind}: {below} of {len(ratios)} below {WEAKER:g} of the list, {min(ratios):.4f}")


if __name__ == "__main__":
    from drawn_facades import several
    from rocking.configuration import config
    from studies.assess import partial_width, region, repertory
    from studies.assess.code_spectrum import CodeDemand
    from studies.assess.family import Family
    from studies.assess.names import COMPOUND, HORIZONTAL, PART_WIDTH, kind_of
    from studies.assess.sites import LEAST_PART_M
    from studies.assess.slv import Slv

    main()
