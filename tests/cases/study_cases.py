"""The study's rigid block before its elastic building, and a pulse, for tests of these."""

import numpy as np
import pytest
from rocking import Case, Motion
from rocking.configuration import config
from rocking.configuration.study import as_in_the_study
from rocking.records import Record

# a façade with whatever makes one uneven: a gable, steps, openings, ties, a floor
UNEVEN = {
    "height_m": 8.0,
    "thickness_m": 0.6,
    "width_m": 7.5,
    "gable_height_m": 2.0,
    "thickness_steps": [{"z_m": 3.0, "thickness_m": 0.5}, {"z_m": 5.5, "thickness_m": 0.4}],
    "openings": [
        {"x_m": -2.0, "z_m": 1.0, "width_m": 1.0, "height_m": 1.6},
        {"x_m": 1.5, "z_m": 4.0, "width_m": 1.2, "height_m": 2.0},
    ],
    "ties": [{"height_m": 6.0}, {"height_m": 7.8}],
    "floors": [{"height_m": 4.0, "load_kn": 20.0, "anchor_kn": 10.0, "arm_m": 0.1}],
}


def study_case(model, given=None):
    """Case of a model on the study's keys, with those given laid over them."""
    return Case.configured(model, as_in_the_study(given))


def study_settings(given=None):
    """Resolved configuration on the study's keys, with those given laid over them."""
    return config.resolve(as_in_the_study(given))


def sine_pulse():
    """One sine of 0.8 s, which pulls a façade outward."""
    t = 0.01 * np.arange(160)
    return Motion(Record("pulse", -np.sin(2.5 * np.pi * t) * (t < 0.8), 0.01, source="file"))


def three(value, expected):
    """Equal to three figures."""
    assert value == pytest.approx(expected, rel=5e-4), (value, expected)
