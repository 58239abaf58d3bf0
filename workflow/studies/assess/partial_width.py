"""Part-width overturning: what lies above a foot between two vertical lines.

Lines are the ends of the façade, edges of openings, and rods. At least half of the part is masonry
at every height, and it is no narrower than it is thick. A rod on a line does not hold it. In a
crack through masonry whose courses are stated their friction holds as in C8.7.1.2 with the façade's
own thickness in place of a return wall's, less what openings take of the crack; else nothing does,
which is on the safe side. Loads and anchors of floors count by width.
"""

import itertools

import numpy as np
from rocking.mechanics.blocks import Held, leaned, toppling

from studies.assess import region
from studies.assess.names import PART_WIDTH
from studies.assess.sites import LEAST_PART_M, Site
from yade_scripts.model.return_walls import wall_strips
from yade_scripts.model.ties import rods_at

NEAR_M = 1e-6
BEST = 4  # pairs of lines a foot that are looked at, by each measure
THIRDS = (1.0 / 3.0, 2.0 / 3.0)  # of the way to the next foot: the best of each measure there
FOLLOWED, BETWEEN = 3, 4  # of these the weakest, and feet tried to the next one that is listed


def lines(family):
    """Places along the façade between which a part of its width may turn, from left to right."""
    half = 0.5 * family.masonry.width_m
    places = {-half, half}
    places |= {x for x0, x1, *_ in family.masonry.shape.openings for x in (x0, x1)}
    for row in family.facade.ties:
        places |= set(rods_at(row, family.masonry.width_m))
    return sorted({round(x, 6) for x in places})


def within(family, left_m, right_m):
    """What holds between two lines, as `Held`: rods strictly inside, anchors of floors by width."""
    width = family.masonry.width_m
    share, pulls = (right_m - left_m) / width, []
    shares = [
        sum(left_m + NEAR_M < x < right_m - NEAR_M for x in rods_at(row, width)) / row.count
        for row in family.facade.ties
    ]
    shares += [share] * (len(family.pulls) - len(shares))
    for pull, part in zip(family.pulls, shares, strict=True):  # in the order of `holds`: ties first
        if part > 0.0:
            pulls.append(pull._replace(force_n=part * pull.force_n))
    return pulls


def _cracks(family, foot_m, ends):
    """Friction of interlocked courses on the sides of a part of the width, as `Held` that fade."""
    settings, m, pulls = family.settings, family.masonry, []
    course, overlap = settings["interlocking_course_m"], settings["interlocking_overlap_m"]
    if not course:
        return []
    walls = wall_strips(m.width_m, family.wall) if family.wall["count"] else []
    inside = sum(ends[0] <= 0.5 * (a + b) <= ends[1] for a, b in walls)
    if inside:
        held = family._interlocked(foot_m)
        pulls.append(held._replace(force_n=held.force_n * inside / len(walls)))
    tall = m.height_m - foot_m
    rough = 0.8 * settings["interlocking_friction"] * overlap / course * m.unit_weight
    rough *= 1.0 + course / tall
    for x in ends:
        if abs(x) < 0.5 * m.width_m - NEAR_M:
            for z, height in region.on_crack(m, x, foot_m, m.height_m):
                back, front = m.faces(z)
                force = rough * (front - back) * (m.height_m - z) * height
                pulls.append(Held(force, z, overlap, True))
    return pulls


def part_width(family, foot_m, ends):
    """Overturning of what lies above a foot between two vertical lines, see above."""
    m, (left, right) = family.masonry, ends
    hinge = (family._edge(foot_m, family.settings["hinge_inset_m"]), foot_m)
    rows = region.masses(m, foot_m, m.top_m, ends)
    share = (right - left) / m.width_m
    loads = [
        (share * w, y, z) for w, y, z in family.loads if z >= foot_m + (NEAR_M if foot_m else 0.0)
    ]
    pushes = [(share * w, z) for w, z in family.pushes if z > foot_m + NEAR_M]
    pulls = [p for p in within(family, left, right) if p.height_m > foot_m + NEAR_M]
    pulls += _cracks(family, foot_m, ends)
    top = max(z for *_, z in rows)
    top = m.top_m if m.gable_m <= NEAR_M else max(top, m.height_m)
    masses = [(w, y, z) for w, _, y, z in rows]
    thrusts = [(share * force, z) for force, z in family.thrusting(foot_m)]
    mechanism = toppling(PART_WIDTH, masses, hinge, (hinge[0], top), loads, pulls, pushes, thrusts)
    mechanism = leaned(mechanism, family.lean_rad)
    return family.between(mechanism, foot_m, m.height_m, PART_WIDTH, ends)


def widths(family):
    """Part-width overturning, the weakest; none without lines within the façade.

    Of every foot those pairs of lines are looked at that have the least α0, and the least α0 d*/d_C
    (what the displacement left goes with); the weakest of all are followed to feet between.
    """
    last = family.height_m - LEAST_PART_M
    feet, chosen = [z for z in family.feet() if z < last], []
    between = [
        a + share * (b - a) for a, b in itertools.pairwise([*feet, last]) for share in THIRDS
    ]
    for foot in [*feet, *between]:
        pairs = list(_screened(family, foot))
        for measure in (0, 1):
            best = sorted(pairs, key=lambda row: row[measure])[: BEST if foot in feet else 1]
            chosen += [(foot, row[2]) for row in best]

    def measured(foot, ends):
        site = Site(PART_WIDTH, foot, left_m=ends[0], right_m=ends[1])
        return family.measure(site), site

    ranked = sorted((measured(*place) for place in set(chosen)), key=lambda row: row[0])
    for _, site in ranked[:FOLLOWED]:
        foot, ends = site.foot_m, (site.left_m, site.right_m)
        low = max((z for z in feet if z < foot), default=foot)
        beside = low, foot, min((z for z in feet if z > foot), default=last)
        for a, b in itertools.pairwise(beside):
            samples = np.linspace(a, b, BETWEEN + 2)[1:-1].tolist() if b - a > NEAR_M else []
            heights = [z for z in samples if any(row[2] == ends for row in _screened(family, z))]
            ranked += [measured(z, ends) for z in heights]
    return [min(ranked, key=lambda row: row[0])[1]] if ranked else []


def _screened(family, foot_m):
    """Pairs of lines above a foot by what they are chosen by: (α0, α0 d*/d_C, (left, right)).

    Of those that no measure tells apart the first. Sums are taken over columns of masonry between
    neighbouring lines, once.
    """
    m, every = family.masonry, lines(family)
    edge = family._edge(foot_m, family.settings["hinge_inset_m"])
    columns, standing = [], []
    cuts = sorted({foot_m, m.height_m, *(z for z in m.edges_m if foot_m < z < m.height_m)})
    middles = [0.5 * (a + b) for a, b in itertools.pairwise(cuts)]
    for ends in itertools.pairwise(every):
        rows = np.array(region.masses(m, foot_m, m.top_m, ends)).reshape(-1, 4)
        w, back, up = rows[:, 0], edge - rows[:, 2], rows[:, 3] - foot_m
        columns.append((w @ back, w @ up, w @ up**2))
        standing.append([region.length(m, z, ends) for z in middles])
    sums, solid = np.array(columns), np.array(standing)
    loads = [row for row in family.loads if row[2] >= foot_m + (NEAR_M if foot_m else 0.0)]
    pairs: dict[tuple, tuple] = {}
    for i, j in itertools.combinations(range(len(every)), 2):
        ends = every[i], every[j]
        wide = ends[1] - ends[0]
        if wide < family.facade.thickness_m or (i, j) == (0, len(every) - 1):
            continue
        if np.any(solid[i:j].sum(axis=0) < 0.5 * wide):
            continue
        rights, out, square = sums[i:j].sum(axis=0)
        per = square / (out * (m.top_m - foot_m))
        for w, y, z in loads:
            load = w * wide / m.width_m
            rights, out = rights + load * (edge - y), out + load * (z - foot_m)
        held = [p for p in within(family, *ends) if p.height_m > foot_m + NEAR_M and not p.slack_m]
        held += _cracks(family, foot_m, ends)
        rights += sum(p.force_n * (p.height_m - foot_m) for p in held)
        rights -= sum(f * wide / m.width_m * (z - foot_m) for f, z in family.thrusting(foot_m))
        out += sum(w * wide / m.width_m * (z - foot_m) for w, z in family.pushes)
        alpha = rights / out
        pairs.setdefault((round(alpha, 9), round(per, 9)), (alpha, alpha * per, ends))
    return pairs.values()
