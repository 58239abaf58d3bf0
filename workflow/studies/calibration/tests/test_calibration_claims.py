"""Claims on damping: each can hold and each can fail, on hand-made free rocking."""

import numpy as np
import pandas as pd
import pytest
from rocking.mechanics import closed_forms
from studies.calibration import claims

E_1SR = 0.446
BETAS = (*claims.LOW, *claims.HIGH)
# e_exp/|e_1SR| of the three impacts by β, as the study tells it
AS_TOLD = {
    0.000125: (1.5, 1.4, 1.5),
    0.00025: (0.68, 1.2, 1.4),
    0.0005: (0.60, 1.1, 1.3),
    0.001: (0.56, 0.80, 1.03),
    0.002: (0.15, 0.33, 0.5),
    0.004: (0.08, 0.29, 0.4),
    0.0058: (0.07, 0.2, 0.4),
}
FREE = {"wall": "sorrentino"}


def free_table(ratios=None, rebounds=None):
    """Contract of free_rocking.csv; θ₁ after eq. 4 unless given by β."""
    rows = []
    for beta, values in (ratios or AS_TOLD).items():
        for n, ratio in enumerate(values, 1):
            energy = (ratio * E_1SR) ** (2 * n) * (1.0 - 0.5**2)
            theta = 1.0 - np.sqrt(max(1.0 - energy, 0.0))
            if rebounds and n == 1:
                theta = rebounds.get(beta, theta)
            rows.append(("sorrentino", beta, n, theta, ratio * E_1SR, E_1SR))
    columns = ["wall", "beta_s", "n", "theta_over_alpha", "e_exp", "e_1sr"]
    return pd.DataFrame(rows, columns=columns)


FITS = pd.DataFrame({"beta_fit_s": [0.9e-3, 1.1e-3], "beta_eq5_s": [1e-3, 1e-3]})
WALLS = pd.DataFrame(
    {
        "role": ["reference", "ratio", "other"],
        "e1_over_e1sr": [0.7, 0.8, 1.0],
        "e2_over_e1sr": [0.8, 0.8, 1.3],
        "e3_over_e1sr": [0.95, 0.9, 1.3],
    }
)


def verdicts(free=None, fits=FITS, walls=WALLS):
    rows = claims.evaluate(free_table() if free is None else free, fits, walls)
    return {row["claim"]: row for row in rows}


def holds(found, start):
    return next(row["holds"] for claim, row in found.items() if claim.startswith(start))


def test_equation_five_is_checked_as_printed():
    """0.000941, 0.000859 and 0.00277 s by hand; the first is 5.9 % below 0.001, not 5 %."""
    found = verdicts()
    for wall in ("Sorrentino", "Shawa", "façade"):
        assert holds(found, f"eq. 5 gives the β printed for the wall: {wall}") == "yes"
    assert holds(found, "eq. 5 is within 5 % of the β that matches the test") == "no"
    assert holds(found, "eq. 5 is very similar") == "yes"
    text = found["eq. 5 is within 5 % of the β that matches the test"]["measured"]
    assert text.startswith("5.9 %")


def test_what_the_study_tells_holds_on_its_own_numbers():
    found = verdicts()
    for claim in (
        "the simulation with β = 0.00025",
        "β = 0.001 s has",
        "up to β = 0.001 s most",
        "above β = 0.002 s",
        "e_exp of the third impact",
        "eq. 5 describes",
    ):
        assert holds(found, claim) == "yes", claim


@pytest.mark.parametrize(
    ("claim", "change"),
    [
        (
            "the simulation with β",
            {"free": free_table({**AS_TOLD, 0.0005: (0.68, 1.1, 1.3)} | {0.00025: (0.9, 1, 1)})},
        ),
        ("β = 0.001 s has", {"free": free_table({**AS_TOLD, 0.0005: (0.6, 0.80, 1.0)})}),
        ("up to β = 0.001 s most", {"free": free_table({**AS_TOLD, 0.000125: (1.7, 1.4, 1.5)})}),
        ("above β = 0.002 s", {"free": free_table(rebounds={0.002: 0.02})}),
        ("above β = 0.002 s", {"free": free_table(rebounds={0.0005: 0.004})}),
        ("e_exp of the third", {"walls": WALLS.assign(e3_over_e1sr=0.5)}),
        ("eq. 5 describes", {"fits": FITS.assign(beta_fit_s=[0.5e-3, 1e-3])}),
    ],
)
def test_each_claim_can_fail(claim, change):
    assert holds(verdicts(**change), claim) == "no"


@pytest.mark.parametrize(("rebound", "holds"), [(0.008, "yes"), (0.0045, "no")])
def test_overdamped_is_a_rebound_below_a_hundredth_of_the_release(rebound, holds):
    """Released at θ0/α = 0.5: 0.008 is 1.6 % of it and rocks, 0.0045 is 0.9 % and does not."""
    found = verdicts(free=free_table(rebounds={0.0005: rebound}))
    assert holds == found[next(c for c in found if c.startswith("above β = 0.002 s"))]["holds"]


def test_undamped_means_that_energy_stays():
    """Restitution 1 after the first impact keeps everything, the study's ranges leave a twelfth."""
    kept = {b: (0.7, 0.7**0.5 / E_1SR**0.5, 0.7 ** (1 / 3) / E_1SR ** (2 / 3)) for b in BETAS}
    assert holds(verdicts(free=free_table(kept)), "the second and third bounces") == "yes"
    assert holds(verdicts(), "the second and third bounces") == "no"
    text = verdicts(free=free_table(kept))[
        "the second and third bounces remain mostly undamped there"
    ]
    assert text["measured"].startswith("100.0 to 100.0 %")


def test_without_a_third_rebound_no_energy_is_left():
    """A wall at rest after two impacts has lost it all, which is an answer and not a nan."""
    found = verdicts(free=free_table({**AS_TOLD, 0.001: (0.3, 0.4)}))
    text = found["the second and third bounces remain mostly undamped there"]
    assert text["holds"] == "no"
    assert text["measured"].startswith("0.0 to ")
    assert "no rebound" in found["β = 0.001 s has the test's second and third bounces"]["measured"]
    assert not any("nan" in row["measured"] for row in found.values())


def test_the_fit_is_compared_with_equation_five():
    """Ratios that meet the ranges at eq. 5's β alone make it the best fit."""
    printed = closed_forms.beta_one_sided(0.11, 0.8, 1800.0)
    slope = {b: tuple(v * (printed / b) ** 0.5 for v in (0.68, 0.80, 1.0)) for b in BETAS}
    assert (
        holds(verdicts(free=free_table(slope)), "eq. 5 is within 5 % of the β that fits") == "yes"
    )
    halved = {b: tuple(v * (0.5 * printed / b) ** 0.5 for v in (0.68, 0.80, 1.0)) for b in BETAS}
    assert (
        holds(verdicts(free=free_table(halved)), "eq. 5 is within 5 % of the β that fits") == "no"
    )


def test_missing_runs_and_walls_are_named():
    with pytest.raises(ValueError, match="no wall 'other'"):
        claims.evaluate(free_table(), FITS, WALLS, wall="other")
    few = {b: v for b, v in AS_TOLD.items() if b != 0.001}
    with pytest.raises(ValueError, match=r"β = .*0.001"):
        verdicts(free=free_table(few))
