"""The short climb to 10 and 50 % collapse beside the dense scan, on a pulse."""

import numpy as np
import pytest
from rocking import Motion, collapse_curve, collapse_curves
from rocking.collapse import search
from rocking.collapse.quick import crossings
from rocking.records import Record
from study_cases import sine_pulse as pulse
from study_cases import study_case

SETTINGS = {"level_ratio": 0.02, "beyond": 1.35, "max_pga_g": 3.0, "realisations": 7}


def case(model):
    given = {"return_wall.building_mass_kg": 77000.0, "smdof.tail_s": 1.0}
    return study_case(model, given | {"numerics.after_motion_s": 3.0, "ida.max_pga_g": 3.0})


@pytest.mark.parametrize("model", ["W1", "W2"])
def test_the_climb_finds_what_the_dense_scan_finds(model):
    found = crossings(case(model), pulse(), "pos")
    dense = collapse_curve(case(model), pulse(), "pos", settings=SETTINGS)
    assert found["pga_median_g"] == pytest.approx(dense.summary()["pga_median_g"], rel=0.03)
    assert found["pga_p10_g"] <= found["pga_median_g"]
    assert found["runs_planar"] < dense.runs


def test_a_climb_that_begins_above_collapse_goes_below():
    """A pulse of seconds is a push, under which the block on E/h falls at less than 0.6 b/h."""
    t = 0.01 * np.arange(800)
    slow = Motion(Record("slow", np.sin(np.pi * t / 6.0) * (t < 6.0), 0.01, source="file"))
    own = case("W1")
    lifts = own["facade"]["thickness_m"] / own["facade"]["height_m"]
    dense = collapse_curve(own, slow, "neg", settings=SETTINGS).summary()["pga_median_g"]
    assert dense < 0.6 * lifts
    for settings in ({}, {"from_g": 3.0 * lifts}):
        curve = collapse_curve(own, slow, "neg", search="crossings", settings=settings)
        assert curve.found[-1] == pytest.approx(dense, rel=0.03)


@pytest.mark.parametrize("model", ["W1", "W2m"])
def test_curves_found_together_are_those_found_alone(model):
    """Of motions of other length and sampling, both directions, each with settings of its own."""
    own, first = case(model), pulse().record
    t = 0.005 * np.arange(500)
    second = Motion(Record("long", np.sin(4.0 * np.pi * t) * (t < 2.0), 0.005, source="file"))
    shaken = [(Motion(first), "pos"), (second, "neg"), (Motion(first), "neg")]
    settings = [{"max_pga_g": g} for g in (3.0, 2.0, 0.05)]
    how = {"search": "crossings", "fraction": 0.3}
    found = collapse_curves(own, shaken, settings=settings, **how)
    assert len({len(curve.table) for curve in found}) > 1  # searches end apart
    for curve, one, given in zip(found, shaken, settings, strict=True):
        alone = collapse_curve(own, *one, settings=given, **how)
        assert curve.table.equals(alone.table)
        assert curve.found == pytest.approx(alone.found, rel=0.0, nan_ok=True)


def test_settings_are_one_or_one_for_each():
    own, shaken = case("W1"), [(pulse(), "pos"), (pulse(), "neg")]
    with pytest.raises(ValueError, match="settings: 1 given, expected one, or 2"):
        collapse_curves(own, shaken, settings=[{}])
    for bad in (5, "abc", [{"max_pga_g": 1.0}]):
        with pytest.raises(TypeError, match="expected a mapping"):
            collapse_curve(own, *shaken[0], settings=bad)


def test_a_search_that_asks_for_nothing_leaves_the_others_theirs():
    """A climb that would begin above its end."""
    shaken = [(pulse(), "pos"), (pulse(), "neg")]
    settings = [{"from_g": 0.5, "max_pga_g": 0.2}, {"max_pga_g": 0.2}]
    nothing, some = collapse_curves(case("W1"), shaken, search="crossings", settings=settings)
    assert nothing.runs == 0
    assert np.isnan(nothing.found).all()
    assert some.runs > 0


def test_a_motion_keeps_the_floors_of_one_building():
    """A sample of thousands of buildings would fill the memory."""
    motion = pulse()
    for period_s in (0.2, 0.3, 0.4):
        motion.columns(study_case("W2", {"smdof.period_s": period_s}))
    assert len(motion._kept) == 1


def test_a_motion_shakes_each_case_by_the_floors_of_its_own_building():
    """One motion, asked by two cases in turn."""
    motion, floors = pulse(), {}
    for period_s in (0.2, 0.8, 0.2):
        own = study_case("W2", {"smdof.period_s": period_s, "smdof.tail_s": 1.0})
        found = motion.columns(own)[1]["floor1"]
        assert np.array_equal(floors.setdefault(period_s, found), found)
    assert not np.array_equal(floors[0.2], floors[0.8])


def test_a_façade_that_stands_has_no_crossing():
    found = crossings(case("W1"), pulse(), "pos", {"max_pga_g": 0.05})
    assert np.isnan(found["pga_p10_g"])
    assert np.isnan(found["pga_median_g"])


def test_levels_end_where_they_are_told_to():
    levels = search.rising(0.1, 0.5, 1.3)
    assert levels[0] == 0.1
    assert levels[-1] == 0.5
    assert np.all(np.diff(levels) > 0.0)
    assert search.rising(0.5, 0.1, 1.3).size == 0
