"""Compound and part-width overturning, horizontal bending, thrusts: against hand calculation."""

import math

import numpy as np
import pytest
from repertory_cases import BRICKS, DEMAND, GAMMA, PLAIN, SHAPED, WALLS, family, resolved
from rocking.mechanics.mechanism import rate
from studies.assess import byhand, region, shaken
from studies.assess.code_checks import code_checks, family_of, governing, least
from studies.assess.family import Family
from studies.assess.masonry import Masonry
from studies.assess.names import BEYOND, kind_of, not_asked
from studies.assess.partial_width import _screened, lines, part_width
from studies.assess.repertory import (
    compound,
    wedge_masses,
)
from studies.assess.sites import site_of
from study_cases import study_case

from yade_scripts.model.shape import shape_of


@pytest.mark.parametrize("facade", [PLAIN, SHAPED])
@pytest.mark.parametrize("own", [{}, BRICKS])
@pytest.mark.parametrize("foot_m", [0.0, 3.0])
def test_a_vertical_crack_is_the_part_without_a_wedge_to_the_digit(facade, own, foot_m):
    known = family(facade, **own)
    whole, wedge = known.part(foot_m, "one").mechanism, compound(known, foot_m, 0.0).mechanism
    assert wedge.multiplier() == whole.multiplier()
    assert wedge.ultimate() == whole.ultimate()
    assert wedge.participation() == whole.participation()
    assert np.array_equal(wedge.curve(), whole.curve())


def test_a_wedge_by_hand():
    """6 × 5 × 0.5 m on two walls of 0.4 m, 20° from the base: W = 264.87, V = 92.6 kN.

    α0 = [W 0.25 + V (0.5 + 6 tan 20°/3)]/(W 3 + V 4), see `repertory.compound`; of a homogeneous
    triangle the mean square of the height is h²/2, of the wall h²/3.
    """
    slope = math.tan(math.radians(20.0))
    w, v = GAMMA * 6.0 * 5.0 * 0.5, GAMMA * 0.8 * 0.5 * 36.0 * slope
    assert (w, v) == pytest.approx((264.87e3, 92.55e3), rel=1e-3)
    one = compound(family(), 0.0, 20.0)
    out = 3.0 * w + 4.0 * v
    alpha = (0.25 * w + v * (0.5 + 2.0 * slope)) / out
    assert alpha == pytest.approx(0.1544, abs=5e-5)
    assert one.mechanism.multiplier() == pytest.approx(alpha, rel=1e-12)
    mass = out**2 / (9.81 * (12.0 * w + 18.0 * v))
    assert one.mechanism.participation()[0] == pytest.approx(mass, rel=1e-12)
    assert one.mechanism.ultimate()[0] == pytest.approx(math.atan(alpha), rel=1e-9)


def test_openings_of_the_facade_take_nothing_from_its_wedges():
    door = {"x_m": 0.0, "z_m": 0.0, "width_m": 1.2, "height_m": 2.2}
    pierced, plain = (family({**PLAIN, "openings": rows}) for rows in ([door], []))
    wedges = [
        [sum(w * z**power for w, _, z in wedge_masses(one, 1.0, 20.0)) for power in (0, 1, 2)]
        for one in (pierced, plain)
    ]
    assert wedges[0] == pytest.approx(wedges[1], rel=1e-12)
    part = shape_of(
        resolved({**PLAIN, "openings": [door], "wedge_deg": 20.0, "wedge_thickness_m": 0.8})[
            "facade"
        ]
    )
    one = compound(pierced, 0.0, 20.0).mechanism
    assert one.multiplier() == pytest.approx(part.static_multiplier, rel=1e-12)


def test_friction_of_interlocked_courses_fades_with_the_crack_s_angle():
    """tan β_b = 0.15/0.25: half of it leaves half of the friction; F of C8.7.1.2 at h/3.

    n = 24, Φ = 0.25/0.15: F = 0.4·24·25·Φ·0.577·0.15²·0.4·γ a wall.
    """
    known, bare = family(**BRICKS), family()
    deg = math.degrees(math.atan(0.3))
    force = 2 * 0.4 * 24 * 25 * (0.25 / 0.15) * 0.577 * 0.15**2 * 0.4 * GAMMA
    held, free = (compound(one, 0.0, deg).mechanism for one in (known, bare))
    out = sum(p * rate(path, 0.0)[0] for p, path in held.weights)
    work = (held.multiplier() - free.multiplier()) * out
    assert work == pytest.approx(0.5 * force * 2.0, rel=1e-9)
    steep = compound(known, 0.0, 35.0).mechanism  # beyond the units' own steps
    assert steep.multiplier() == compound(bare, 0.0, 35.0).mechanism.multiplier()


def test_without_friction_no_slanting_crack_is_listed_and_with_it_the_weakest():
    """No angle and foot of a dense search is weaker than the list by more than 2 %."""
    assert not [one for one in family().all() if one.crack_deg is not None]
    settings = resolved(SHAPED, **BRICKS)
    known = family_of(settings, DEMAND)
    listed = [one for one in known.all() if one.plane and one.held_m is None]
    wedges = [one for one in listed if one.crack_deg is not None]
    assert wedges
    assert all(0.0 < one.crack_deg < 31.0 for one in wedges)
    weakest = min(map(known.slv, listed))
    dense = [
        known.slv(compound(known, z, deg))
        for z in np.arange(0.0, 5.7, 0.25)
        for deg in np.arange(0.0, 45.0, 3.0)
    ]
    assert min(dense) > 0.98 * weakest
    stated = [one for one in family_of(resolved(crack_deg=15.0), DEMAND).all() if one.crack_deg]
    assert {one.crack_deg for one in stated} == {15.0}
    assert min(one.foot_m for one in stated) == 0.0


def test_a_strong_row_of_ties_makes_a_slanting_crack_the_weaker():
    """T h holds less of a heavier body: [W b/2 + V (b + h tan β/3) + T h]/(W h/2 + V 2h/3)."""
    row = {"height_m": 6.0, "count": 2, "diameter_mm": 22.0}
    known = family_of(resolved({**PLAIN, "ties": [row]}, crack_deg=30.0), DEMAND)
    assert {one.crack_deg for one in known.all()} == {None, 30.0}
    whole, slanting = known.part(0.0, "whole"), compound(known, 0.0, 30.0)
    assert slanting.mechanism.multiplier() < whole.mechanism.multiplier()
    assert known.slv(slanting) < known.slv(whole)


def test_a_wedge_s_printed_parts_give_its_printed_results():
    known = family(SHAPED, **BRICKS)
    one = compound(known, 0.0, 12.0)
    rows, holds = byhand.parts(known, one), byhand.pulled(one)
    found = {s: v for s, _, v, _ in byhand.results(one, byhand.sums(rows, holds), 1.35)}
    assert rows[-2].key == "wedges"  # before the floor's load
    assert found["α0"] == pytest.approx(one.mechanism.multiplier(), rel=1e-12)
    assert found["M*"] == pytest.approx(one.mechanism.participation()[0], rel=1e-12)


def test_a_part_of_the_width_by_hand():
    """Plain, 2 m of 5 above 2 m: W cancels, α0 = 0.5/4. The roof's share, and rods inside."""
    assert part_width(family(), 2.0, (-1.0, 1.0)).mechanism.multiplier() == pytest.approx(0.125)
    facade = {
        **PLAIN,
        "floors": [{"height_m": 6.0, "load_kn": 50.0, "arm_m": 0.1}],
        "ties": [{"height_m": 5.0, "count": 3, "x_m": [-2.0, 0.0, 2.0]}],
    }
    known = family(facade)
    w, n = GAMMA * 2.0 * 0.5 * 6.0, 50e3 * 2.0 / 5.0
    force = 235e6 * math.pi / 4 * 0.02**2  # one rod of three
    alpha = (0.25 * w + 0.4 * n + 5.0 * force) / (3.0 * w + 6.0 * n)
    found = part_width(known, 0.0, (-1.0, 1.0)).mechanism
    assert found.multiplier() == pytest.approx(alpha, rel=1e-9)
    edge = part_width(known, 0.0, (0.0, 2.0)).mechanism  # rods on its lines do not hold it
    assert edge.multiplier() == pytest.approx((0.25 * w + 0.4 * n) / (3.0 * w + 6.0 * n), rel=1e-9)


def test_friction_on_the_sides_of_a_part_is_that_of_the_code_with_the_wall_s_thickness():
    """Two cracks 6 m high: C8.7.1.2 with 0.5 m in place of a return wall, at a third of 6 m."""
    known = family(**BRICKS)
    held, free = (part_width(one, 0.0, (-1.0, 1.0)).mechanism for one in (known, family()))
    out = sum(p * rate(path, 0.0)[0] for p, path in held.weights)
    force = 2 * 0.4 * 24 * 25 * (0.25 / 0.15) * 0.577 * 0.15**2 * 0.5 * GAMMA
    assert (held.multiplier() - free.multiplier()) * out == pytest.approx(force * 2.0, rel=1e-9)
    window = {"x_m": 0.0, "z_m": 2.0, "width_m": 2.0, "height_m": 2.0}
    pierced = Masonry(resolved({**PLAIN, "openings": [window]})["facade"])
    heights = [z for z, _ in region.on_crack(pierced, -1.0, 0.0, 6.0)]
    assert len(heights) == 4
    assert not any(2.0 < z < 4.0 for z in heights)


def test_lines_of_part_width_are_ends_edges_and_rods():
    assert lines(family(SHAPED)) == [-2.5, -2.0, -1.5, -0.5, 2.0, 2.5]
    (one,) = [
        one
        for one in family(SHAPED, mechanisms=["part_width"]).all()
        if kind_of(one) == "part_width"
    ]
    assert not one.plane
    assert one.right_m - one.left_m >= 0.5


def test_masonry_between_two_lines_is_what_all_of_it_is():
    """Pieces side by side sum to the whole, gable and openings with them, to its moments."""
    whole = Masonry(resolved(SHAPED)["facade"])
    ends = (-2.5, -0.7, 0.4, 2.5)
    pieces = [
        row
        for a, b in zip(ends, ends[1:], strict=False)
        for row in region.masses(whole, 1.0, whole.top_m, (a, b))
    ]
    known = whole.masses(1.0, whole.top_m)
    for power in (0, 1, 2):
        mine = sum(w * z**power for w, _, _, z in pieces)
        assert mine == pytest.approx(sum(w * z**power for w, _, z in known), rel=1e-12)
    assert sum(w * y for w, _, y, _ in pieces) == pytest.approx(
        sum(w * y for w, y, _ in known), rel=1e-12
    )
    centre = whole.shape.centre_m[0]
    every = region.masses(whole, 0.0, whole.top_m, (-2.5, 2.5))
    assert sum(w * x for w, x, *_ in every) / whole.weight_n == pytest.approx(centre, abs=1e-12)


def test_a_hip_rafter_s_thrust_takes_its_moment_from_a_corner():
    """At the eaves, outward: α0 falls by H (h − foot)/Σ P δx."""
    with_it, without = (family(hip_thrust_kn=kn).corner(1, 2.0).mechanism for kn in (6.0, 0.0))
    out = sum(p * rate(path, 0.0)[0] for p, path in without.weights)
    assert without.multiplier() - with_it.multiplier() == pytest.approx(6e3 * 4.0 / out, rel=1e-9)


def test_kinds_that_were_not_asked_for_are_named():
    assert "part-width" in not_asked(["compound", "horizontal"])
    assert not_asked(list(BEYOND)) == ""


def test_new_mechanisms_are_ranked_and_checked_like_the_others():
    settings = resolved(SHAPED, mechanisms=list(BEYOND), **BRICKS)
    ranked = governing(family_of(settings, DEMAND).all(), settings, DEMAND)
    kinds = {kind_of(one) for _, one, _ in ranked}
    assert {"compound", "horizontal", "part_width", "corner", "overturning"} <= kinds
    assert [row[0] for row in ranked] == sorted(row[0] for row in ranked)
    for pga_g, one, found in ranked:
        assert pga_g == least(code_checks(one, settings, DEMAND))
        assert found["slv_height"].failing_pga_g >= pga_g


@pytest.mark.parametrize("own", [{}, BRICKS])
def test_pairs_of_lines_are_chosen_by_the_multiplier_of_their_mechanism(own):
    """What columns between lines sum to is α0 of the mechanism, loads, rods and cracks with it."""
    low = {"height_m": 0.3, "load_kn": 40.0}  # bears on what turns about the base
    shape = {**SHAPED, "floors": [*SHAPED["floors"], low]}
    known = family({**shape, "thrusts": [{"height_m": 4.0, "force_kn": 3.0}]}, **own)
    rows = [row for foot in (0.0, 3.0) for row in ((foot, *r) for r in _screened(known, foot))]
    assert len(rows) > 10
    for foot, alpha, _, ends in rows:
        assert part_width(known, foot, ends).mechanism.multiplier() == pytest.approx(alpha)


def test_a_wedge_is_shaken_as_one_block_and_the_others_are_named():
    """Its case has the wedge's mass, on the column's base where the façade has courses."""
    given = {**PLAIN, "courses": 4, "ties": [{"height_m": 5.0}]}
    settings = resolved(given, mechanisms=list(BEYOND), **BRICKS)
    ranked = governing(family_of(settings, DEMAND).all(), settings, DEMAND)
    own = {"facade": given, "return_wall": WALLS, "damping": {"law": "value", "beta_s": 1e-3}}
    case = study_case("W1", own)
    table = shaken.chosen(ranked, [case], DEMAND.pga_g, 100.0)
    by = table.set_index("part")
    assert by.loc["horizontal", "why_not"] == by.loc["part_width", "why_not"] == shaken.NARROW
    wedges = [part for part in by.index if part.startswith("compound")]
    assert wedges
    cases = {row.part: found for row, found in shaken.cases(case, table)}
    for part in wedges:
        row, facade = by.loc[part], cases[part]["facade"]
        assert (facade["wedge_deg"], facade["wedge_thickness_m"]) == (row["crack_deg"], 0.8)
        assert (facade["courses"], facade["base"]) == (0, "column")
        tall = 6.0 - row["foot_m"]
        volume = tall * (5.0 * 0.5 + 0.4 * tall * math.tan(math.radians(row["crack_deg"])))
        assert shape_of(facade).mass_kg == pytest.approx(1800.0 * volume, rel=1e-9)
        again = Family(settings).at(site_of(_row(row, part)))
        assert again.mechanism.multiplier() == pytest.approx(
            next(one for _, one, _ in ranked if one.part == part).mechanism.multiplier(), rel=1e-9
        )


def _row(row, part):
    """Row of a table as its reader has it."""
    return type("Row", (), {**row.to_dict(), "part": part})
