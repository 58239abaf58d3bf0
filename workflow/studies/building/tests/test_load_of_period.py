"""The floor load that gives a building its period, and what is said where none does."""

import pytest
from studies.building.case import load_of_period


def of_load(load_kg_m2):
    """Period of a mass that grows with the load: 0.2 s bare, √2 times at 100 kg/m²."""
    return 0.2 * (1.0 + load_kg_m2 / 100.0) ** 0.5


@pytest.mark.parametrize(
    ("target_s", "load"),
    [(0.2 * 2.0**0.5, 100.0), (0.3, 125.0), (0.1, 0.0), (0.2, 0.0), (9.0, 400.0), (0.5, 400.0)],
)
def test_the_load_is_that_of_the_period_or_the_end_on_its_side(target_s, load):
    """0 where the bare building is too slow, the largest where the loaded one is too fast."""
    assert load_of_period(of_load, target_s, 400.0, 1e-6) == pytest.approx(load, abs=1e-4)
