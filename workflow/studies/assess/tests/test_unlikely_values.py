"""Values of the report's keys that are hardly meant are said with what was probably meant."""

import pytest
from rocking.configuration import unlikely
from rocking.configuration.config import resolve


def said(**given):
    return unlikely.lines({"main": resolve(given)})


@pytest.mark.parametrize(
    ("given", "key", "meant"),
    [
        ({"assessment": {"ag_g": 1.18}}, "assessment.ag_g = 1.18 g", "1.18 m/s² would be 0.12 g"),
        ({"strengthening": {"yield_mpa": 0.3}}, "yield_mpa = 0.3 MPa", "0.3 GPa would be 300"),
    ],
)
def test_a_number_that_is_hardly_meant(given, key, meant):
    (line,) = said(**given)
    assert key in line
    assert meant in line


def test_a_usual_one_is_not_doubted():
    assert not said(assessment={"ag_g": 0.25})
