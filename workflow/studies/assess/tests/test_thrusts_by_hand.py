"""Static thrusts and stretched rods in the mechanisms by hand."""

import pytest
from studies.assess.family import Family
from studies.assess.ties import levels_of
from yade_process import resolved

WEIGHT_N = 1800.0 * 9.81 * 6.48 * 0.375 * 4.4
THRUST = {"height_m": 6.0, "force_kn": 2.0}
ROD = {"height_m": 6.0, "count": 2, "diameter_mm": 12.0, "length_m": 4.0}


def test_a_thrust_by_hand_is_on_every_mechanism_above_which_it_acts():
    """α0 falls by F (z − foot)/Σ P δx; above it nothing changes."""
    given = resolved(facade={"thrusts": [THRUST]})
    pushed, plain = Family(given), Family(resolved())
    for foot in (0.0, 2.0):
        one, other = (own.part(foot, "part").mechanism for own in (pushed, plain))
        out = WEIGHT_N * (1.0 - foot / 6.48) * 0.5 * (6.48 - foot)
        found = other.multiplier() - one.multiplier()
        assert found == pytest.approx(2e3 * (6.0 - foot) / out, rel=1e-9)
    above = [own.part(6.1, "part").mechanism.multiplier() for own in (pushed, plain)]
    assert above[0] == above[1]
    assert 6.0 in pushed.feet()


def test_a_stretched_rod_by_hand_pulls_what_it_can_at_once_and_ends_earlier():
    plain, pulled = (
        Family(resolved(facade={"ties": [{**ROD, "pretension_kn": n}]})).part(0.0, "one").mechanism
        for n in (0.0, 8.0)
    )
    assert pulled.multiplier() == plain.multiplier()  # by hand a rod pulls what it can at once
    assert pulled.pulls[0].reach_m < plain.pulls[0].reach_m


def test_a_floor_whose_joists_run_along_is_a_level_without_a_load():
    given = resolved(facade={"floors": [{"height_m": 3.0, "joists": "along"}]})
    assert levels_of(given) == [3.0, 6.48]
    plain = Family(resolved()).part(0.0, "one").mechanism.multiplier()
    assert Family(given).part(0.0, "one").mechanism.multiplier() == plain
