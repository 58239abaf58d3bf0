"""Mechanisms beyond overturning over the whole width, bending and corners: `assessment.mechanisms`.

*Compound overturning* takes a wedge of each return wall along, between the façade's back face and a
crack that leaves it at the foot and climbs at an angle from the vertical. Its weight stands farther
back, so that where nothing holds the vertical crack is the weakest: the whole façade. Ties and
anchors hold less of what is heavier, and behind strong ones a slanting crack may be weaker: it is
to be stated, since nothing bounds its angle. Where courses are interlocked their friction fades
with the crack's angle β,

    F(β) = F(0) (1 − tan β/tan β_b), tan β_b = l/h_b

(Casapulla and others, 2021, as Szabó and others, 2023, eq. 2 and 3, quote it: along the units' own
steps no bed joint rubs, and no crack is flatter), with F(0) of C8.7.1.2. Up to there the weakest
angle is looked for.

*Horizontal bending* is `hanging.hanging`: between neighbouring rods of a row of ties, and between
return walls where courses are interlocked with them.

*Part-width overturning* is in `partial_width`.
"""

import itertools
import math

import numpy as np
from rocking.mechanics.blocks import leaned, toppling
from rocking.mechanics.mechanism import gauss

from studies.assess import region
from studies.assess.hanging import Wedge, hanging
from studies.assess.names import COMPOUND, HORIZONTAL, PART_WIDTH
from studies.assess.partial_width import part_width, widths
from studies.assess.sites import LEAST_PART_M, Site
from yade_scripts.model.return_walls import wall_strips
from yade_scripts.model.ties import rods_at

NEAR_M = 1e-6
NEAR_M_FOOT = 0.02  # to which a foot is found
ANGLES = 7  # samples of a crack's angle
FEET = 8  # samples of a foot, beside the heights at which the façade changes
APART_M = 0.5  # samples of the foot of horizontal bending at most
MIDDLES = 5  # places of a span where it may open
VALLEYS = 4  # of these followed
STRIPS = 16  # of a wedge, whose cracks cross openings anywhere
STEEPEST_DEG = 60.0
VERTICAL_DEG = 0.05  # what is no slanting crack
AT_BASE = f"{COMPOUND}_at_base"


def sites(family):
    """`Site`s of the mechanisms that `assessment.mechanisms` names, each where it is weakest."""
    asked, weakest = family.settings["mechanisms"], []
    for kind, rule in ((COMPOUND, compounds), (HORIZONTAL, horizontals), (PART_WIDTH, widths)):
        if kind in asked:
            weakest += rule(family)
    return weakest


def at(family, site):
    """`Candidate` of a `Site` of this module; of one kind the part's name is that of the site."""
    if site.crack_deg is not None:
        candidate = compound(family, site.foot_m, site.crack_deg)
    elif site.middle_m is not None:
        places = site.left_m, site.middle_m, site.right_m
        candidate = horizontal(family, site.foot_m, site.top_m, places)
    else:
        candidate = part_width(family, site.foot_m, (site.left_m, site.right_m))
    return candidate._replace(part=site.part)


def steepest_deg(family):
    """Angle β_b of the units' own steps, beyond which a crack has no friction; None if unknown."""
    course = family.settings["interlocking_course_m"]
    if not course:
        return None
    return math.degrees(math.atan(family.settings["interlocking_overlap_m"] / course))


def wedge_masses(family, foot_m, crack_deg):
    """Wedges of all return walls above a foot: (weight_n, y_m, z_m)."""
    m, tangent = family.masonry, math.tan(math.radians(crack_deg))
    deep = family.wall["count"] * family.wall["thickness_m"] * m.unit_weight
    cuts = sorted({foot_m, m.height_m, *(z for z in m.edges_m if foot_m < z < m.height_m)})
    masses = []
    for low, high in itertools.pairwise(cuts):
        for z in gauss(low, high):
            reach = (z - foot_m) * tangent
            weight = 0.5 * (high - low) * deep * reach
            masses.append((weight, m.faces(z)[0] - 0.5 * reach, z))
    return [row for row in masses if row[0] > 0.0]


def compound(family, foot_m, crack_deg):
    """Overturning of what lies above a foot, with wedges of the return walls; α0 as of `toppling`.

    Of a plain façade of W = γ b h w on walls t_s thick, with the wedges' weight V = γ n t_s h² tan
    β/2: α0 = [W b/2 + V (b + h tan β/3) + F h/3]/(W h/2 + V 2h/3). At β = 0 it is the part above
    that foot, to the digit.
    """
    plain = family.part(foot_m)
    wedge = wedge_masses(family, foot_m, crack_deg)
    about = {"crack_deg": float(crack_deg), "part": COMPOUND}
    if not wedge:
        return plain._replace(**about)
    hinge = (family._edge(foot_m, family.settings["hinge_inset_m"]), foot_m)
    m, steps = family.masonry, steepest_deg(family)
    pulls = [p for p in family.pulls if p.height_m > foot_m + NEAR_M]
    if steps is not None:
        left = 1.0 - math.tan(math.radians(crack_deg)) / math.tan(math.radians(steps))
        held = family._interlocked(foot_m)
        if left > 0.0:
            pulls.append(held._replace(force_n=left * held.force_n))
    loads = [row for row in family.loads if row[2] >= foot_m + (NEAR_M if foot_m else 0.0)]
    pushes = [row for row in family.pushes if row[1] > foot_m + NEAR_M]
    masses = m.masses(foot_m, m.top_m) + wedge
    top, thrusts = (hinge[0], m.top_m), family.thrusting(foot_m)
    mechanism = toppling(COMPOUND, masses, hinge, top, loads, pulls, pushes, thrusts)
    mechanism = leaned(mechanism, family.lean_rad)
    return plain._replace(mechanism=mechanism, **about)


def compounds(family):
    """Compound overturning at its weakest foot and at the base.

    Of the stated angle, or of the weakest where courses are stated; none where that is the vertical
    crack, which the part above that foot is.
    """
    stated, steps = family.settings["crack_deg"], steepest_deg(family)
    if not family.wall["count"] or (stated is None and steps is None):
        return []
    if stated is None:
        angles = np.linspace(0.0, min(steps, STEEPEST_DEG), ANGLES).tolist()
    else:
        angles = [float(stated)]
    last = family.height_m - LEAST_PART_M
    feet = {*np.linspace(0.0, last, FEET).tolist(), *(z for z in family.feet() if z < last)}
    measure = _remembered(family, lambda z, deg: Site("", z, crack_deg=deg))
    rows = [(measure(z, deg), z, deg) for z in sorted(feet) for deg in angles]
    weakest = {COMPOUND: _follow(measure, min(rows), sorted(feet), angles, last)}
    if weakest[COMPOUND][1] > 0.0:
        base = min(row for row in rows if row[1] == 0.0)
        weakest[AT_BASE] = _follow(measure, base, [0.0], angles, 0.0)
    return [
        Site(part, z, crack_deg=deg)
        for part, (_, z, deg) in weakest.items()
        if deg > VERTICAL_DEG or stated is not None
    ]


def _remembered(family, site):
    """What a site of two numbers is ranked by, asked for once."""
    memo: dict[tuple, float] = {}

    def measure(first, second):
        key = round(float(first), 4), round(float(second), 4)
        if key not in memo:
            memo[key] = family.measure(site(float(first), float(second)))
        return memo[key]

    return measure


def _apart(heights, last):
    """Heights and those between them, at most `APART_M` apart."""
    samples = {last}
    for a, b in itertools.pairwise(sorted({*heights, last})):
        samples |= set(np.linspace(a, b, math.ceil((b - a) / APART_M - NEAR_M) + 1)[:-1].tolist())
    return sorted(samples)


def _valleys(values):
    """Places (i, j) of a grid that no neighbour is below, the lowest first.

    Cracks pass openings, rods and floors: what holds and what drives then changes by leaps, and a
    grid has several.
    """
    wide = np.pad(values, 1, constant_values=math.inf)
    about = np.lib.stride_tricks.sliding_window_view(wide, (3, 3)).min(axis=(2, 3))
    places = np.argwhere((values <= about) & np.isfinite(values))
    return sorted(map(tuple, places.tolist()), key=lambda place: values[place])


def _follow(measure, best, firsts, seconds, last):
    """The least (measure, first, second) about the best of a grid, each halved in turn."""
    gaps = [
        max((b - a for a, b in itertools.pairwise(samples)), default=0.0)
        for samples in (firsts, seconds)
    ]
    ends = (0.0, last), (min(seconds), max(seconds))
    fine = NEAR_M_FOOT, 0.01 * (ends[1][1] - ends[1][0])
    while any(gap > max(near, NEAR_M) for gap, near in zip(gaps, fine, strict=True)):
        gaps = [0.5 * gap for gap in gaps]
        for ways in itertools.product((-1.0, 0.0, 1.0), repeat=2):  # what is weakest may lie on an
            place = [  # edge, askew to both, beyond which nothing falls
                min(max(at + way * gap, low), high)
                for at, way, gap, (low, high) in zip(best[1:], ways, gaps, ends, strict=True)
            ]
            best = min(best, (measure(*place), *place))
    return best


def supports(family):
    """Spans between neighbouring lines that hold: (left, right, height up to which they do).

    The rods of a row hold at its height. Return walls whose courses are interlocked with the façade
    hold up to its eaves.
    """
    m, spans = family.masonry, set()
    for row in family.facade.ties:
        places = rods_at(row, m.width_m)
        spans |= {(a, b, row.height_m) for a, b in itertools.pairwise(places)}
    if steepest_deg(family) is not None and family.wall["count"] > 1:
        walls = wall_strips(m.width_m, family.wall)
        spans |= {(a[1], b[0], m.height_m) for a, b in itertools.pairwise(walls)}
    return sorted(row for row in spans if row[1] - row[0] > 2.0 * LEAST_PART_M)


def horizontal(family, foot_m, top_m, places):
    """Horizontal bending between two lines that hold at a height, see `hanging.hanging`.

    `places` are its left end, where it opens, its right end. What stands between these above that
    height goes along. Loads and anchors of floors count by the width that the wedge has at their
    height. Rods at its ends hold it and are not passed; of others those within it pull.
    """
    m, inset = family.masonry, family.settings["hinge_inset_m"]
    edges = [z for z in m.edges_m if foot_m < z < top_m]
    faces = [m.faces(z, above) for z in edges for above in (False, True)]
    backs, fronts = zip(*faces, m.faces(foot_m), m.faces(top_m, above=False), strict=True)
    back, front = max(backs), min(fronts)  # what all of its height has
    left, middle, right = places
    wedge = Wedge(left, middle, right, foot_m, top_m, front - inset, back + inset)
    cuts = np.linspace(foot_m, top_m, STRIPS + 1).tolist()
    masses = region.masses(m, foot_m, m.top_m, lambda z: (wedge.ends(z)[0], places[1]), cuts)
    masses += region.masses(m, foot_m, m.top_m, lambda z: (places[1], wedge.ends(z)[1]), cuts)
    mechanism = hanging(
        HORIZONTAL,
        wedge,
        masses,
        _spread(family, wedge, family.loads),
        _passed(family, wedge),
        1e3 * (family.settings["arch_thrust_kn"] or 0.0),
    )
    candidate = family.between(mechanism, foot_m, top_m, HORIZONTAL, (places[0], places[2]))
    return candidate._replace(middle_m=places[1], top_m=top_m)


def _spread(family, wedge, loads):
    """Loads on a wedge by its width at their heights, at the middle of each body's part."""
    spread = []
    for weight, y, z in loads:
        if z <= wedge.foot_m + NEAR_M:
            continue
        a, b = wedge.ends(z)
        for x0, x1 in ((a, wedge.middle_m), (wedge.middle_m, b)):
            spread.append((weight * (x1 - x0) / family.masonry.width_m, 0.5 * (x0 + x1), y, z))
    return spread


def _passed(family, wedge):
    """What a wedge passes: (force_n, x_m, z_m, slack_m, reach_m)."""
    width, pulls = family.masonry.width_m, []
    rows = family.facade.ties
    ties = family.pulls[: len(rows)]
    for pull, row in zip(ties, rows, strict=True):
        a, b = wedge.ends(pull.height_m)
        for x in rods_at(row, width):
            if pull.height_m > wedge.foot_m and a + NEAR_M < x < b - NEAR_M:
                force = pull.force_n / row.count
                pulls.append((force, x, pull.height_m, pull.slack_m, pull.reach_m))
    for pull in family.pulls[len(ties) :]:
        if pull.height_m > wedge.foot_m + NEAR_M:
            a, b = wedge.ends(pull.height_m)
            for x0, x1 in ((a, wedge.middle_m), (wedge.middle_m, b)):
                force = pull.force_n * (x1 - x0) / width
                row = force, 0.5 * (x0 + x1), pull.height_m, pull.slack_m, pull.reach_m
                pulls.append(row)
    for force, z in family.thrusting(wedge.foot_m):  # by width too, outward
        a, b = wedge.ends(z)
        for x0, x1 in ((a, wedge.middle_m), (wedge.middle_m, b)):
            pulls.append((-force * (x1 - x0) / width, 0.5 * (x0 + x1), z, 0.0, math.inf))
    return [row for row in pulls if row[0]]


def horizontals(family):
    """Horizontal bending of every span between neighbouring lines that hold, the weakest of all.

    It opens no nearer to a line than the wall is thick, as no part of the width is narrower.
    """
    starts = []
    for left, right, top in supports(family):
        last = top - LEAST_PART_M
        if last <= 0.0:
            continue

        def site(foot, middle, left=left, right=right, top=top):
            ends = {"left_m": left, "right_m": right, "middle_m": middle, "top_m": top}
            return Site(HORIZONTAL, foot, **ends)

        near = min(family.facade.thickness_m, 0.5 * (right - left))
        middles = np.unique(np.linspace(left + near, right - near, MIDDLES)).tolist()
        feet = _apart((z for z in family.feet() if z < last), last)
        measure = _remembered(family, site)
        values = np.array([[measure(z, x) for x in middles] for z in feet])
        for i, j in _valleys(values):
            start = float(values[i, j]), feet[i], middles[j]
            starts.append((start, (measure, feet, middles, last, site)))
    followed = []
    for start, about in sorted(starts, key=lambda row: row[0])[:VALLEYS]:
        measure, feet, middles, last, site = about
        pga_g, foot, middle = _follow(measure, start, feet, middles, last)
        followed.append((pga_g, site(foot, middle)))
    return [min(followed, key=lambda row: row[0])[1]] if followed else []
