"""Numbers that may be computed but are hardly meant, with the unit that was probably meant."""

from pathlib import Path

import pytest
import yaml
from rocking.configuration import unlikely
from rocking.configuration.config import ConfigError, expanded, resolve
from rocking.configuration.schema import leaves, whole

ROOT = Path(__file__).resolve().parents[2]
FILES = sorted((ROOT / "config").glob("**/*.yaml"))
FILES += sorted((ROOT / "workflow/studies").glob("*/scenario.yaml"))
TIE, FLOOR = {"height_m": 5.0}, {"height_m": 3.0}


def said(**given):
    return unlikely.lines({"main": resolve(given)})


@pytest.mark.parametrize(
    ("given", "key", "meant"),
    [
        (
            {"facade": {"ties": [TIE, {**TIE, "diameter_mm": 0.02}]}},
            "facade.ties[2].diameter_mm = 0.02 mm",
            "0.02 m would be 20 mm",
        ),
        (
            {"facade": {"floors": [{**FLOOR, "load_kn": 40000}]}},
            "facade.floors[1].load_kn = 40000 kN",
            "40000 N would be 40 kN",
        ),
        ({"smdof": {"period_s": 4.0}}, "smdof.period_s = 4 s", "4 Hz would be 0.25 s"),
        ({"ida": {"max_pga_g": 9.81}}, "ida.max_pga_g = 9.81 g", "9.81 m/s² would be 1 g"),
        ({"smdof": {"damping_ratio": 0.9}}, "smdof.damping_ratio = 0.9:", "0.9 % would be 0.009"),
    ],
)
def test_a_number_that_is_hardly_meant_is_said_with_what_was_probably_meant(given, key, meant):
    (line,) = said(**given)
    assert key in line
    assert "usual are" in line
    assert meant in line


def test_zero_and_what_lies_in_between_are_not_doubted():
    floor = {**FLOOR, "load_kn": 10.0, "anchor_kn": 0.0}
    assert not said(facade={"gap_m": 0.0, "tilt_deg": 0.0, "floors": [floor]})


def test_a_number_no_unit_makes_usual_is_said_without_a_guess():
    (line,) = said(facade={"height_m": 0.4, "thickness_m": 0.06})
    assert line == "facade.height_m = 0.4 m: usual are 0.5 to 30"


def test_a_refused_number_is_told_the_unit_that_makes_it_usual():
    with pytest.raises(ConfigError, match=r"≤ 50 \(m\); 6480 mm would be 6.48 m$"):
        resolve({"facade": {"height_m": 6480}})


@pytest.mark.parametrize(
    ("facade", "cause"),
    [
        (
            {"e_mpa": 1.8},
            "facade.e_mpa = 1.8 MPa: usual are 50 to 30000; 1.8 GPa would be 1800 MPa",
        ),
        (
            {"ties": [{**TIE, "e_mpa": 210}]},
            "ties[1].e_mpa = 210 MPa: usual are 5000 to 250000; 210",
        ),
    ],
)
def test_what_cannot_stand_for_a_number_in_another_unit_names_that_number(facade, cause):
    """The wall would fall by itself; the bar would yield beyond its elongation."""
    with pytest.raises(ConfigError) as caught:
        resolve({"facade": facade})
    assert cause in str(caught.value)


@pytest.mark.parametrize("path", FILES, ids=lambda path: f"{path.parent.name}/{path.name}")
def test_nothing_that_comes_with_the_project_is_doubted(path):
    given = yaml.safe_load(path.read_text("utf-8"))
    if not isinstance(given, dict) or not set(given) <= {*whole()["properties"], *STUDY}:
        pytest.skip("no configuration")
    runs = expanded(given)
    settled = {run: resolved for run, (resolved, _) in runs.items()}
    assert unlikely.lines(settled, {run: stated for run, (_, stated) in runs.items()}) == []


STUDY = {"scenario", "scenarios", "grid"}


def keys():
    """Yield (path, schema) of every number, those of lists and of their entries too."""
    for path, schema in leaves(whole()):
        entry = schema.get("items", {})
        yield from ((path, one) for one in (schema, entry, *entry.get("properties", {}).values()))


def test_what_is_usual_lies_within_what_is_allowed():
    usual = [(path, one) for path, one in keys() if "usual" in one]
    assert len(usual) > 50
    for path, one in usual:
        low, high = one["usual"]
        assert 0 < low < high, path
        assert low >= one.get("minimum", one.get("exclusiveMinimum", low)), path
        assert high <= one.get("maximum", one.get("exclusiveMaximum", high)), path
        default = one.get("default")
        assert not isinstance(default, float) or not default or low <= default <= high, path
