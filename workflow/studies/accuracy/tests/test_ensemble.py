"""Perturbed ensembles: realisations and bands."""

import numpy as np
import pandas as pd
import pytest
from studies.accuracy import ensemble
from yade_process import resolved

from yade_scripts.commands import perturb

SETTINGS = resolved()["ensemble"]
NUMERICS = resolved()["numerics"]


def table(pga_g, capacity, realisations):
    """Ensemble of façades whose capacities are known; d/b grows linearly up to collapse."""
    rows = [
        {
            "pga_g": g,
            "realisation": i,
            "collapsed": int(g * realisations[i] >= capacity),
            "d_over_b": min(1.0, 0.8 * g * realisations[i] / capacity),
            "status": "overturned" if g * realisations[i] >= capacity else "ok",
        }
        for g in pga_g
        for i in range(len(realisations))
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


def test_failed_realisations_do_not_count():
    rows = table([0.3, 0.5], 0.4, np.ones(10))
    spoilt = rows.copy()
    spoilt.loc[[0, 1, 2], ["status", "d_over_b", "collapsed"]] = ["failed", np.nan, np.nan]
    got, whole = ensemble.bands(spoilt), ensemble.bands(rows)
    assert got["realisations"].tolist() == [7, 10]
    assert got["probability"].tolist() == whole["probability"].tolist() == [0.0, 1.0]
    assert ensemble.bands([]).empty


def test_realisations_are_seeded_nested_and_within_their_spread():
    few, many = (perturb.draw_realisations({**SETTINGS, "realisations": n}) for n in (5, 40))
    assert few == many[:5]
    assert many != perturb.draw_realisations({**SETTINGS, "realisations": 40, "seed": 7})
    amplitudes = np.array([m.amplitude_factor for m in many])
    assert np.all(np.abs(amplitudes - 1.0) <= SETTINGS["amplitude_spread"])
    assert amplitudes.std() == pytest.approx(SETTINGS["amplitude_spread"] / np.sqrt(3), rel=0.25)
    assert all(0.9 <= m.step_factor <= 1.0 for m in many)  # never beyond the stated step
    assert {m.extra_nodes for m in many} == {0, 1, 2}
    only = perturb.draw_realisations({**SETTINGS, "perturb": ["amplitude"]})
    assert {(m.step_factor, m.extra_nodes) for m in only} == {(1.0, 0)}


def test_perturbed_numerics_change_step_and_nodes_only():
    realisation = perturb.Realisation(1, 1.0, 0.95, 2)
    out = perturb.perturbed_numerics(NUMERICS, realisation)
    changed = {k for k in NUMERICS if out[k] != NUMERICS[k]}
    assert changed == {"nodes_thickness", "nodes_height", "nodes_per_block", "step_fraction"}
    assert out["step_fraction"] == pytest.approx(0.95 * NUMERICS["step_fraction"])
    bricks = {**NUMERICS, "nodes_height": None}  # W3 has no nodes up a wall
    assert perturb.perturbed_numerics(bricks, realisation) == {**out, "nodes_height": None}
