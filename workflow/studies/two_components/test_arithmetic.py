"""Arithmetic of the study by hand: what is run where, and what stands in its table."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from studies.two_components import study as two_components


class TwoComponents(two_components.Comparison):
    """A façade that falls from stated amplitudes on, alone, in the repetition and under both."""

    def __init__(self, alone_g, again_g, both_g):
        self.falls = {False: alone_g, True: again_g}
        self.settings = {"level_ratio": 0.05, "start_ratio": 0.8}
        self.start_g, self.max_g, self.asked = 0.05, 1.0, []
        self.yade = SimpleNamespace(run=self.run)
        self.both_g = both_g

    def one(self, pga_g, again=False):
        return 1.0 if pga_g >= self.falls[again] else 0.1 * pga_g

    def run(self, pga_g):
        pga_g = np.asarray(pga_g)
        self.asked.append(pga_g.tolist())
        status = np.where(pga_g >= self.both_g, "overturned", "ok")
        table = {"status": status, "d_over_b": 0.2 * pga_g, "twist_rad": pga_g, "slid_m": -pga_g}
        return pd.DataFrame(table)


def test_both_components_are_compared_at_half_the_planar_collapse_and_at_the_last_that_stood():
    trial = TwoComponents(0.30, 0.32, 0.20)
    found = dict(zip(two_components.FOUND, trial.compare(), strict=True))
    levels = 0.05 * 1.05 ** np.arange(62)
    first = {g: levels[levels >= g][0] for g in (0.30, 0.32, 0.20)}
    assert found["one_g"] == pytest.approx(first[0.30])
    assert found["again_g"] == pytest.approx(first[0.32])
    assert found["two_g"] == pytest.approx(first[0.20])
    assert found["half_g"] == pytest.approx(0.5 * first[0.30])
    assert found["d_one"] == pytest.approx(0.1 * found["half_g"])
    assert found["d_two"] == pytest.approx(0.2 * found["half_g"])
    assert found["twist_rad"] == pytest.approx(found["half_g"])
    assert found["last_g"] == pytest.approx(levels[levels < 0.20][-1])
    assert found["last_slid_m"] == pytest.approx(-found["last_g"])


def test_a_facade_that_never_falls_is_compared_at_half_the_largest_level():
    found = dict(zip(two_components.FOUND, TwoComponents(9.0, 9.0, 9.0).compare(), strict=True))
    assert np.isnan([found[name] for name in ("one_g", "again_g", "two_g")]).all()
    assert 0.5 <= found["half_g"] < 0.5 * 1.05
    assert found["last_g"] == pytest.approx(2.0 * found["half_g"])


def test_the_second_ratio_is_of_the_peak_along_the_facade_to_that_out_of_plane(monkeypatch):
    own = SimpleNamespace(floors=(None, {"ground": np.array([0.1, -0.4])}), name="A")
    second = SimpleNamespace(floors=(None, {"ground": np.array([-0.3, 0.2])}), name="B")
    own.varied = lambda variant: own
    case = SimpleNamespace(model="W1", varied=lambda variant: case)
    values = SimpleNamespace(compare=lambda: range(len(two_components.FOUND)))
    monkeypatch.setattr(two_components, "Comparison", lambda *given: values)
    (row,) = two_components.collapse([case], own, ["pos"], second, {}).to_dict("records")
    assert row["second_ratio"] == pytest.approx(0.75)
    assert (row["second"], row["model"], row["direction"]) == ("B", "W1", "pos")


def test_ratios_of_both_components_are_over_those_of_one():
    table = pd.DataFrame({"model": ["W1"], "one_g": [0.4], "two_g": [0.3], "again_g": [0.42]})
    found = two_components.summary(table.assign(d_one=0.2, d_two=0.25)).set_index("compared")
    medians = found["median"].to_dict()
    assert medians == pytest.approx(
        {"both components": 0.75, "repetition": 1.05, "d/b at half": 0.8}
    )
