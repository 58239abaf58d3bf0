"""Cases, variants, motions and curves as the public interface has them."""

import doctest
import importlib
import re
import subprocess
import sys
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import rocking
from rocking import Case, Curve, Motion, Variant, collapse_curve, history
from rocking.collapse.curve import strategy
from rocking.collapse.scan import scan_settings
from rocking.configuration.config import ConfigError
from rocking.records import RecordError
from study_cases import sine_pulse, study_case

from yade_scripts.model import floor_motions

pulse = pytest.fixture(sine_pulse, scope="module")


@pytest.fixture(scope="module")
def case():
    """W1, its motion followed for three seconds."""
    return study_case("W1", {"numerics.after_motion_s": 3.0, "smdof": {"tail_s": 1.0}})


@pytest.mark.parametrize("name", ["case", "curve", "motion"])
def test_the_examples_of_the_documentation_run(name):
    found = doctest.testmod(importlib.import_module(f"rocking.collapse.{name}"))
    assert found.attempted
    assert not found.failed


def test_importing_the_package_loads_no_solver():
    code = "import sys, rocking; assert not {'numba', 'pandas', 'scipy'} & set(sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True, timeout=120)
    assert all(hasattr(rocking, name) for name in rocking.__all__)


def test_a_variant_changes_what_it_names_and_nothing_else(case):
    variant = Variant(
        "changed",
        changes={"facade.friction_deg": 20.0, "model": "W1c"},
        factors={"facade.thickness_m": 1.1, "beta_s": 2.0},
        added={"facade.ties": [{"height_m": 6.0, "count": 2, "diameter_mm": 20.0}]},
    )
    changed = case.varied(variant)
    assert changed["beta_s"] == 2.0 * case["beta_s"]
    assert changed["facade"]["thickness_m"] == pytest.approx(1.1 * case["facade"]["thickness_m"])
    (tie,) = changed["facade"]["ties"]
    assert tie["yield_mpa"] > 0.0  # completed from the schema
    assert changed.model == "W1c"
    assert case["facade"]["ties"] == []
    same = {**changed["facade"], **{k: case["facade"][k] for k in ("friction_deg", "thickness_m")}}
    assert {**same, "ties": []} == case["facade"]
    assert case.varied(Variant()).sections == case.sections


def test_a_variant_takes_a_share_of_the_vertical_motion(pulse):
    up = np.linspace(0.0, 1.0, 160)
    both = Motion(replace(pulse.record, vertical_m_s2=up))
    half = both.varied(Variant(motion={"vertical": 0.5})).record
    assert np.array_equal(half.vertical_m_s2, 0.5 * up)
    assert np.array_equal(half.acceleration_m_s2, pulse.record.acceleration_m_s2)
    assert both.varied(Variant(motion={"vertical": 0.0})).record.vertical_m_s2 is None
    assert np.array_equal(both.varied(Variant()).record.vertical_m_s2, up)


def test_what_cannot_be_is_refused_in_a_line(case, pulse):
    for variant in (Variant(changes={"facade.hight_m": 1.0}), Variant(factors={"walls.x": 2.0})):
        with pytest.raises(ValueError, match="the case has no such key"):
            case.varied(variant)
    with pytest.raises(ConfigError, match="hight_m"):
        Case.configured("W1", {"facade.hight_m": 1.0})
    with pytest.raises(ValueError, match="unknown change of the motion"):
        pulse.varied(Variant(motion={"loudness": 2.0}))
    with pytest.raises(ValueError, match="record pulse has no vertical motion"):
        pulse.varied(Variant(motion={"vertical": 0.5}))
    with pytest.raises(ValueError, match="building_mass_kg"):
        collapse_curve(study_case("W2m"), pulse)
    with pytest.raises(ValueError, match="expected planar or yade"):
        collapse_curve(case, pulse, solver="scipy")
    with pytest.raises(ValueError, match="expected scan, climb"):
        collapse_curve(case, pulse, search="bisect")


@pytest.mark.parametrize(
    ("variant", "words"),
    [
        ({"facade.thickness_m": -0.5}, "facade.thickness_m = -0.5: expected a number > 0"),
        ({"facade.thickness_m": "42 cm"}, "facade.thickness_m = '42 cm': expected a number"),
        ({"facade.thicknes_m": 0.5}, "did you mean 'thickness_m'?"),
        ({"model": "W4"}, "unknown façade model 'W4'"),
        ({"model": "W3"}, "a case that was configured with bricks"),
        (
            {"facade.height_m": 0.5},
            "facade.height_m = 0.5: expected at least 2 × facade.thickness_m",
        ),
        (Variant(factors={"facade.thickness_m": 9.0}), "for a wall that rocks"),
        ({"return_wall.thickness_m": 3.0}, "return_wall.count = 2: expected count × thickness_m"),
        ({"facade.hinges_m": [7.0]}, "expected heights below facade.height_m"),
        ({"facade.gap_m": 0.5}, "expected a value below facade.thickness_m = 0.375"),
        ({"model": "W2cm", "facade.courses": 5}, "models = W2cm: expected W1, W2 or W2m"),
        (Variant(factors={"facade.thickness_m": -1.0}), "facade.thickness_m = -0.375: expected"),
        (Variant(factors={"return_wall.length_m": 2.0}), "return_wall.length_m = null: expected"),
        (Variant(factors={"damping.law": 2.0}), "damping.law = 'value': expected a number"),
        (Variant(added={"facade.height_m": [1.0]}), "facade.height_m: expected rows added to"),
        (Variant(added={"facade.ties": {"height_m": 5.0}}), "facade.ties: expected rows added to"),
        (Variant(added={"facade.ties": [{"hieght_m": 5.0}]}), "'facade.ties[1].hieght_m'"),
        (Variant(added={"facade.ties": [{"diameter_mm": 9}]}), "facade.ties[1].height_m: missing"),
        (Variant(added={"facade.ties": [{"height_m": 60}]}), "expected at most facade.height_m"),
        ({"facade": {"height_m": 5.0}}, "facade: expected single values by dotted key"),
    ],
)
def test_a_variant_is_held_to_what_the_configuration_allows(case, variant, words):
    with pytest.raises(ValueError, match=re.escape(words)) as caught:
        case.varied(variant)
    assert str(caught.value).isprintable()


def test_numbers_of_numpy_are_numbers(case):
    thick = np.linspace(0.3, 0.4, 3)
    assert case.varied({"facade.thickness_m": thick[1]}).get("facade.thickness_m") == thick[1]
    chain = study_case("W2", {"smdof.n_dof": np.arange(4)[3]})
    assert chain["smdof"]["n_dof"] == 3
    assert Case(chain.sections).to_json()  # plain, so that it can be written


def test_samples_in_memory_are_a_motion_whatever_their_units():
    g = [0.0, 0.1, -0.2, 0.0]
    one = Motion.sampled(g, 0.02, "g", name="mine")
    other = Motion.sampled(980.665 * np.array(g), 0.02, "cm/s2")
    np.testing.assert_allclose(one.record.acceleration_m_s2, other.record.acceleration_m_s2)
    assert (one.name, one.record.dt_s) == ("mine", 0.02)
    for given, words in (
        ((g, 0.02, "cm/s"), "units 'cm/s'; expected one of g, m/s2"),
        ((g, 2.0), "time step 2 s; expected"),
        (([0.0], 0.02), "expected at least 2 samples"),
        (([g, g], 0.02), "shape (2, 4); expected one row"),
        (("0.1 0.2", 0.02), "expected samples and a step (s)"),
        ((g, "20 ms"), "expected samples and a step (s)"),
        (([0.0, np.nan], 0.02), "not all samples are finite"),
        ((np.array(g) * 980.0, 0.02, "g"), "are the units right?"),
    ):
        with pytest.raises(RecordError, match=re.escape(words)):
            Motion.sampled(*given)
    with pytest.raises(TypeError, match=r"Motion of list: .*Motion\.sampled"):
        Motion(g)


def test_what_is_no_case_file_is_said_in_one_line(tmp_path):
    other, broken = tmp_path / "other.json", tmp_path / "broken.json"
    other.write_text('{"model": "W1"}')
    broken.write_text("{")
    for path in (other, broken, tmp_path / "nowhere.json"):
        with pytest.raises(ValueError, match="expected a case file") as caught:
            Case.read(path)
        assert str(caught.value).startswith(f"{path}: ")
    with pytest.raises(TypeError, match="list given: expected a file, or values by key"):
        Case.configured("W1", [1])


def test_what_a_curve_is_asked_for_is_checked_before_anything_runs(case, pulse):
    for given, words in (
        ({"direction": "outward"}, "direction = 'outward': expected pos or neg"),
        ({"search": "climb", "settings": {"levelratio": 0.1}}, "did you mean 'level_ratio'?"),
        ({"search": "climb", "settings": {"level_ratio": -0.1}}, "a number from 0.001 to 0.1"),
        ({"search": "climb", "settings": {"max_pga_g": "1 g"}}, "expected a number > 0"),
        ({"search": "list"}, "expected settings={'pga_g'"),
        ({"search": "list", "settings": {"pga_g": [0.1, -0.1]}}, "-0.1: expected a number > 0"),
    ):
        with pytest.raises(ValueError, match=re.escape(words)):
            collapse_curve(case, pulse, **given)
    for wrong in ((case, "RRS228"), (pulse, case), ({"model": "W1"}, pulse)):
        with pytest.raises(TypeError, match="expected a (Case|Motion)"):
            collapse_curve(*wrong)
    with pytest.raises(ValueError, match=r"pga_g = -0\.1: expected a number > 0"):
        history(case, pulse, "pos", -0.1)
    one = collapse_curve(case, pulse, search="list", settings={"pga_g": 0.05})
    assert isinstance(one, Curve)
    assert repr(one) == "Curve W1 pulse pos: 1 histories, none fell up to 0.050 g"


def test_a_configuration_file_is_read_as_the_workflow_reads_it(tmp_path):
    path = tmp_path / "mine.yaml"
    for text, words in (
        ("facade: {height_m: 5}\nfacade: {width_m: 4}\n", "line 2: key 'facade' stands twice"),
        ("facade:\n\theight_m: 5\n", "mine.yaml line 2"),
        ("grid: {facade.height_m: [5, 6]}\n", "grid: describes several cases"),
    ):
        path.write_text(text)
        with pytest.raises(ValueError, match=re.escape(words)):
            Case.configured("W1", path)
    with pytest.raises(ConfigError, match="No such file"):
        Case.configured("W1", tmp_path / "none.yaml")


def test_a_prompt_shows_the_public_names():
    assert {"Case", "Motion", "collapse_curve"} <= set(dir(rocking))


def test_a_curve_knows_where_it_collapses(case, pulse):
    """The dense scan and the short climb cross one half at one place; a list runs its list."""
    fewer = {"level_ratio": 0.05, "realisations": 7, "max_pga_g": 1.5}
    dense = collapse_curve(case, pulse, settings=fewer)
    found = dense.summary()
    assert found["pga_safe_g"] < found["pga_collapse_g"]
    step = 2.0 * 0.01 / 7  # one half lies between the last that stands and the first that falls
    assert found["pga_collapse_g"] <= (1.0 + step) * found["pga_median_g"]
    quick = collapse_curve(case, pulse, search="crossings", settings=fewer, fraction=0.3)
    assert quick.found[1] == pytest.approx(found["pga_median_g"], rel=0.03)
    assert quick.runs < dense.runs
    levels = [0.9 * found["pga_collapse_g"], 1.1 * found["pga_all_g"]]
    listed = collapse_curve(case, pulse, search="list", settings={"pga_g": levels})
    assert list(listed.status) == ["ok", "overturned"]
    assert list(listed.pga_g) == levels


def test_a_scan_begins_where_it_is_told_to():
    """`ida.start_g` of the case; a setting of the call stands above it, half the capacity below."""
    outcomes = SimpleNamespace(static_g=0.2, block=4)
    stated = study_case("W1", {"ida": {"start_g": 0.7}})
    for one, more, expected in (
        (study_case("W1"), {}, 0.1),
        (stated, {}, 0.7),
        (stated, {"from_g": 0.3}, 0.3),
    ):
        for name in ("scan", "climb"):
            asked = next(strategy(name, one, outcomes, {**scan_settings(one.sections), **more}))
            assert asked.pga_g[0] == pytest.approx(expected)


def test_two_shocks_on_one_time_axis():
    """Each as it shakes, rest between them, the vertical motion upward in either direction."""
    t, s = np.arange(0.0, 0.05, 0.01), np.arange(0.0, 0.03, 0.005)
    first = floor_motions.scaled({"ground": np.ones(5), "vertical": np.ones(5)}, -2.0)
    assert first["vertical"][0] == 2.0
    times, both = floor_motions.after((t, first, 1.0), s, {"ground": 3.0 * np.ones(6)})
    assert np.all(np.diff(times) > 0.0)
    assert times[-1] == pytest.approx(0.04 + 1.0 + 0.025)
    at = np.interp([0.02, 0.5, 1.045, 1.06], times, both["ground"])
    assert at == pytest.approx([-2.0, 0.0, 3.0, 3.0])
    assert np.interp(1.06, times, both["vertical"]) == 0.0
    with pytest.raises(ValueError, match=r"pause of 0\.01 s"):
        floor_motions.after((t, first, 0.01), s, {"ground": np.ones(6)})


def test_a_shock_that_leaves_nothing_changes_no_answer(case, pulse):
    """A dry façade lifted by a first shock and at rest again answers the second as if alone."""
    after = Motion(pulse.record, first=pulse, first_pga_g=0.1, pause_s=8.0)
    levels = {"pga_g": [0.15, 0.2]}
    one, two = (collapse_curve(case, m, search="list", settings=levels) for m in (pulse, after))
    assert np.all(one.table["d_over_b"] > 0.05)
    assert two.table["d_over_b"].to_numpy() == pytest.approx(one.table["d_over_b"], rel=1e-3)


def test_bonds_that_a_first_shock_breaks_stay_broken(pulse):
    """A bonded façade shaken beyond its bonds answers as the dry one from then on."""
    weak = {"return_wall.tension_mpa": 0.008, "return_wall.cohesion_mpa": 0.008}
    weak |= {"numerics.after_motion_s": 3.0, "smdof.tail_s": 1.0}
    bonded, dry = study_case("W1c", weak), study_case("W1", weak)
    after = Motion(pulse.record, first=pulse, first_pga_g=0.2, pause_s=8.0)

    def peak(case, motion):
        curve = collapse_curve(case, motion, search="list", settings={"pga_g": [0.15]})
        return curve.table["d_over_b"].iloc[0]

    assert peak(bonded, pulse) < 0.01  # its bonds hold
    assert peak(bonded, after) == pytest.approx(peak(dry, pulse), rel=0.01)


@pytest.mark.yade
def test_yade_and_the_planar_solver_answer_alike(case, pulse):
    """One history and two intensities of a list, by either; YADE in a process of its own."""
    levels = {"pga_g": [0.15, 0.8]}
    by = {
        solver: collapse_curve(case, pulse, solver=solver, search="list", settings=levels).table
        for solver in ("planar", "yade")
    }
    assert list(by["yade"]["status"]) == list(by["planar"]["status"]) == ["ok", "overturned"]
    assert by["yade"]["d_over_b"][0] == pytest.approx(by["planar"]["d_over_b"][0], rel=0.01)
    peaks = [rocking.history(case, pulse, "pos", 0.15, solver=s).d_over_b for s in by]
    assert peaks[1] == pytest.approx(peaks[0], rel=0.01)


def test_what_is_no_variant_is_refused_in_one_line():
    with pytest.raises(TypeError, match="str given: expected a Variant, or new values by dotted"):
        study_case("W2").varied("thicker")
