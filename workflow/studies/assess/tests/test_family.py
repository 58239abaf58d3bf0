"""Mechanisms over a real shape: masses, each family by a second route, and the least of them."""

import math

import numpy as np
import pytest
from plain_facade import PlainFacade, overturning, two_blocks
from rocking.mechanics.closed_forms import GRAVITY_M_S2
from studies.assess import weakest
from studies.assess.drawn_bodies import _corner
from studies.assess.family import Family, stretched
from studies.assess.masonry import Masonry
from study_cases import study_settings

from yade_scripts.model.shape import shape_of

GABLE = {
    "height_m": 6.0,
    "thickness_m": 0.5,
    "width_m": 8.0,
    "density_kg_m3": 1800.0,
    "gable_height_m": 2.4,
    "thickness_steps": [{"z_m": 4.0, "thickness_m": 0.3}],
    "openings": [
        {"x_m": -2.0, "z_m": 4.3, "width_m": 1.0, "height_m": 1.5},
        {"x_m": 1.0, "z_m": 0.0, "width_m": 1.2, "height_m": 2.2},
    ],
}


def family(facade, **own):
    resolved = study_settings({"facade": facade, "assessment": own})
    return Family(resolved)


def weakest_corner(own, side):
    """A corner of a `Family` above the foot at which it is weakest."""
    (site,) = (site for site in weakest.corners(own) if site.side == side)
    return own.at(site)


def test_masses_have_the_shapes_weight_centroid_and_second_moment():
    """Against the sums over boxes and prism that scenes take, whose inertia is exact."""
    section = study_settings({"facade": GABLE})["facade"]
    shape = shape_of(section)
    masses = np.array(Masonry(section).masses(0.0, shape.top_m))
    weight = masses[:, 0].sum()
    assert weight == pytest.approx(shape.mass_kg * GRAVITY_M_S2, rel=1e-9)
    assert masses[:, 0] @ masses[:, 1] / weight == pytest.approx(shape.centre_m[1], rel=1e-9)
    assert masses[:, 0] @ masses[:, 2] / weight == pytest.approx(shape.centre_m[2], rel=1e-9)
    z2 = masses[:, 0] @ masses[:, 2] ** 2 / GRAVITY_M_S2
    # J_x − J_y + J_z... of a thin wall: Σ m z² from J about the centroid: J_x = Σ m (y² + z²)
    part = sum(m * r[2] ** 2 + 0.5 * (j[0, 0] + j[1, 1] - j[2, 2]) for m, r, j, _ in shape.parts)
    assert z2 == pytest.approx(part, rel=1e-9)


def test_a_plain_facade_is_that_of_the_closed_form():
    plain = {"height_m": 6.0, "thickness_m": 0.6, "width_m": 4.4, "density_kg_m3": 1800.0}
    found = family(plain).part(0.0, "whole").mechanism
    weight = 1800.0 * GRAVITY_M_S2 * 6.0 * 0.6 * 4.4
    other = overturning(PlainFacade(6.0, 0.6, weight))
    assert found.multiplier(0.03) == pytest.approx(other.multiplier(0.03), rel=1e-12)
    assert found.participation() == pytest.approx(other.participation(), rel=1e-12)
    bent = family(plain).bent(0.0, 4.0, 6.0)
    assert bent.multiplier(0.02) == pytest.approx(
        two_blocks(PlainFacade(6.0, 0.6, weight), 4.0).multiplier(0.02), rel=1e-12
    )


def test_a_gable_by_hand():
    """2.4 m high, 0.3 m thick: it turns about its foot from 0.15/(2.4/3) = 0.1875; e* = 2/3.

    Of a triangle Σ P z = P h/3, Σ P z² = P h²/6: e* = (1/9)/(1/6). Its T0 is that of a cantilever
    of half the modulus, and nothing holds it: it is felt at the top of the walls.
    """
    one = next(c for c in family(GABLE).all() if c.at_foot == "gable")
    assert one.mechanism.multiplier() == pytest.approx(0.1875, rel=1e-9)
    assert one.mechanism.participation()[1] == pytest.approx(2.0 / 3.0, rel=1e-9)
    assert one.place == 1.0
    assert family(GABLE).part(one.foot_m + 1.0).place == 1.0  # and so is what lies above its foot
    expected = 6.2 * 8.0 * 2.4 * math.sqrt(1800.0 / (0.5 * 1800e6))
    assert one.t0_s == pytest.approx(expected, rel=1e-9)


def test_an_inset_moves_the_hinge_of_every_part():
    """The gable's hinge 0.05 m inside: (0.15 − 0.05)/0.8 = 0.125 instead of 0.1875."""
    one = family(GABLE, hinge_inset_m=0.05).part(6.0, "gable")
    assert one.mechanism.multiplier() == pytest.approx(0.125, rel=1e-9)
    plain = {"height_m": 6.0, "thickness_m": 0.6, "width_m": 4.4, "density_kg_m3": 1800.0}
    bent = family(plain, hinge_inset_m=0.05).bent(0.0, 4.0, 6.0)
    assert bent.multiplier() == pytest.approx(0.25, rel=1e-9)  # by hand: test_mechanism


def test_parts_stand_above_every_sill_head_step_and_floor():
    floors = [{"height_m": 3.0, "load_kn": 20.0, "anchor_kn": 5.0}]
    names = [c.name for c in family({**GABLE, "floors": floors}).all()]
    for height, what in (
        ("2.20", "head of an opening"),
        ("3.00", "floor"),
        ("4.00", "change of thickness"),
        ("4.30", "sill of an opening"),
        ("5.80", "head of an opening"),
        ("6.00", "foot of the gable"),
    ):
        assert f"part above {height} m ({what})" in names
    assert names[0] == "whole façade about its base"
    assert sum("corner" in name for name in names) == 2
    assert any("vertical bending" in name for name in names)


@pytest.mark.parametrize(("thick", "words"), [(None, ""), (0.2, " and change of thickness")])
def test_a_parapet_as_thick_as_what_it_stands_on_is_no_change_of_thickness(thick, words):
    flat = {"height_m": 6.0, "thickness_m": 0.4, "width_m": 5.0, "density_kg_m3": 1800.0}
    flat |= {"parapet_height_m": 1.0, "parapet_thickness_m": thick}
    names = [c.name for c in family(flat).all()]
    assert f"part above 6.00 m (foot of the parapet{words})" in names


def test_a_part_above_a_sill_by_hand():
    """Above 4.3 m of the façade without gable: 1.7 m high, 0.3 m thick, a window 1 m wide in it.

    W = 0.3·(8·1.7 − 1·1.5) γ; Σ W z: (13.6·0.85 − 1.5·0.75) = 10.435 over 12.1 m²: z = 0.8624 m;
    α0 = 0.15/0.8624 = 0.1739.
    """
    flat = {**GABLE, "gable_height_m": 0.0}
    one = next(c for c in family(flat).all() if "4.30" in c.name)
    assert one.mechanism.multiplier() == pytest.approx(0.1739, rel=5e-4)
    assert one.place == pytest.approx((4.3 + 6.0) / 2.0 / 6.0)
    assert not one.on_ground


def test_a_base_above_the_ground_is_felt_there():
    found = family({**GABLE, "base_height_m": 3.0}).part(0.0, "whole")
    assert found.place == pytest.approx((3.0 + 3.0) / 9.0)
    assert not found.on_ground


def test_ties_and_anchors_hold_the_parts_above_them_only():
    """A tie at 5.5 m adds T (5.5 − foot) to each part's numerator below it, nothing above."""
    tied = {**GABLE, "ties": [{"height_m": 5.5, "diameter_mm": 16.0}]}
    free, held = family(GABLE), family(tied)
    force = held.pulls[0][0]
    for foot in (0.0, 4.3):
        gain = (
            held.part(foot, "").mechanism.multiplier() - free.part(foot, "").mechanism.multiplier()
        )
        masses = free.masonry.masses(foot, 8.4)
        assert gain == pytest.approx(
            force * (5.5 - foot) / sum(w * (z - foot) for w, _, z in masses), rel=1e-9
        )
    assert held.part(5.8, "").mechanism.multiplier() == pytest.approx(
        free.part(5.8, "").mechanism.multiplier(), rel=1e-12
    )
    anchored = {**GABLE, "floors": [{"height_m": 3.0, "load_kn": 1e-9, "anchor_kn": 12.0}]}
    assert [p[:3] for p in family(anchored).pulls] == [(12e3, 3.0, 0.2)]


def test_ties_below_a_floor_hold_at_one_level_and_squat_spans_are_no_mechanism():
    """Ties 0.1 m below each floor: three levels, so two spans and one past the middle level."""
    storeys = {
        **{"height_m": 6.0, "thickness_m": 0.5, "width_m": 8.0, "density_kg_m3": 1800.0},
        "floors": [{"height_m": z, "load_kn": 40.0, "anchor_kn": 5.0} for z in (3.0, 6.0)],
        "ties": [{"height_m": z, "diameter_mm": 20.0} for z in (2.9, 5.9)],
    }
    found = family(storeys)
    assert found.levels() == [0.0, 2.9, 5.9]
    assert [(s.foot_m, s.held_m) for s in weakest.spans(found)] == [
        (0.0, 2.9),
        (0.0, 5.9),
        (2.9, 5.9),
    ]
    assert weakest.span(found, [5.9], 5.9, 6.0) is None
    thick = {**storeys, "thickness_m": 1.0, "ties": [{"height_m": 5.69, "diameter_mm": 20.0}]}
    assert family(thick).levels() == [0.0, 3.0, 5.69, 6.0]
    assert not any("from 5.69" in one.name for one in family(thick).all())
    rubbing = [{"height_m": z, "load_kn": 40.0, "friction": 0.4} for z in (3.0, 6.0)]
    assert family({**thick, "floors": rubbing}).levels() == [0.0, 5.69]


def test_a_façade_is_stretched_with_all_that_stands_on_it():
    """A tenth higher with roof, ties and windows: the same mechanisms, each α0 by 1/1.1."""
    tied = {
        **{k: v for k, v in GABLE.items() if k != "thickness_steps"},
        "floors": [{"height_m": z, "load_kn": 20.0, "friction": 0.0} for z in (3.0, 6.0)],
    }
    section = study_settings({"facade": tied})["facade"]
    high = stretched(section, 1.1)
    assert [row["height_m"] for row in high["floors"]] == pytest.approx([3.3, 6.6])
    plain, tall = (
        [c for c in family(x).all() if "above" in c.name and "corner" not in c.name]
        for x in (tied, {**tied, **{k: high[k] for k in (*tied, "ties")}})
    )
    assert len(plain) == len(tall)
    assert tall[-1].mechanism.multiplier() == pytest.approx(plain[-1].mechanism.multiplier() / 1.1)


def test_a_corner_by_hand():
    """Plain wall 6 m high, crack at 45°, both walls of t: α0 = Σ W b_n/Σ W z along the bisector.

    Façade: triangle of reach z: x̄ = 2 m, ȳ = t/2, z̄ = 4 m, area 18 m²; return wall the same less
    the façade's thickness: reach z − t.
    """
    t, h = 0.5, 6.0
    plain = {"height_m": h, "thickness_m": t, "width_m": 14.0, "density_kg_m3": 1800.0}
    resolved = study_settings(
        {
            "facade": plain,
            "return_wall": {"thickness_m": t},
            "assessment": {"corner_crack_deg": 45.0},
        }
    )
    found = weakest_corner(Family(resolved), 1)
    assert found.foot_m == 0.0
    reach = h - t
    area, back = 0.5 * h**2, 0.5 * reach**2
    lever = area * (h / 3.0 + 0.5 * t) + back * (t + reach / 3.0 + 0.5 * t)
    height = area * 2.0 * h / 3.0 + back * (t + 2.0 * reach / 3.0)
    assert found.mechanism.multiplier() == pytest.approx(math.sqrt(0.5) * lever / height, rel=1e-4)
    crushed = {**resolved["assessment"], "hinge_inset_m": 0.1}
    inset = weakest_corner(Family({**resolved, "assessment": crushed}), 1)
    assert inset.foot_m == 0.0  # every lever is shorter by 0.1 m along the bisector
    lost = found.mechanism.multiplier() - inset.mechanism.multiplier()
    assert lost == pytest.approx(0.1 * (area + back) / height, rel=1e-4)


def test_a_corner_beside_openings_and_a_setback_by_fine_strips():
    """α0 of 6300 strips, from whose lengths the openings are taken."""
    holes = [(-1.8, 0.0, 1.4, 2.4), (1.6, 0.9, 1.2, 1.5), (0.4, 4.1, 1.0, 1.3)]
    names = ("x_m", "z_m", "width_m", "height_m")
    resolved = study_settings(
        {
            "facade": {
                "height_m": 6.3,
                "thickness_m": 0.6,
                "width_m": 7.2,
                "thickness_steps": [{"z_m": 3.3, "thickness_m": 0.45}],
                "openings": [dict(zip(names, hole, strict=True)) for hole in holes],
            },
            "return_wall": {"thickness_m": 0.5},
            "assessment": {"hinge_inset_m": 0.03},
        }
    )
    found = Family(resolved)
    for side in (-1, 1):
        lifted = pushed = 0.0
        for z in (np.arange(6300) + 0.5) * 1e-3:
            reach, t = z * math.tan(math.radians(30.0)), 0.6 if z < 3.3 else 0.45
            parts = [(1.0, 0.0, reach)]
            for x, sill, wide, high in holes:
                if sill < z < sill + high:
                    ends = (3.6 - side * (x - 0.5 * wide), 3.6 - side * (x + 0.5 * wide))
                    parts.append((-1.0, *sorted(min(end, reach) for end in ends)))
            rows = [(s * (b - a) * t, 0.5 * (a + b + t)) for s, a, b in parts]
            behind = max(reach - t, 0.0)
            rows.append((behind * 0.5, t + 0.5 * behind + 0.25))
            lifted += sum(area * (math.sqrt(0.5) * lever - 0.03) for area, lever in rows)
            pushed += sum(area for area, _ in rows) * z
        corner = weakest_corner(found, side)
        assert corner.foot_m == 0.0
        assert corner.mechanism.multiplier() == pytest.approx(lifted / pushed, rel=3e-4)


def test_interlocking_helps_every_part_that_walls_stand_behind():
    own = {"interlocking_course_m": 0.3, "interlocking_overlap_m": 0.15}
    free, bound = family(GABLE), family(GABLE, **own)
    assert bound.part(0.0, "").mechanism.multiplier() > free.part(0.0, "").mechanism.multiplier()
    gable = free.part(6.0, "").mechanism.multiplier()
    assert bound.part(6.0, "").mechanism.multiplier() == pytest.approx(gable, rel=1e-12)
    assert len(bound.feet()) > len(free.feet())


def test_what_falls_by_its_own_weight_is_refused_by_name():
    lean = {**GABLE, "floors": [{"height_m": 6.0, "load_kn": 3000.0, "arm_m": 0.3}]}
    with pytest.raises(ValueError, match="own weight"):
        family(lean, hinge_inset_m=0.2).all()
    with pytest.raises(ValueError, match="hinge_inset_m"):
        family(GABLE, hinge_inset_m=0.4)


@pytest.mark.parametrize("crack_deg", [30.0, 60.0])  # at 60° the crack meets the other edge
@pytest.mark.parametrize("side", [-1, 1])
def test_a_corner_is_drawn_as_large_as_it_weighs(crack_deg, side):
    plain = {"height_m": 6.0, "thickness_m": 0.6, "width_m": 4.4, "density_kg_m3": 1800.0}
    own = family(plain, corner_crack_deg=crack_deg)
    candidate = weakest_corner(own, side)
    x, z = np.array(_corner(own, candidate)).T
    area = 0.5 * abs(x @ np.roll(z, -1) - z @ np.roll(x, -1))
    tangent = math.tan(math.radians(crack_deg))
    weight = sum(w for w, *_ in own.masonry.wedge(candidate.foot_m, tangent, side))
    assert 1800.0 * GRAVITY_M_S2 * 0.6 * area == pytest.approx(weight, rel=1e-3)
    assert np.abs(x).max() == pytest.approx(2.2)
    assert np.sign(x[0]) == side
