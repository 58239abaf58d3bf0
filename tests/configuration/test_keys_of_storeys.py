"""Keys of a building that yields: what they refuse, and what YADE is left to run."""

import pytest
from rocking import Case
from rocking.configuration import config as configuration
from rocking.configuration.schema import ConfigError

from yade_scripts.model.storeys import slides


@pytest.mark.parametrize(
    ("given", "named"),
    [
        ({"base_shear_ratio": 0.0}, "smdof.base_shear_ratio = 0"),
        ({"base_shear_ratio": "weak"}, "smdof.base_shear_ratio = 'weak'"),
        ({"loops": "takeda"}, "smdof.loops = 'takeda'"),
        ({"flag_share": 0.6}, "smdof.flag_share = 0.6"),
        (
            {"loss_drift_ratio": 0.03},
            "loss_drift_ratio = 0.03: expected.*smdof.lost_drift_ratio",
        ),
    ],
)
def test_what_is_no_building_is_named(given, named):
    with pytest.raises(ConfigError, match=named):
        configuration.resolve({"smdof": {"base_shear_ratio": 0.2, **given}})


def test_bricks_that_carry_a_building_have_an_elastic_one():
    given = {"smdof": {"base_shear_ratio": 0.2}, "models": ["W3m"]}
    given["return_wall"] = {"building_mass_kg": 66e3}
    with pytest.raises(ConfigError, match="base_shear_ratio = 0.2: expected null with model W3m"):
        configuration.resolve(given)
    configuration.resolve({**given, "models": ["W3"]})
    case = Case.configured("W3m", {"return_wall.building_mass_kg": 66e3})
    with pytest.raises(ValueError, match="base_shear_ratio = 0.2: expected null with model W3m"):
        case.varied({"smdof.base_shear_ratio": 0.2}).checked()


@pytest.mark.parametrize(
    ("smdof", "can"),
    [
        ({}, True),
        ({"loops": "flag", "base_shear_ratio": None}, True),  # the building is elastic
        ({"base_shear_ratio": 0.2}, True),
        ({"base_shear_ratio": 0.2, "loops": "flag"}, False),
        ({"base_shear_ratio": 0.2, "loss_drift_ratio": 0.004}, False),
    ],
)
def test_sliders_are_bilinear_loops_that_keep_their_strength(smdof, can):
    assert slides(configuration.resolve({"smdof": smdof})["smdof"]) is can
