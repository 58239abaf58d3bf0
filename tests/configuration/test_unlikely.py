"""What a configuration may say, but hardly means."""

import math

import pytest
from rocking.configuration.config import resolve
from rocking.configuration.unlikely import lines


def test_a_coefficient_given_as_an_angle_is_doubted_with_the_angle_that_it_is():
    for section in ("facade", "return_wall"):
        (line,) = lines({"main": resolve({section: {"friction_deg": 0.6}})})
        assert line.startswith(f"{section}.friction_deg = 0.6: an angle in degrees")
        assert f"would be {math.degrees(math.atan(0.6)):.0f}" in line
    for angle in (0.0, 3.0, 30.0):  # none at all is an assumption, and may be one
        assert not lines({"main": resolve({"facade": {"friction_deg": angle}})})


@pytest.mark.parametrize(("mass_kg", "models", "said"), [(95, ["W2m"], 1), (95, ["W2"], 0)])
def test_a_building_lighter_than_its_façade_is_doubted_where_its_mass_counts(mass_kg, models, said):
    facade = {"height_m": 6.0, "thickness_m": 0.4, "width_m": 5.0, "density_kg_m3": 1000}
    given = {"models": models, "facade": facade, "return_wall": {"building_mass_kg": mass_kg}}
    found = lines({"one": resolve(given), "two": resolve(given)})
    assert len(found) == said
    assert all("less than the façade's own 12000 kg" in line for line in found)
    given["return_wall"] = {"building_mass_kg": 12001.0}
    assert not lines({"main": resolve(given)})


def test_settings_of_the_scan_that_w3_has_of_its_own_are_named():
    """Once, where they would be expected to hold: W3 is scanned, and its own are not stated."""

    def said(**config):
        block = {"facade": {"courses": 0}, "smdof": {"base_shear_ratio": None}}
        given = resolve({"models": ["W1", "W3"], "ida": {"level_ratio": 0.05}, **block, **config})
        return lines({"one": given, "two": given})

    line = "ida.level_ratio = 0.05 is not for the dense scan of W3, which takes w3.scan.level_ratio"
    assert said() == [f"{line} = 0.02"]
    both = said(ensemble={"realisations": 3}, models=["W3", "W3m"])
    assert both[1].startswith("ensemble.realisations = 3 is not for the dense scan of W3 and W3m")
    assert said(w3={"scan": {"level_ratio": 0.04}}) == []
    assert said(models=["W1", "W2"]) == []
    assert said(ida={"mode": "grid", "level_ratio": 0.05}) == []
    assert said(ida={"level_ratio": 0.02}) == []  # as W3's own
    assert said(ida={}) == []
