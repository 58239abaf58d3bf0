"""Classes of façades: mixtures of their fragilities, distributions of what they are, refusals."""

import math

import numpy as np
import pandas as pd
import pytest
from formula_cases import ROW
from rocking.formula import groups, law

from studies.atlas import classes


def test_class_of_one_facade_is_that_facade():
    found = classes.fragility(pd.DataFrame([ROW]), "W2m")
    median, dispersion, _ = law.said(ROW, "W2m")
    assert found["median"] == pytest.approx(median, rel=1e-12)
    assert found["dispersion"] == pytest.approx(dispersion, rel=1e-12)
    assert found["by_facade"] == 0.0
    same = classes.fragility(pd.DataFrame([ROW] * 5), "W2m")
    assert same["dispersion"] == pytest.approx(dispersion, rel=1e-12)


def test_class_of_two_facades_by_hand():
    """θ = √(0.2·0.8) = 0.4; ln θ_i = ± ln 2 about it, so β_f = ln 2; β_m² = (0.3² + 0.4²)/2."""
    median, beta, by_facade, by_motion = classes.combined([0.2, 0.8], [0.3, 0.4])
    assert median == pytest.approx(0.4)
    assert by_facade == pytest.approx(math.log(2.0))
    assert by_motion == pytest.approx(math.sqrt(0.125))
    assert beta == pytest.approx(math.sqrt(math.log(2.0) ** 2 + 0.125))
    # at the median the mixture is one half, for it is symmetrical there if the dispersions are
    assert classes.mixture(0.4, [0.2, 0.8], [0.3, 0.3]) == pytest.approx(0.5)


def test_class_has_the_mean_and_the_variance_of_its_mixture():
    medians, spreads, weights = [0.2, 0.3, 0.7], [0.3, 0.35, 0.4], [1.0, 2.0, 1.0]
    median, beta, _, _ = classes.combined(medians, spreads, weights)
    x = np.linspace(-8.0, 6.0, 200_001)
    cdf = classes.mixture(np.exp(x), medians, spreads, weights)
    density, middle = np.diff(cdf), 0.5 * (x[1:] + x[:-1])
    mean = density @ middle
    assert mean == pytest.approx(math.log(median), abs=1e-6)
    assert density @ (middle - mean) ** 2 == pytest.approx(beta**2, abs=1e-6)


def test_class_of_distributions_keeps_to_them():
    rows = [
        {"parameter": "height_m", "distribution": "uniform", "low": 5.0, "high": 9.0},
        {"parameter": "thickness_m", "distribution": "lognormal", "median": 0.5, "spread": 0.1}
        | {"low": 0.45, "high": 0.55},
        {"parameter": "storeys", "distribution": "choice", "values": [2, 3]},
    ]
    rest = ("e_mpa", "density_kg_m3", "friction_deg", "period_s", "mass_ratio", "contact_damping")
    rows += [{"parameter": name, "distribution": "value", "median": ROW[name]} for name in rest]
    table = classes.sampled({"samples": 256, "seed": 1, "parameters": rows})
    thick = table["height_m"] / table["slenderness"]
    assert table["height_m"].between(5.0, 9.0).all()
    assert thick.between(0.45, 0.55).all()
    assert np.median(thick) == pytest.approx(0.5, rel=0.01)
    assert set(table["storeys"]) == {2.0, 3.0}
    without = [row for row in rows if row["parameter"] != "friction_deg"]
    with pytest.raises(ValueError, match="friction_deg is missing"):
        classes.sampled({"samples": 8, "seed": 1, "parameters": without})


@pytest.mark.parametrize(
    ("row", "said_of"),
    [
        ({"distribution": "value"}, "value without median; expected median"),
        ({"distribution": "uniform", "low": 5.0}, "uniform without high; expected low and high"),
        ({"distribution": "lognormal", "median": 5.0}, "lognormal without spread"),
        ({"distribution": "choice"}, "choice without values"),
        ({"distribution": "uniform", "low": 9.0, "high": 5.0}, "from 9 to 5; expected low < high"),
    ],
)
def test_row_of_a_class_that_is_incomplete_ends_in_one_line(row, said_of):
    settings = {"samples": 8, "seed": 1, "parameters": [{"parameter": "height_m", **row}]}
    with pytest.raises(ValueError, match="facade_class.parameters: height_m: ") as said:
        classes.sampled(settings)
    assert said_of in str(said.value)
    assert "\n" not in str(said.value)


def test_class_outside_of_the_formula_is_refused():
    rows = pd.DataFrame([ROW] * 8 + [{**ROW, "period_s": 2.0}])
    with pytest.raises(groups.OutsideError, match="11 % of it lie outside"):
        classes.fragility(rows, "W2m")
    assert classes.fragility(rows, "W1")["n_outside"] == 0
