"""The defaults are what is recommended; the study is one scenario, and keeps its digits."""

import json
import re
from pathlib import Path

import pytest
import yaml
from rocking import Case
from rocking.configuration import schema
from rocking.configuration.config import ConfigError, expand_scenarios, resolve
from rocking.configuration.differences import flat
from rocking.configuration.settled import OF_THE_BUILDING
from rocking.configuration.study import FILE, as_in_the_study

ROOT = Path(__file__).resolve().parents[2]
SCENARIOS = sorted((ROOT / "config" / "scenarios").glob("*.yaml"))
# all keys of the study's run as they resolved when the study was the default
BEFORE = json.loads((ROOT / "tests/data/study_settings.json").read_text("utf-8"))
FEW_LINES = 12
WINDOW = {"z_m": 1.0, "width_m": 1.0, "height_m": 2.0}
# what pages and scenarios said of the defaults of before
OUTDATED = re.compile(
    r"without (it|these( two)? lines)[^.]{0,20}(the study's|a rigid) block"
    r"|the default is the study's( rigid)? block|the default, a rigid block",
    re.DOTALL,
)


def stated(path):
    return yaml.safe_load(path.read_text("utf-8"))


def test_the_recommended_answer_is_the_default():
    found = resolve({})
    assert found["models"] == ["W1", "W2", "W2m"]
    assert (found["facade"]["courses"], found["facade"]["courses_growth"]) == (4, 1.5)
    assert found["damping"]["law"] == "eq5"
    assert found["smdof"]["base_shear_ratio"] == 0.2
    assert found["records_table"] == "config/suites/two_stations.tsv"
    assert resolve(found) == found
    main = expand_scenarios(stated(ROOT / "config" / "config.yaml"))
    assert main == {"main": found}


@pytest.mark.skipif(not any(schema.STUDIES.glob("*/rules.smk")), reason="studies are deleted")
def test_the_study_keeps_every_key_it_had():
    found, before = flat(resolve(stated(FILE))), flat(BEFORE)
    assert before.items() <= found.items()


def test_a_configuration_with_the_keys_of_the_study_has_its_case():
    """Whatever else it states, its façade, β and building are those of before."""
    own = {"facade": {"height_m": 5.0}, "smdof": {"period_s": 0.4}}
    case = Case.configured("W2", as_in_the_study(own))
    for section in ("facade", "return_wall", "smdof"):
        known = {**BEFORE[section], **own.get(section, {})}
        assert known.items() <= dict(case[section]).items()
    assert case["beta_s"] == 0.00276


@pytest.mark.parametrize(
    ("given", "courses"),
    [
        ({"facade": {"hinges_m": [4.0]}}, 0),
        ({"facade": {"tilt_deg": 0.2}}, 4),
        ({"facade": {"wedge_deg": 10.0, "wedge_thickness_m": 0.6}}, 0),
        ({"facade": {"base": "column"}}, 0),
        ({"facade": {"base": "study"}}, 4),  # stated as it is
        ({"facade": {"ties": [{"height_m": 6.0}], "gable_height_m": 1.0}}, 4),
        ({"models": ["W3", "W1c"]}, 0),
    ],
)
def test_what_says_itself_which_blocks_the_façade_is_has_no_courses(given, courses):
    found = resolve(given)["facade"]
    assert (found["courses"], found["courses_growth"]) == (courses, 1.5 if courses else 1.0)


def test_a_run_of_courses_and_of_bricks_is_refused():
    """They would be two walls; stated, the façade is one block in both."""
    with pytest.raises(ConfigError, match=r"models = W3: .*courses = 4, or .* = 0, one block"):
        resolve({"models": ["W1", "W3"]})
    assert resolve({"models": ["W1", "W3"], "facade": {"courses": 0}})["models"] == ["W1", "W3"]


def test_stated_courses_are_equal_unless_their_growth_is_stated():
    assert resolve({"facade": {"courses": 20}})["facade"]["courses_growth"] == 1.0
    assert resolve({"facade": {"courses_growth": 1.2}})["facade"]["courses"] == 4


def test_a_stated_damping_is_taken_and_a_free_wall_has_no_law():
    assert resolve({"damping": {"beta_s": 0.00276}})["damping"]["law"] == "value"
    assert resolve({"damping": {"beta_s": 0.001, "law": "eq5"}})["damping"]["law"] == "eq5"
    assert resolve({"facade": {"sides": "two"}, "models": ["W1"]})["damping"]["law"] == "value"


@pytest.mark.parametrize(
    ("own", "volume_m3", "building_over_facade"),
    [
        ({"height_m": 8.0, "thickness_m": 0.5, "width_m": 5.0}, 20.0, 1.0),
        (
            {"height_m": 8.0, "openings": [{"z_m": 1.0, "width_m": 1.0, "height_m": 2.0}]},
            12.45,
            1.0,
        ),
        ({"height_m": 3.0, "base_height_m": 3.0}, 4.95, 2.0),  # as if it stood on its like
    ],
)
def test_the_building_weighs_as_in_the_study_unless_stated(own, volume_m3, building_over_facade):
    found = resolve({"facade": own})["return_wall"]["building_mass_kg"]
    expected = 1800.0 * volume_m3 * building_over_facade / OF_THE_BUILDING
    assert found == pytest.approx(expected, rel=1e-3)  # four digits
    given = {"facade": own, "return_wall": {"building_mass_kg": None}}
    assert resolve(given)["return_wall"]["building_mass_kg"] is None


def test_an_own_façade_takes_few_lines():
    text = (ROOT / "config/scenarios/own_facade.yaml").read_text("utf-8")
    lines = [line for line in text.splitlines() if line.strip() and line.strip()[0] != "#"]
    assert len(lines) <= FEW_LINES
    (found,) = expand_scenarios(yaml.safe_load(text)).values()
    default = resolve({})
    assert found["records_table"] == "config/suites/recorded_suite.tsv"
    for key in ("facade.courses", "facade.courses_growth", "damping.law"):
        section, name = key.split(".")
        assert found[section][name] == default[section][name]
    assert found["models"] == default["models"]
    assert found["smdof"]["base_shear_ratio"] is not None


@pytest.mark.parametrize("path", SCENARIOS, ids=lambda path: path.name)
def test_no_scenario_states_what_is_recommended_anyway(path):
    given = stated(path)
    facade = given.get("facade", {})
    assert facade.get("courses") != 4 or facade.get("courses_growth") != 1.5
    assert given.get("models") != ["W1", "W2", "W2m"]
    assert given.get("damping") != {"law": "eq5"}


def test_pages_and_scenarios_do_not_speak_of_the_defaults_of_before():
    pages = [*ROOT.glob("*.md"), *ROOT.glob("docs/*.md"), *ROOT.glob("workflow/studies/*/page.md")]
    for path in [*pages, *SCENARIOS, ROOT / "config/config.yaml"]:
        found = OUTDATED.search(path.read_text("utf-8"))
        assert found is None, f"{path.relative_to(ROOT)}: {found[0]!r}"
