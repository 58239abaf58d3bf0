"""Interfaces between boxes that share a face, and their stiffness per area.

A rigid brick carries the compliance of the masonry between its centre and its
face, s/(2E), E = jkn·(joint spacing) for the joint type that the face belongs
to. Two halves in series give the interface its stiffness,
1/jkn = s_a/(2E_a) + s_b/(2E_b), which equals the stated jkn between bricks of
the stated size and keeps jkn times joint spacing, hence E, whatever the size
of the bricks. The ground has no half of its own.
"""

from dataclasses import dataclass, replace

import numpy as np

from yade_scripts.model.building.plan import TOLERANCE_M

KINDS = ("ground", "bed", "head", "collar", "junction", "beam", "panel")
SMALLEST_AREA_M2 = 1e-8


@dataclass(frozen=True)
class Joints:
    """Normal and shear stiffness of the joint types [Pa/m], for bricks of the stated size."""

    head_jkn_pa_m: float = 1280e6
    head_jks_pa_m: float = 422e6
    bed_jkn_pa_m: float = 5120e6
    bed_jks_pa_m: float = 1690e6
    collar_jkn_pa_m: float = 2560e6
    collar_jks_pa_m: float = 845e6
    timber_jkn_pa_m: float = 5120e6
    timber_jks_pa_m: float = 1690e6

    def moduli(self, brick):
        """Return stiffness times joint spacing [Pa], shape (3, 2): head, collar, bed × kn, ks."""
        per_length = np.array(
            [
                [self.head_jkn_pa_m, self.head_jks_pa_m],
                [self.collar_jkn_pa_m, self.collar_jks_pa_m],
                [self.bed_jkn_pa_m, self.bed_jks_pa_m],
            ]
        )
        spacing = np.array([brick.length_m, brick.width_m, brick.height_m])
        return per_length * spacing[:, None]


@dataclass
class Interfaces:
    """Flat rectangular interfaces as columns of length n.

    `a` lies on the positive side of `b` along `axis` (0, 1, 2); `centre_m` and
    `half_m` (n, 3) give the rectangle (half extent 0 along the axis); `jkn`,
    `jks` [Pa/m]; `kind` indexes KINDS. Block −1 of `b` is the ground.
    """

    a: np.ndarray
    b: np.ndarray
    axis: np.ndarray
    centre_m: np.ndarray
    half_m: np.ndarray
    jkn_pa_m: np.ndarray
    jks_pa_m: np.ndarray
    kind: np.ndarray

    def __len__(self):
        """Return the number of interfaces."""
        return len(self.a)

    @property
    def area_m2(self):
        """Areas of the rectangles, shape (n,)."""
        sides = 2.0 * np.where(np.arange(3) == self.axis[:, None], 0.5, self.half_m)
        return sides.prod(axis=1)


def touching(low, high, upper, lower, axis):
    """Return index pairs (a, b), a of `upper` lying face to face on b of `lower` along `axis`."""
    touch = np.abs(low[upper, axis][:, None] - high[lower, axis][None, :]) < TOLERANCE_M
    area = np.ones(touch.shape)
    for k in (0, 1, 2):
        if k == axis:
            continue
        reach = np.minimum(high[upper, k][:, None], high[lower, k][None, :])
        reach = reach - np.maximum(low[upper, k][:, None], low[lower, k][None, :])
        area *= np.where(reach > TOLERANCE_M, reach, 0.0)
    rows, cols = np.nonzero(touch & (area > SMALLEST_AREA_M2))
    return np.column_stack([upper[rows], lower[cols]])


def brick_pairs(bricks):
    """Return (a, b, axis) of all interfaces between bricks, shape (n, 3)."""
    low, high = bricks.low_m, bricks.high_m
    courses = [np.flatnonzero(bricks.course == c) for c in range(bricks.course.max() + 1)]
    out = []
    for c, here in enumerate(courses):
        for axis in (0, 1):
            pairs = touching(low, high, here, here, axis)
            out.append(np.column_stack([pairs, np.full(len(pairs), axis)]))
        if c:
            pairs = touching(low, high, here, courses[c - 1], 2)
            out.append(np.column_stack([pairs, np.full(len(pairs), 2)]))
    return np.concatenate(out)


def timber_pairs(low, high, n_bricks, floors):
    """Return (a, b, axis, kind) of the interfaces of beams: seat, end, top, and panel.

    `low` and `high` are of all boxes, bricks first; `floors` as of `interfaces`.
    """
    bricks = np.arange(n_bricks)
    out = [np.empty((0, 4), int)]
    for first, count, axis in floors:
        beams = np.arange(first, first + count)
        panel = np.array([first + count])
        beam_kind, panel_kind = KINDS.index("beam"), KINDS.index("panel")
        for upper, lower, direction, kind in (
            (beams, bricks, 2, beam_kind),
            (bricks, beams, 2, beam_kind),
            (beams, bricks, axis, beam_kind),
            (bricks, beams, axis, beam_kind),
            (panel, beams, 2, panel_kind),
        ):
            pairs = touching(low, high, upper, lower, direction)
            extra = np.broadcast_to([direction, kind], (len(pairs), 2))
            out.append(np.column_stack([pairs, extra]))
    return np.concatenate(out)


def half_compliance(sizes, length_axis, moduli):
    """Compliance per area between a brick's centre and its faces, s/(2E) [m/Pa], shape (n, 3, 2).

    Along x, y, z, normal and shear; `length_axis` is 0 or 1, `moduli` from `Joints.moduli`.
    """
    role = np.empty((len(sizes), 3), int)  # row of `moduli`: 0 head, 1 collar, 2 bed
    role[:, 0] = length_axis
    role[:, 1] = 1 - length_axis
    role[:, 2] = 2
    return sizes[:, :, None] / (2.0 * moduli[role])


def interfaces(bricks, low, high, floors, joints, brick):
    """Find every interface of a building and give it its stiffness.

    `low` and `high` are of all boxes: bricks, then beams and panels, floor by floor; `floors` lists
    (first box, number of beams, beam axis). `joints` are stated for `brick`, which is not the
    coarsened one.
    """
    n = len(bricks)
    half = np.zeros((len(low), 3, 2))
    half[:n] = half_compliance(
        bricks.high_m - bricks.low_m, bricks.length_axis, joints.moduli(brick)
    )
    masonry = brick_pairs(bricks)
    axis = masonry[:, 2]
    same_wall = bricks.wall[masonry[:, 0]] == bricks.wall[masonry[:, 1]]
    along = bricks.length_axis[masonry[:, 0]] == axis
    bed, head, collar, junction = map(KINDS.index, ("bed", "head", "collar", "junction"))
    upright = np.where(same_wall, np.where(along, head, collar), junction)
    masonry = np.column_stack([masonry, np.where(axis == 2, bed, upright)])
    timber = timber_pairs(low, high, n, floors)
    standing = np.flatnonzero(np.abs(bricks.low_m[:, 2]) < TOLERANCE_M)
    below = np.broadcast_to([-1, 2, KINDS.index("ground")], (len(standing), 3))
    ground = np.column_stack([standing, below])
    rows = np.concatenate([ground, masonry, timber]).astype(int)
    a, b, axis, kind = rows.T
    on_ground = b < 0
    below = np.where(on_ground, a, b)
    lower = np.maximum(low[a], low[below])
    upper = np.minimum(high[a], high[below])
    index = np.arange(len(a))
    plane = low[a, axis]
    lower[index, axis] = upper[index, axis] = plane
    compliance = half[a, axis] + np.where(on_ground[:, None], 0.0, half[below, axis])
    is_timber = np.isin(kind, [KINDS.index("beam"), KINDS.index("panel")])
    compliance[is_timber] += 1.0 / np.array([joints.timber_jkn_pa_m, joints.timber_jks_pa_m])
    return Interfaces(
        a,
        b,
        axis,
        0.5 * (lower + upper),
        0.5 * (upper - lower),
        1.0 / compliance[:, 0],
        1.0 / compliance[:, 1],
        kind,
    )


def weakened(faces, bricks, is_facade, factor):
    """Scale the joints between façades (`is_facade`, by wall) and other walls by a factor."""
    n = len(bricks)
    between = np.flatnonzero((faces.a < n) & (faces.b >= 0) & (faces.b < n))
    kind = np.asarray(is_facade, bool)[bricks.wall]
    across = between[kind[faces.a[between]] != kind[faces.b[between]]]
    scale = np.ones(len(faces))
    scale[across] = factor
    return replace(faces, jkn_pa_m=scale * faces.jkn_pa_m, jks_pa_m=scale * faces.jks_pa_m)
