"""Which histories fidelity is measured on, what is right there, and how errors are counted."""

import numpy as np
import pandas as pd
import pytest
from reference_solver.facade import peak_and_end
from studies.accuracy import errors as study
from studies.accuracy import histories
from yade_process import resolved

from yade_scripts.model import floor_motions
from yade_scripts.model.motion import STANDARD_GRAVITY_M_S2

LIMITS = {
    "reference_nodes": 33,
    "reference_step": 0.02,
    "trusted": 10.0,
    "repeat_tolerance": 0.01,
    "shares": [0.5],
    "max_pga_g": 3.0,
}


@pytest.fixture(scope="module")
def cycle(tmp_path_factory):
    """One strong cycle under floors that lag the ground: file, times, columns."""
    t = np.arange(0.0, 3.0, 0.005)
    waves = [np.where((u := t - 0.02 * j) > 0, u, 0.0) for j in range(5)]
    columns = [
        np.where(u < 0.8, (1.0 + 0.1 * j) * np.sin(2.0 * np.pi * u / 0.8), 0.0)
        for j, u in enumerate(waves)
    ]
    path = tmp_path_factory.mktemp("motion") / "motion.csv"
    floor_motions.write(path, t, columns[0], np.array(columns[1:]))
    return path, *floor_motions.read(path)


def solver(model, cycle):
    """Compiled solver of a default façade under the cycle."""
    return histories.PeakSolver(
        {**resolved(), "model": model, "beta_s": 0.00276}, *cycle[1:], "pos"
    )


@pytest.mark.slow
@pytest.mark.parametrize("model", ["W1", "W2"])
def test_the_reference_is_what_the_adaptive_solver_converges_to(model, cycle):
    """Two independent schemes and codes; a single cycle repeats."""
    compiled, pga_g = solver(model, cycle), 0.9 / STANDARD_GRAVITY_M_S2
    found = histories.reference_of(compiled, pga_g, LIMITS)
    expected, end_s = peak_and_end(compiled.case, cycle[0], "pos", pga_g, nodes=25, tolerance=1e-5)
    assert found["repeats"] == 1
    assert 0.1 < found["d_over_b"] < 0.9
    assert found["d_over_b"] == pytest.approx(expected, rel=4e-3)
    assert end_s > 2.0


def test_intensities_are_shares_of_the_lowest_collapse(cycle):
    compiled = solver("W1", cycle)
    labels = {"half": "choosing", "model": "W1", "record": "cycle", "direction": "pos"}
    (row,) = histories.histories(compiled, labels, LIMITS)
    lowest = row["pga_g"] / 0.5
    assert compiled.d_over_b(1.001 * lowest, 9, 0.15) == 1.0
    assert compiled.d_over_b(lowest / histories.SCAN_RATIO, 9, 0.15) < 1.0
    assert set(row) == set(histories.COLUMNS)


def test_what_overturns_or_is_sensitive_is_not_trusted(cycle):
    compiled, pga_g = solver("W1", cycle), 0.9 / STANDARD_GRAVITY_M_S2
    assert histories.reference_of(compiled, 3.0, LIMITS)["repeats"] == 0
    assert histories.reference_of(compiled, pga_g, {**LIMITS, "trusted": 1e-3})["repeats"] == 0
    assert (
        histories.reference_of(compiled, pga_g, {**LIMITS, "repeat_tolerance": 1e-9})["repeats"]
        == 0
    )


def test_components_of_one_motion_stay_in_one_half():
    halves = [histories.half(row) for row in range(8)]
    assert halves == 2 * (2 * ["choosing"] + 2 * ["reporting"])


def test_the_draw_knows_no_order_and_leaves_out_what_does_not_repeat():
    rows = [
        {"case": f"W1 r{i}", "model": "W1", "half": "choosing", "repeats": i % 4 != 0}
        for i in range(40)
    ]
    table = pd.DataFrame(rows)
    few, many = histories.sampled(table, 5), histories.sampled(table, 15)
    again = histories.sampled(table.sample(frac=1.0, random_state=1), 5)
    assert few["case"].tolist() == again["case"].tolist() == many["case"].tolist()[:5]
    assert few["repeats"].all()
    assert len(histories.sampled(table, 100)) == 30


def runs():
    """Three cases by two methods; the second method missed the last case and failed once."""
    values = [("a", "x", 0.504), ("b", "x", 0.5), ("c", "x", 0.52), ("a", "y", 0.5), ("b", "y", 0)]
    table = pd.DataFrame(values, columns=["case", "method", "d_over_b"])
    table["status"] = np.where(table["d_over_b"] > 0, "ok", "failed")
    return table.assign(model="W1", nodes=9, dt_over_dt_crit=0.1, simulated_s=20.0, wall_s=2.0)


def known(cases="abc"):
    return pd.DataFrame({"case": list(cases)}).assign(
        d_over_b=0.5, d_over_b_compiled=0.4, repeats=1, amplification=1.0, half="reporting"
    )


def test_errors_and_their_spread():
    table = study.errors(runs(), known(), {"W1": (9, 0.1)})
    assert list(table.columns.drop("model")) == list(study.TABLE_COLUMNS)
    assert table["error"].tolist() == pytest.approx([0.008, 0.0, 0.04, 0.0, np.nan], nan_ok=True)
    spread = study.summary(table).set_index("method")
    assert spread.loc["x", "histories"] == 3
    assert spread.loc["x", "within_1_percent"] == pytest.approx(2.0 / 3.0)
    assert spread.loc["x", ["error_median", "error_worst"]].tolist() == pytest.approx([0.008, 0.04])
    assert spread.loc["x", "worst"] == "c"
    assert spread.loc["y", "within_1_percent"] == 0.5  # the failed run is wrong
    assert spread.loc["x", "cost"] == pytest.approx(0.1)
    found = study.errors(runs().assign(method=study.ADAPTIVE), known(), {"W1": (9, 0.1)})
    assert found["error"].iloc[1] == pytest.approx(0.25)  # the reference has no error of its own


def test_methods_stand_on_the_same_cases():
    table = study.errors(runs(), known(), {"W1": (9, 0.1)})
    common = study.same_cases(table)
    assert set(common["scene"]) == {"a", "b"}
    assert common.groupby("method").size().tolist() == [2, 2]


def test_other_engines_run_some_of_the_reporting_cases_and_yade_its_own_pair_too():
    rows = [
        {"case": f"{m} {h} {i}", "model": m, "record": "r", "direction": "pos", "half": h}
        for m in ("W1", "W2")
        for h in ("choosing", "reporting")
        for i in range(3)
    ]
    settings = {"nodes": [9, 17], "step_fractions": [0.1]}
    numerics = {"nodes_height": 9, "nodes_per_block": 9, "step_fraction": 0.05}
    scenes = {m: {"model": m, "numerics": numerics} for m in ("W1", "W2")}
    table = pd.DataFrame(rows)
    planned = pd.DataFrame(study.plan_runs(table.assign(pga_g=0.1), settings, scenes))
    expected = {f"{m} reporting {i}" for m in ("W1", "W2") for i in (0, 1)}
    assert study.charted(table, 2) == expected
    own = planned[planned["nodes"].isna()]
    assert len(own) == table["case"].nunique()  # the default pair is not in the grid
    assert len(planned) == 3 * len(own)
