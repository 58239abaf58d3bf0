"""Best fits of β on curves whose answer is known; ranges and walls of the study."""

import math

import numpy as np
import pytest
from rocking.mechanics import beta, closed_forms
from studies.calibration import free_rocking as study
from study_cases import study_settings

SETTINGS = study_settings({})["calibration"]
BETAS = np.array([1e-4, 2e-4, 4e-4, 8e-4, 1.6e-3])


def sorrentino():
    return study.batch_wall(SETTINGS, 0.11, 1800.0, 0.8 / 0.11, 0.22)


def line(beta_at_target, target, slope=-0.4):
    """e/e_target falling along ln β through the target at a stated β."""
    return target + slope * (np.log(BETAS) - math.log(beta_at_target))


def test_common_answer_of_all_impacts_is_found():
    answer = 5.2e-4
    e = np.stack([line(answer, t) for t in (0.68, 0.80, 1.0)], axis=1)
    fit = study.best_fit(BETAS, e)
    assert fit["misfit"] == pytest.approx(0.0, abs=1e-3)
    # any β whose first two impacts lie in their ranges and the third at 1.0
    assert fit["beta_s"] == pytest.approx(answer, rel=5e-3)
    assert fit["single_s"] == pytest.approx([answer] * 3, rel=5e-3)
    assert fit["high_s"] / fit["low_s"] < 1.01
    assert not fit["at_edge"]


def test_impacts_that_disagree_give_a_band_and_a_misfit():
    e = np.stack([line(3e-4, 0.68), line(5e-4, 0.80), line(7e-4, 1.0)], axis=1)
    fit = study.best_fit(BETAS, e)
    assert fit["single_s"] == pytest.approx([3e-4, 5e-4, 7e-4], rel=5e-3)
    assert (fit["low_s"], fit["high_s"]) == pytest.approx((3e-4, 7e-4), rel=5e-3)
    assert fit["low_s"] < fit["beta_s"] < fit["high_s"]
    assert fit["misfit"] > 0.02


def test_the_middle_of_what_fits_as_well_is_taken():
    """The third impact leaves 1 by 0.4 a unit of ln β below 4e-4 s and by 0.1 above it: the misfit,
    its distance over √3, is less than AS_GOOD from 0.043 below to 0.173 above."""
    x = np.log(BETAS / 4e-4)
    third = 1.0 - np.where(x < 0.0, 0.4, 0.1) * x
    e = np.stack([0.68 + 0.0 * x, 0.80 + 0.0 * x, third], axis=1)
    reach = study.AS_GOOD * math.sqrt(3.0)
    middle = 0.5 * (reach / 0.1 - reach / 0.4)
    assert study.AS_GOOD == 0.01
    assert study.best_fit(BETAS, e)["beta_s"] == pytest.approx(4e-4 * math.exp(middle), rel=2e-3)


def test_missing_impacts_are_not_bridged():
    """A run without its third impact has no misfit, nor have the β beside it."""
    e = np.stack([line(3e-4, t) for t in (0.68, 0.80, 1.0)], axis=1)
    e[2:, 2] = np.nan  # from 4e-4 on
    fit = study.best_fit(BETAS, e)
    assert fit["beta_s"] <= 2e-4 * (1 + 1e-9)
    assert fit["at_edge"]
    e[:, 2] = np.nan
    fit = study.best_fit(BETAS, e)
    assert math.isnan(fit["beta_s"])
    assert math.isnan(fit["misfit"])
    assert fit["single_s"][0] == pytest.approx(3e-4, rel=5e-3)
    assert math.isnan(fit["single_s"][2])


def test_fit_at_the_end_of_the_range_is_marked():
    e = np.stack([line(1e-2, t) for t in (0.68, 0.80, 1.0)], axis=1)
    assert study.best_fit(BETAS, e)["at_edge"]


def test_unsorted_runs_are_refused():
    with pytest.raises(ValueError, match="ascending"):
        study.best_fit(BETAS[::-1], np.ones((5, 3)))


def test_measured_values_replace_the_targets():
    targets = study.targets_of([0.35, 0.4], 0.446)
    assert targets[0] == pytest.approx((0.35 / 0.446,) * 2)
    assert targets[2] == (1.0, 1.0)


def test_largest_beta_is_the_studys():
    assert study.single_block_maximum(sorrentino()) == pytest.approx(0.0058, rel=0.005)


def test_two_blocks_are_stiffer_than_one():
    """The highest of their modes lies above the axial one of two equal masses in a chain."""
    config = sorrentino()
    f = config["facade"]
    half = 0.5 * f["height_m"]
    k_over_m = f["e_mpa"] * 1e6 / half / (f["density_kg_m3"] * half)
    axial = math.sqrt(k_over_m * (3.0 + math.sqrt(5.0)) / 2.0)
    found = study.two_block_minimum(config)
    assert found <= 1.0 / axial * (1.0 + 1e-9)
    assert found < study.single_block_maximum(config)


def test_stiffest_mode_of_two_halves():
    """K by hand: base and cut of k along z, r k along y and k b²/12 in rotation, half a block's
    half height from the centres."""
    config = sorrentino()
    f = config["facade"]
    b, half, r = f["thickness_m"], 0.5 * f["height_m"], f["shear_stiffness_ratio"]
    mass = f["density_kg_m3"] * b * half * f["width_m"]
    k = f["e_mpa"] * 1e6 / half * b * f["width_m"]
    stiffness, arm = np.zeros((6, 6)), 0.5 * half
    for low, high in ((None, 0), (0, 1)):
        row = np.zeros((3, 6))  # opening, slip and turn of the joint by y, z, rotation of each half
        for block, sign, lever in ((low, -1.0, -arm), (high, 1.0, arm)):
            if block is not None:
                row[:, 3 * block : 3 * block + 3] = sign * np.array(
                    [[0.0, 1.0, 0.0], [1.0, 0.0, lever], [0.0, 0.0, 1.0]]
                )
        stiffness += row.T @ np.diag([k, r * k, k * b**2 / 12.0]) @ row
    inertia = np.tile([mass, mass, mass * (b**2 + half**2) / 12.0], 2)
    values = np.linalg.eigvals(stiffness / inertia[:, None]).real
    assert study.two_block_minimum(config) == pytest.approx(1.0 / math.sqrt(values.max()))


def test_similar_walls_have_similar_ranges():
    """At one h/b every frequency goes as √(E/ρ)/h."""
    one = study.batch_wall(SETTINGS, 0.1, 1000.0, 8.0, 0.22)
    two = study.batch_wall(SETTINGS, 0.3, 4000.0, 8.0, 0.22)
    for bound in (study.two_block_minimum, study.single_block_maximum):
        assert bound(two) / bound(one) == pytest.approx(3.0 / 2.0, rel=1e-9)


def test_walls_of_a_batch():
    cases = study.batch_cases(SETTINGS, 1)
    ratios = {beta.groups(c["config"])["return_wall_ratio"] for c in cases}
    assert sorted(ratios) == pytest.approx(sorted(SETTINGS["return_wall_ratio"]))
    assert len({c["id"] for c in cases}) == len(cases)
    for c in cases:
        f = c["config"]["facade"]
        p = closed_forms.block(f["height_m"], f["thickness_m"]).p_rad_s
        fall = closed_forms.quarter_period(c["release_ratio"], p)
        # three rebounds of restitution 0.6 are over before the history ends
        peaks = closed_forms.amplitude_after_impacts(0.5, 0.6, np.arange(1, 4))
        assert c["limit_s"] > fall + sum(2 * closed_forms.quarter_period(t, p) for t in peaks[:2])


def test_a_given_wall_before_return_walls_of_other_ratios():
    """As configured first, then with a ratio of all walls' thickness to the façade's width."""
    wall = {**sorrentino(), "run": "mine"}
    wall["facade"] = {**wall["facade"], "width_m": 3.0}
    own, *others = study.wall_cases(SETTINGS, wall, (0.1, 0.5))
    assert beta.groups(own["config"])["return_wall_ratio"] == pytest.approx(0.22 / 3.0)
    found = [beta.groups(case["config"])["return_wall_ratio"] for case in others]
    assert found == pytest.approx([0.1, 0.5])


def test_sensitivity_changes_one_thing():
    """The unchanged wall comes first; a change of width at the same ratio changes no group."""
    cases = study.sensitivity_cases(SETTINGS)
    groups = {c["id"]: beta.groups(c["config"]) for c in cases}
    for number in (1, 2):
        base = groups[f"wall {number}: none"]
        assert groups[f"wall {number}: width ×0.5, same ratio"] == pytest.approx(base)
        assert groups[f"wall {number}: L/h 1"]["stiffness_ratio"] == pytest.approx(1.0)
        assert base["stiffness_ratio"] == pytest.approx(2.0)
        assert groups[f"wall {number}: L/h 0.25"]["stiffness_ratio"] == pytest.approx(4.0)
        assert groups[f"wall {number}: base jkn ×2"]["stiffness_ratio"] == pytest.approx(1.0)
        assert groups[f"wall {number}: ratio 0.05"]["return_wall_ratio"] == pytest.approx(0.05)
