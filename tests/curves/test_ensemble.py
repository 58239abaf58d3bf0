"""Perturbed ensembles: members, where they are run, bands."""

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


def test_bands_of_a_known_distribution_of_capacities():
    """Capacities uniform in ±10 %: a share linear in 1/PGA, and d/b at its own percentiles."""
    factors = np.linspace(0.9, 1.1, 2001)
    grid = np.array([0.3, 0.39, 0.4, 0.42])
    found = ensemble.bands(table(grid, 0.4, factors))
    # collapse when g ≥ 0.4/factor: the share at g is P(factor ≥ 0.4/g)
    expected = np.clip((1.1 - 0.4 / grid) / 0.2, 0.0, 1.0)
    assert found["probability"].to_numpy() == pytest.approx(expected, abs=1e-3)
    low, middle, high = (found[f"d_over_b_{name}"].iloc[0] for name in ("low", "median", "high"))
    assert [low, middle, high] == pytest.approx(0.6 * np.array([0.92, 1.0, 1.08]), rel=1e-3)


def test_failed_members_do_not_count():
    rows = table([0.3, 0.5], 0.4, np.ones(10))
    spoilt = rows.copy()
    spoilt.loc[[0, 1, 2], ["status", "d_over_b", "collapsed"]] = ["failed", np.nan, np.nan]
    got, whole = ensemble.bands(spoilt), ensemble.bands(rows)
    assert got["members"].tolist() == [7, 10]
    assert got["probability"].tolist() == whole["probability"].tolist() == [0.0, 1.0]
    assert ensemble.bands([]).empty


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
