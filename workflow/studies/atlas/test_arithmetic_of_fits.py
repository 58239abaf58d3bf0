"""Arithmetic of fits and claims by hand: what stands in a table, and over what."""

import numpy as np
import pandas as pd
import pytest
from rocking.formula import groups, law

from studies.atlas import classes, fit


def scattered(seed=5, facades=9, stations=8):
    """Values of façades under two motions a station: a law without terms, and its scatter."""
    rng = np.random.default_rng(seed)
    level = np.repeat(rng.normal(0.0, 0.4, stations), 2)
    names = [f"S{k // 2}" for k in range(2 * stations)]
    own = rng.normal(0.0, 0.1, facades)[:, None]
    return own + level, names


def test_an_interval_leaves_five_per_cent_on_either_side():
    """Of a mean over stations drawn again: ± 1.645 σ/√n, where the façades are alike."""
    values, names = scattered()
    values = values - values.mean(axis=1, keepdims=True)
    low, high = fit.intervals(np.ones((len(values), 1)), values, names, 1)
    error = values[0, ::2].std() / np.sqrt(8)
    assert low[0] == pytest.approx(-1.645 * error, rel=0.15)
    assert high[0] == pytest.approx(1.645 * error, rel=0.15)


def test_the_error_has_that_of_the_facades_and_that_of_as_many_stations_as_there_are(monkeypatch):
    """A motion more of a station that is there already tells nothing new of the level."""
    values, names = scattered()
    columns = pd.MultiIndex.from_tuples(
        [(f"r{k}", "pos") for k in range(len(names))], names=["record", "direction"]
    )
    wide = pd.DataFrame(values, columns=columns)
    stations_of = dict(zip(columns.get_level_values(0), names, strict=True))
    monkeypatch.setattr(fit, "wide", lambda *given: wide)
    monkeypatch.setattr(fit, "matrix", lambda design, terms: np.ones((len(design), 1)))
    monkeypatch.setitem(fit.TERMS, "W1", ("1",))
    design = pd.DataFrame(index=wide.index)
    found = fit.fitted(None, design, "W1", "own", "pga_g", None, stations_of, 1)
    spread = np.sqrt(np.mean(np.var(values, axis=1, ddof=1)))
    assert found["dispersion"] == pytest.approx(spread, abs=1e-4)
    # a façade against the mean of the others: its own deviation times n/(n − 1)
    means = values.mean(axis=1)
    alone = (means - means.mean()) * len(means) / (len(means) - 1)
    rms = np.sqrt(np.mean(alone**2))
    assert found["checks"]["facades_rms"] == pytest.approx(rms, abs=1e-4)
    assert found["error"] == pytest.approx(np.hypot(rms, spread / np.sqrt(8)), abs=2e-4)
    assert found["checks"]["stations"] == 8
    assert found["checks"]["motions"] == 16


def test_a_class_is_refused_by_the_weight_that_lies_outside_and_not_by_the_number(monkeypatch):
    """One of three outside: refused with 60 % of the weight, left out and counted with 4 %."""

    def said(row, *_):
        if row["period_s"] > 1.0:
            raise groups.OutsideError("outside")
        return 0.3, 0.2, 0.1

    monkeypatch.setattr(law, "said", said)
    rows = pd.DataFrame({name: [0.5, 0.5, 0.5] for name in groups.DIMENSIONS})
    rows["period_s"] = [0.3, 2.0, 0.3]
    share = classes.OUTSIDE
    for outside, refused in ((0.6, True), (share + 1e-3, True), (share - 1e-3, False)):
        inside = 0.5 * (1.0 - outside)
        weighted = rows.assign(weight=7.0 * np.array([inside, outside, inside]))
        if refused:
            with pytest.raises(groups.OutsideError, match=f"{100 * outside:.0f} % of it"):
                classes.fragility(weighted, "W1")
        else:
            found = classes.fragility(weighted, "W1")
            assert (found["n"], found["n_outside"]) == (2, 1)
            assert found["median"] == pytest.approx(0.3)


def test_limits_of_the_formula_are_the_stated_ends_or_those_that_came_out(monkeypatch):
    monkeypatch.setattr(fit, "fitted", lambda *given: "fitted")
    values = np.array([0.2, 0.5, 0.3])
    design = pd.DataFrame({name: values + k for k, name in enumerate(groups.DIMENSIONS)})
    table = pd.DataFrame({"base": "own", "facade": design.index[:3], "model": "W1"})
    stated = groups.DIMENSIONS[0]
    made_of = {"seed": 1, "ranges": {stated: [0.1, 0.9]}}
    found = fit.law(table, design, {}, {}, made_of)
    assert found["limits"][stated] == [0.1, 0.9]
    for k, name in enumerate(groups.DIMENSIONS[1:], 1):
        assert found["limits"][name] == pytest.approx([0.2 + k, 0.5 + k])
    assert found["made_of"]["facades"] == 3
    assert list(found["models"]) == ["W1"]
