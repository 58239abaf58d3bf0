"""One motion shakes models in any order: each has the building that its own case states."""

import itertools

import numpy as np
import pytest
from rocking import Motion
from rocking.collapse.curve import run_by
from rocking.collapse.scan import together
from study_cases import study_case

MODELS = ("W1", "W2", "W2m")
LEVELS_G = np.array([0.08, 0.16, 0.24])


def ground():
    t = np.arange(0.0, 4.0, 0.01)
    a = np.where(t < 1.2, np.sin(2.0 * np.pi * t / 0.6), 0.0)
    return Motion.sampled(a, 0.01, "m/s2", name="ground")


def peaks(model, motion, strength):
    building = {"smdof": {"base_shear_ratio": strength}}
    case = study_case(model, building | {"return_wall": {"building_mass_kg": 77000.0}})
    (table,) = together([(run_by("planar", case, motion, "pos"), LEVELS_G, False)])
    return np.asarray(table["d_over_b"]).tolist()


@pytest.fixture(scope="module")
def alone():
    """Peaks of each model and strength, each under a motion that nothing else has asked."""
    asked = itertools.product(MODELS, (None, 0.1))
    return {one: peaks(one[0], ground(), one[1]) for one in asked}


def test_the_building_s_strength_tells(alone):
    assert alone["W2", 0.1] != alone["W2", None]
    assert alone["W1", 0.1] == alone["W1", None]


@pytest.mark.parametrize("order", list(itertools.permutations(MODELS)))
def test_the_order_of_models_does_not_tell(alone, order):
    motion = ground()
    for model, strength in itertools.product(order, (0.1, None, 0.1)):
        assert peaks(model, motion, strength) == alone[model, strength]
