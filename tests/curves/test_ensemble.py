"""Perturbed ensembles: members, where they are run, bands and collapse percentiles."""

import numpy as np
import pandas as pd
import pytest
from rocking.curves import ensemble
from yade_process import resolved

from yade_scripts.studies import perturb

SETTINGS = resolved()["ensemble"]
NUMERICS = resolved()["numerics"]


def table(pga_g, capacity, members):
    """Ensemble of façades whose capacities are known; d/b grows linearly up to collapse."""
    rows = [
        {
            "pga_g": g,
            "member": i,
            "collapsed": int(g * members[i] >= capacity),
            "d_over_b": min(1.0, 0.8 * g * members[i] / capacity),
            "status": "overturned" if g * members[i] >= capacity else "ok",
        }
        for g in pga_g
        for i in range(len(members))
    ]
    return pd.DataFrame(rows)


def test_percentiles_of_a_known_distribution_of_capacities():
    """Capacities uniform in ±10 %: the share of collapses is linear in 1/PGA."""
    factors = np.linspace(0.9, 1.1, 2001)
    grid = np.linspace(0.3, 0.6, 301)
    median, low, high = ensemble.collapse_percentiles(table(grid, 0.4, factors))
    # collapse when g ≥ 0.4/factor: the share at g is P(factor ≥ 0.4/g)
    assert median == pytest.approx(0.4, abs=1e-3)
    assert low == pytest.approx(0.4 / 1.08, abs=1e-3)
    assert high == pytest.approx(0.4 / 0.92, abs=1e-3)


def test_percentiles_that_are_not_bracketed_are_blank():
    factors = np.linspace(0.99, 1.01, 21)
    median, low, high = ensemble.collapse_percentiles(table([0.3, 0.35], 0.4, factors))
    assert np.isnan([median, low, high]).all()
    assert np.isnan(ensemble.collapse_percentiles([])).all()


def test_failed_members_do_not_count():
    rows = table([0.3, 0.5], 0.4, np.ones(10))
    spoilt = rows.copy()
    spoilt.loc[[0, 1, 2], ["status", "d_over_b", "collapsed"]] = ["failed", np.nan, np.nan]
    assert ensemble.collapse_percentiles(spoilt) == ensemble.collapse_percentiles(rows)
    assert ensemble.bands(spoilt)["members"].tolist() == [7, 10]


def test_monotone_fit_is_the_constrained_least_squares_one():
    """Against brute force over all non-decreasing vectors on a grid."""
    values, weights = np.array([0.1, 0.6, 0.3, 0.5, 0.4]), np.array([1.0, 2.0, 1.0, 3.0, 1.0])
    fit = ensemble.monotone(values, weights)
    assert np.all(np.diff(fit) >= 0.0)
    best = np.sum(weights * (fit - values) ** 2)
    rng = np.random.default_rng(3)
    trials = np.sort(rng.random((20000, 5)), axis=1)
    near = np.sort(fit + 0.05 * rng.standard_normal((20000, 5)), axis=1)
    for candidates in (trials, near):
        assert np.all(((candidates - values) ** 2 @ weights) >= best - 1e-12)


def test_members_are_seeded_nested_and_within_their_spread():
    few, many = (perturb.draw_members({**SETTINGS, "members": n}) for n in (5, 40))
    assert few == many[:5]
    assert many != perturb.draw_members({**SETTINGS, "members": 40, "seed": 7})
    amplitudes = np.array([m.amplitude_factor for m in many])
    assert np.all(np.abs(amplitudes - 1.0) <= SETTINGS["amplitude_spread"])
    assert amplitudes.std() == pytest.approx(SETTINGS["amplitude_spread"] / np.sqrt(3), rel=0.25)
    assert all(0.9 <= m.step_factor <= 1.0 for m in many)  # never beyond the stated step
    assert {m.extra_nodes for m in many} == {0, 1, 2}
    only = perturb.draw_members({**SETTINGS, "perturb": ["amplitude"]})
    assert {(m.step_factor, m.extra_nodes) for m in only} == {(1.0, 0)}


def test_perturbed_numerics_change_step_and_nodes_only():
    member = perturb.Member(1, 1.0, 0.95, 2)
    out = perturb.perturbed_numerics(NUMERICS, member)
    changed = {k for k in NUMERICS if out[k] != NUMERICS[k]}
    assert changed == {"nodes_thickness", "nodes_height", "nodes_per_block", "step_fraction"}
    assert out["step_fraction"] == pytest.approx(0.95 * NUMERICS["step_fraction"])


def test_ensembles_run_where_histories_do_not_repeat():
    curve = {0.1: "ok", 0.2: "ok", 0.3: "ok", 0.35: "failed", 0.4: "overturned", 0.5: "overturned"}
    assert perturb.probe_intensities(curve) == [0.2, 0.3, 0.4]
    calm = dict.fromkeys((0.1, 0.2, 0.3, 0.4), 1e-6)
    auto = {**SETTINGS, "enabled": "auto"}
    assert perturb.sensitive_intensities(curve, calm, auto) == ([], False)
    assert perturb.sensitive_intensities(curve, {**calm, 0.3: 0.2}, auto) == ([0.3], True)
    assert perturb.sensitive_intensities(curve, {**calm, 0.1: 0.2}, auto) == ([], False)
    on, off = ({**SETTINGS, "enabled": word} for word in ("on", "off"))
    assert perturb.sensitive_intensities(curve, calm, on)[1]
    assert perturb.sensitive_intensities(curve, {0.3: 0.2}, off) == ([], False)


@pytest.mark.parametrize(("centre", "width"), [(0.4, 0.02), (0.3, 0.1), (0.55, 0.001)])
def test_levels_bracket_the_band(centre, width):
    """Whatever the true band, the levels reach below its tenth and above its ninetieth percent."""

    def share(g):
        return float(1.0 / (1.0 + np.exp(-np.clip((g - centre) / width * 4.0, -700, 700))))

    fractions = {}
    settings = {**SETTINGS, "max_levels": 40}
    while (g := perturb.next_level(fractions, settings, 0.4, 0.01)) is not None:
        assert g not in fractions
        fractions[g] = share(g)
    assert min(fractions.values()) <= 0.1
    assert max(fractions.values()) >= 0.9
    levels = sorted(fractions)
    steep = [
        (a, b)
        for a, b in zip(levels[:-1], levels[1:], strict=True)
        if fractions[b] - fractions[a] > 0.5
    ]
    assert all(b - a <= 0.0101 for a, b in steep)


def test_levels_end_at_their_largest_number():
    fractions = {}
    settings = {**SETTINGS, "max_levels": 4}
    while (g := perturb.next_level(fractions, settings, 0.4, 0.01)) is not None:
        fractions[g] = 0.5  # a band that is never bracketed
    assert len(fractions) == 4


def test_more_members_are_needed_where_the_spread_is_wide():
    rng = np.random.default_rng(0)
    narrow, wide = (
        ensemble.members_needed(0.4 + s * rng.standard_normal(400), 0.05, 1) for s in (0.01, 0.15)
    )
    assert narrow == 3
    # the median of n normal values has a deviation of 1.2533 σ/√n; 90 % within 1.645 of it
    expected = (1.645 * 1.2533 * 0.15 / 0.05) ** 2
    assert wide == pytest.approx(expected, rel=0.4)
