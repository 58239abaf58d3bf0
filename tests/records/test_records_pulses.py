"""Pulses of a record: what was put in is found, with its sign, and a surrogate keeps it."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pytest
from rocking.records import Record, integrate, load, measures, read_table
from rocking.records.pulses import PERIODS_S, find_pulses, pulse_spec
from rocking.records.surrogate import generate
from rocking.records.surrogate_model import Pulse
from rocking.studies import surrogates
from run_script import script

DT = 0.01
# far apart, on periods of the search, of opposite signs
MADE = (
    Pulse(0.8, float(PERIODS_S[16]), 2.0, 30.0, 8.0),
    Pulse(0.3, float(PERIODS_S[8]), 1.6, 200.0, 15.0),
)


def motion(pulses, noise=0.0):
    t = DT * np.arange(2001)
    a = sum(pulse.acceleration(t) for pulse in pulses)
    a += noise * np.random.default_rng(3).standard_normal(t.size) * np.exp(-((t - 9) ** 2) / 8)
    return Record("trial", a, DT, "file")


def test_pulses_are_found_with_their_parameters_the_strongest_first():
    for made, found in zip(MADE, find_pulses(motion(MADE), 2), strict=True):
        assert found.period_s == pytest.approx(made.period_s)
        assert found.cycles == made.cycles
        assert found.time_s == pytest.approx(made.time_s, abs=DT)
        assert found.amplitude_m_s == pytest.approx(made.amplitude_m_s, rel=0.01)
        difference = (found.phase_deg - made.phase_deg + 180.0) % 360.0 - 180.0
        assert abs(difference) < 1.0


def test_the_mirrored_record_has_the_mirrored_pulses():
    record = motion(MADE, noise=0.2)
    mirrored = Record("trial", -record.acceleration_m_s2, DT, "file")
    for p, q in zip(find_pulses(record, 3), find_pulses(mirrored, 3), strict=True):
        np.testing.assert_allclose(
            p.acceleration(record.time_s), -q.acceleration(record.time_s), atol=1e-9
        )


def test_each_pulse_leaves_less_of_the_velocity():
    record = motion(MADE, noise=0.6)
    t = record.time_s
    left = []
    for count in range(1, 4):
        rest = record.acceleration_m_s2 - sum(p.acceleration(t) for p in find_pulses(record, count))
        velocity, _ = integrate(rest, DT)
        left.append(np.sum(velocity**2))
    assert np.all(np.diff(left) < 0.0)


def test_a_surrogate_with_pulses_keeps_peaks_and_the_way_the_ground_went():
    record = motion(MADE, noise=0.6)
    peaks = measures(record)
    target = [peaks[name] for name in ("pga_g", "pgv_cm_s", "pgd_cm", "duration_s")]
    made = generate("trial", *target, spec=pulse_spec(record, 2), seed=1)
    for name in ("pga_g", "pgv_cm_s", "pgd_cm"):
        assert measures(made)[name] == pytest.approx(peaks[name], rel=0.01)
    velocity = integrate(record.acceleration_m_s2, DT)[0]
    like = np.interp(record.time_s, made.time_s, integrate(made.acceleration_m_s2, made.dt_s)[0])
    assert np.corrcoef(velocity, like)[0, 1] > 0.8


def rows(scatter, keep_side):
    rng = np.random.default_rng(5)
    out = []
    for i in range(400):
        for sign, direction in ((1.0, "pos"), (-1.0, "neg")):
            real = 0.3 * np.exp(0.4 * sign)
            side = sign if keep_side else -sign
            made = 1.1 * 0.3 * np.exp(0.4 * side + scatter * rng.standard_normal())
            own = (f"R{i}", f"S{i // 2}", "W1", direction)
            for kind, pulses, value in (("recorded", None, real), ("surrogate", 0, made)):
                out.append((*own, kind, pulses, pulses, 0, value, value, 3.0))
    return pd.DataFrame(out, columns=surrogates.COLUMNS)


def test_summary_returns_the_distribution_that_made_the_ratios():
    table = surrogates.summary(rows(0.1, keep_side=True))
    whole = table[table["half"] == "all"].iloc[0]
    assert whole["n"] == 800
    assert whole["ratio_median"] == pytest.approx(1.1, rel=0.02)
    assert whole["scatter"] == pytest.approx(0.1, rel=0.1)
    assert whole["side_agrees"] == 1.0
    halves = table[table["half"] != "all"]
    assert halves["n"].sum() == 800
    lost = surrogates.summary(rows(0.05, keep_side=False)).iloc[0]
    assert lost["side_agrees"] == 0.0
    assert lost["scatter"] == pytest.approx(0.8, rel=0.05)


@pytest.mark.parametrize("directions", [["pos", "neg"], ["pos"]])
def test_the_figure_is_drawn_of_one_direction_too(tmp_path, directions):
    """One direction has no weak side: no second row of panels, and nothing of it in the table."""
    table = rows(0.1, keep_side=True)
    table = table[table["direction"].isin(directions) & table["record"].isin(["R0", "R1", "R2"])]
    found = surrogates.summary(table)
    assert found["side_agrees"].isna().all() == (len(directions) == 1)
    paths = {"table": "t.csv", "summary": "s.csv", "facts": []}
    table.to_csv(tmp_path / "t.csv", index=False)
    found.to_csv(tmp_path / "s.csv", index=False)
    given = {"input": paths, "params": {"study": "surrogates"}}
    script("figure", tmp_path, output={"png": "figure.png"}, **given)
    high = plt.imread(tmp_path / "figure.png").shape[0]
    assert (high > 700) == (len(directions) == 2), high


def test_scatter_is_that_of_the_draws_beside_the_record():
    draws = [(0.2 * np.exp(0.3 * z), d) for d, z in enumerate(np.linspace(-2.0, 2.0, 41))]
    own = ("R", "S", "W1", "pos")
    rows = [(*own, "recorded", None, None, 0, 0.2 * np.exp(0.35), 0.2 * np.exp(0.35), 3.0)]
    rows += [(*own, "surrogate", 6, 6, d, value, value, 3.0) for value, d in draws]
    rows += [("T", "S", "W1", "pos", "surrogate", None, None, 0, 0.5, 0.5, 3.0)]
    rows += [("T", "S", "W1", "pos", "surrogate", None, None, 1, np.nan, np.nan, 3.0)]
    table = surrogates.scatter(pd.DataFrame(rows, columns=surrogates.COLUMNS))
    beside, alone = table.to_dict("records")
    assert beside["pga_median_g"] == pytest.approx(0.2)
    assert beside["pga_p90_g"] == pytest.approx(0.2 * np.exp(0.3 * 1.6))
    assert beside["scatter"] == pytest.approx(0.3 * np.linspace(-2.0, 2.0, 41).std(ddof=1))
    assert beside["share_below"] == 32 / 41  # those with z < 0.35/0.3, in steps of 0.1
    assert (alone["draws"], alone["n_censored"], alone["pga_median_g"]) == (2, 1, 0.5)
    assert np.isnan([alone["recorded_g"], alone["share_below"]]).all()


@pytest.mark.parametrize("name", ["RRS228", "1ST280"])
def test_shipped_descriptions_give_motions_of_their_peaks(name):
    table = Path(__file__).parents[2] / "config" / "suites" / "pulse_surrogates.tsv"
    stated, made = read_table(table)[name].targets, measures(load(name, table, seed=3))
    for peak, value in stated.items():
        assert made[peak] == pytest.approx(value, rel=0.01)


def test_both_components_of_a_station_are_in_one_half_and_what_never_fell_is_counted():
    table = rows(0.1, keep_side=True)
    halves = surrogates.half_of(table["station"])
    assert table.assign(half=halves).groupby("station")["half"].nunique().max() == 1
    table.loc[(table["kind"] == "surrogate") & (table["record"] == "R0"), "pga_half_g"] = np.nan
    whole = surrogates.summary(table).iloc[0]
    assert whole["n_censored"] == 2
