"""Best fits as rows: walls whose e_exp falls linearly with ln β have closed answers."""

import math

import numpy as np
import pytest
from rocking.mechanics import closed_forms
from rocking.mechanics.beta import groups, read_law
from studies.calibration import fits
from studies.calibration import free_rocking as study
from studies.shared.restitution import TARGETS, Rebounds

BETAS = np.geomspace(1e-4, 1e-2, 9)


def wall(settings=None, ratio=0.22, slope=0.1):
    """e_n/|e_1SR| = 1 − slope·ln(β/10⁻³): 1 at β = 1 ms, whatever the impact."""
    own = {"density_kg_m3": 2000.0, "base": "study"}
    own |= {"nodes_thickness": 5, "nodes_height": 5, "step_fraction": 0.4}
    config = study.batch_wall({**own, **(settings or {})}, 0.11, 1800.0, 10.0, ratio)
    e_1sr = 0.9
    e = e_1sr * (1.0 - slope * np.log(BETAS[:, None] / 1e-3)) * np.ones(3)
    e[0, 2] = np.nan  # the smallest β has two impacts
    found = Rebounds(0.5, np.array([1.0, 2.0, 3.0]), np.array([1.5, 2.5, 3.5]), np.ones(3))
    about = {"id": f"r{ratio}", "config": config, "about": {"role": "wall"}, "release_ratio": 0.5}
    return {"case": about, "e_1sr": e_1sr, "beta_s": BETAS, "e": e, "found": [found] * len(BETAS)}


def test_the_first_impact_has_its_closed_restitution_where_it_was_put():
    assert fits.beta_of_one_sided(wall()) == pytest.approx(1e-3, rel=1e-9)


def test_misfits_are_of_every_run_and_blank_without_three_impacts():
    table = fits.misfits([wall(), wall(slope=0.2)])
    assert len(table) == 2 * len(BETAS)
    assert table["slenderness"].unique() == pytest.approx([10.0])
    assert table["misfit"].isna().tolist() == ([True] + [False] * (len(BETAS) - 1)) * 2


def test_a_listed_beta_is_the_nearest_by_its_ratio():
    assert fits.at_listed(wall(), [1e-4, 1.1e-3, 9e-2]) == [0, 4, 8]


def test_walls_stand_by_the_ratio_of_their_return_walls():
    table = fits.by_ratio([wall(ratio=0.5, slope=0.2), wall(ratio=0.1, slope=0.2)])
    np.testing.assert_allclose(table[:, 0], [0.1, 0.5])
    middles = [0.5 * (low + high) for low, high in TARGETS]
    expected = 1e-3 * np.exp((1.0 - np.array(middles)) / 0.2)
    np.testing.assert_allclose(table[:, 2:], [expected] * 2, rtol=0.01)


def test_rebounds_that_targets_mean_are_those_of_the_closed_form():
    time_s, low, high = fits.rebounds_meant(wall())
    np.testing.assert_array_equal(time_s, [1.5, 2.5, 3.5])
    for n, limits in enumerate(TARGETS, 1):
        ends = closed_forms.amplitude_after_impacts(0.5, np.array(limits) * 0.9, n)
        np.testing.assert_allclose((low[n - 1], high[n - 1]), ends)
    assert (low <= high).all()


def test_targets_are_meant_for_the_run_whose_ratios_lie_nearest_to_them():
    """Of e_n over |e_1SR|; every run has another release, so that the run can be told."""
    one = wall(slope=0.2)
    times = np.array([1.0, 2.0, 3.0])
    one["found"] = [
        Rebounds(0.1 * k, times, times + 0.1 * k, np.ones(3)) for k in range(len(BETAS))
    ]
    least, most = np.transpose(TARGETS)
    ratios = 1.0 - 0.2 * np.log(BETAS[:, None] / 1e-3)
    outside = np.maximum(least - ratios, ratios - most).clip(0.0)
    best = int(np.argmin((outside**2).sum(axis=1)))
    time_s, low, high = fits.rebounds_meant(one)
    np.testing.assert_allclose(time_s, times + 0.1 * best)
    ends = closed_forms.amplitude_after_impacts(0.1 * best, np.array(TARGETS[0]) * 0.9, 1)
    np.testing.assert_allclose((low[0], high[0]), ends)


@pytest.mark.parametrize(
    ("beta_s", "at_edge", "words"),
    [(1e-3, False, ""), (1e-3, True, "edge"), (math.nan, True, "no")],
)
def test_a_fit_says_when_it_is_none_or_at_an_end(beta_s, at_edge, words):
    assert fits.remark_on({"beta_s": beta_s, "at_edge": at_edge}, "no", "edge") == words


def test_a_row_has_every_column_and_eq_5():
    row = fits.row_of(wall())
    assert set(row) == set(fits.COLUMNS)
    assert set(fits.CONTRACT) <= set(row)
    assert row["beta_eq5_s"] == closed_forms.beta_one_sided(0.11, 1.1, 1800.0)
    assert row["runs"] == len(BETAS)


def test_a_law_is_followed_over_the_slenderness_of_every_batch():
    settings = {"thickness_m": [0.11, 0.3], "e_mpa": [1800.0], "slenderness": [5.0, 15.0]}
    settings |= {"reference_ratio": 0.22, "density_kg_m3": 2000.0, "base": "study"}
    settings |= {"nodes_thickness": 5, "nodes_height": 5, "step_fraction": 0.4}
    law = read_law()
    table = fits.along_slenderness(settings, law, count=3)
    assert table["slenderness"].tolist() == [5.0, 10.0, 15.0] * 2
    assert (table["low_s"] < table["beta_s"]).all()
    assert (table["beta_s"] < table["high_s"]).all()
    row = table.iloc[4]
    config = study.batch_wall(settings, 0.3, 1800.0, 10.0, 0.22)
    assert row["beta_s"] == pytest.approx(law.predict(groups(config))[0])
    assert row["eq5_s"] == closed_forms.beta_one_sided(0.3, 3.0, 1800.0)
    low, high = fits.study_range(settings, 0.3, 1800.0, [5.0, 10.0])
    assert (low < high).all()
    assert high[1] == study.single_block_maximum(config)
