"""What is chosen of a building's modes, and the number of masses, by hand."""

import numpy as np
import pytest
from studies.building.case import translation_mode
from studies.building.comparison import choose_n
from studies.building.modes import Modes


@pytest.mark.parametrize("order", [(0, 1, 2, 3, 4, 5), (5, 4, 3, 2, 1, 0), (4, 0, 3, 5, 1, 2)])
def test_the_fewest_masses_are_chosen_whatever_the_order_of_the_rows(order):
    """Means 0.30, 0.12, 0.11: within 0.2 of what follows the first, within 0.01 the second."""
    rows = [(2, 0.2), (2, 0.4), (4, 0.1), (4, 0.14), (6, 0.1), (6, 0.12)]
    rows = [rows[k] for k in order]
    assert choose_n(rows, 0.2) == 2
    assert choose_n(rows, 0.0101) == 4
    assert choose_n(rows, 0.005) == 6


@pytest.mark.parametrize(
    ("means", "n"), [((0.30, 0.31, 0.32, 0.33, 0.34), 1), ((0.30, 0.32, 0.32, 0.20, 0.20), 4)]
)
def test_more_masses_that_gain_nothing_yet_may_still(means, n):
    assert choose_n(enumerate(means, 1), 0.01) == n


def modes(along_y):
    """Modes with such shares of the mass along y."""
    ratio = np.zeros((len(along_y), 6))
    ratio[:, 1] = along_y
    found = object.__new__(Modes)
    object.__setattr__(found, "effective_ratio", ratio)
    return found


@pytest.mark.parametrize(("along_y", "mode"), [((0.04, 0.2, 0.7), 2), ((0.3, 0.6, 0.05), 1)])
def test_the_translation_is_the_mode_that_moves_the_most_mass(along_y, mode):
    assert translation_mode(modes(along_y)) == mode
