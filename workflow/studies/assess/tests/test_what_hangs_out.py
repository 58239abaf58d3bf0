"""What hangs out, leans and tapers: by hand, and the same in the models' block."""

import math

import pytest
from studies.assess import drawn_bodies
from studies.assess.family import Family
from studies.assess.partial_width import part_width
from study_cases import study_case
from test_repertory import GAMMA, PLAIN, family, resolved

from yade_scripts.model.shape import shape_of


def test_a_cornice_takes_from_what_rights_the_wall():
    """0.4 × 0.3 m before the top of 6 × 0.5 m: W_c's arm is −0.2 m, its height 5.85 m.

    The block of the models has the same lever, and a corner carries its own part.
    """
    facade = {**PLAIN, "cornices": [{"z_m": 5.7, "height_m": 0.3, "projection_m": 0.4}]}
    settings = resolved(facade)
    known, w, c = Family(settings), GAMMA * 5.0 * 3.0, GAMMA * 5.0 * 0.12
    alpha = (0.25 * w - 0.2 * c) / (3.0 * w + 5.85 * c)
    assert known.part(0.0, "whole").mechanism.multiplier() == pytest.approx(alpha, rel=1e-12)
    assert shape_of(settings["facade"]).static_multiplier == pytest.approx(alpha, rel=1e-12)
    assert 5.7 in known.feet()
    part = part_width(known, 0.0, (-1.0, 1.0)).mechanism.multiplier()
    assert part == pytest.approx(alpha, rel=1e-12)
    bare = family().corner(1, 0.0).mechanism.multiplier()
    assert known.corner(1, 0.0).mechanism.multiplier() < bare
    above = study_case("W1", {"facade": facade}).part(3.0)["facade"]
    assert above["cornices"] == [{"z_m": 2.7, "height_m": 0.3, "projection_m": 0.4}]


def test_a_leaning_wall_has_turned_already():
    """tan(θ0 − φ), and d0 = h (sin θ0 − sin φ): 6 × 0.5 m that leans by 1°."""
    lean, theta0 = math.radians(1.0), math.atan(0.5 / 6.0)
    found = family({**PLAIN, "tilt_deg": 1.0}).part(0.0, "whole").mechanism
    assert found.multiplier() == pytest.approx(math.tan(theta0 - lean), rel=1e-9)
    assert found.ultimate()[1] == pytest.approx(6.0 * (math.sin(theta0) - math.sin(lean)), rel=1e-9)
    above = family({**PLAIN, "tilt_deg": 1.0}).part(3.0, "above").mechanism
    assert above.multiplier() == pytest.approx(math.tan(math.atan(0.5 / 3.0) - lean), rel=1e-9)


@pytest.mark.parametrize("flush", ["outer", "inner"])
def test_a_wall_that_tapers(flush):
    """0.6 m to 0.3 m over 6 m, by hand: a rectangle 0.3 × 6 and a triangle 0.3 × 6/2.

    With the outer face vertical the triangle stands behind, its centroid 0.3 + 0.1 m from the toe;
    with the inner one before, 0.2 m from it.
    """
    facade = {**PLAIN, "thickness_m": 0.6, "top_thickness_m": 0.3, "flush_face": flush}
    settings = resolved(facade)
    rect, tri = 0.3 * 6.0, 0.5 * 0.3 * 6.0
    arms = (0.15, 0.3 + 0.1) if flush == "outer" else (0.3 + 0.15, 0.2)  # inward of the toe
    alpha = (rect * arms[0] + tri * arms[1]) / (rect * 3.0 + tri * 2.0)
    known = Family(settings)
    assert known.masonry.weight_n == pytest.approx(GAMMA * 5.0 * 2.7, rel=1e-12)
    assert known.part(0.0, "whole").mechanism.multiplier() == pytest.approx(alpha, rel=1e-9)
    own = shape_of(settings["facade"])
    assert own.static_multiplier == pytest.approx(alpha, rel=3e-3)
    assert list(known.feet()) == [0.0]  # no height at which it changes
    above = study_case("W1", {"facade": facade}).part(2.0)["facade"]
    assert (above["thickness_m"], above["top_thickness_m"]) == pytest.approx((0.5, 0.3))
    sums = known.masonry.masses(2.0, 6.0)
    part = shape_of(above)
    assert part.mass_kg * 9.81 == pytest.approx(sum(w for w, *_ in sums), rel=2e-3)
    with pytest.raises(ValueError, match="top_thickness_m = 0.3: expected null"):
        resolved({**facade, "thickness_steps": [{"z_m": 3.0, "thickness_m": 0.4}]})


@pytest.mark.parametrize("flush", ["outer", "inner"])
def test_the_drawing_of_a_taper_is_one_body_of_the_weight(flush):
    """Its section times the width weighs what the wall does, below a gable and with steps too."""

    def drawn_m2(facade):
        known, found = family(facade).masonry, 0.0
        for low, high in drawn_bodies.pieces(known):
            (a, _), (b, _), (c, _), (d, _) = drawn_bodies.trapezoid(known, low, high)
            share = 1.0 if high <= known.top_m - known.gable_m else 0.5
            found += share * 0.5 * (b - a + c - d) * (high - low)
        return len(drawn_bodies.pieces(known)), found, known.weight_n / (GAMMA * 5.0)

    taper = {**PLAIN, "thickness_m": 0.6, "top_thickness_m": 0.3, "flush_face": flush}
    steps = {**PLAIN, "thickness_steps": [{"z_m": 3.0, "thickness_m": 0.4}], "flush_face": flush}
    for facade, count in ((taper, 1), (steps, 2), ({**taper, "gable_height_m": 1.5}, 2)):
        pieces, area, expected = drawn_m2(facade)
        assert (pieces, area) == (count, pytest.approx(expected, rel=1e-9))
