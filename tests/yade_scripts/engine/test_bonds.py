"""Bonded nodes in YADE against closed forms; the cases and what they assert: bond_cases."""

import bond_cases
import pytest
from yade_process import in_yade

CASES = (
    "elastic_both_ways",
    "energy_is_kept",
    "peeling",
    "pure_shear",
    "slanted_shear",
    "uniform_pull",
)


@pytest.mark.yade
@pytest.mark.parametrize("case", CASES)
def test_bond_in_yade(case):
    in_yade("bond_cases", case)


def test_strengths_of_the_facade_are_those_of_its_area():
    bond_cases.facade_loads()
