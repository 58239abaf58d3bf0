"""Scripts of fragility and capacity reduction, run alone on small made-up results."""

import json
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from rocking.collapse.ida import curve_key
from rocking.records import Record, load, read_table, write_csv
from rocking.runs import Runs
from run_script import script

from smdof.chain import floor_motions
from yade_scripts.model.motion import SupportMotion

pytestmark = pytest.mark.slow

ROOT = Path(__file__).resolve().parents[2]
OUTPUTS = ("fragility", "measures", "sufficiency", "brackets", "curves", "factors")
PERIODS = [0.5, 0.63, 0.8, 1.0, 1.25, 1.6, 2.0]
STATIONS = {f"R{i}": f"S{i}" for i in range(len(PERIODS))}
HEAD = "model,record,direction,pga_g,d_over_b,collapsed,status,dt_s,steps,wall_s\n"


def record(folder, name, scale=1.0, period_s=1.0):
    """A sine of 0.3 g times `scale`; PGV is proportional to the period."""
    t = np.arange(0.0, 10.0, 0.01)
    motion = Record(name, scale * 2.94 * np.sin(2 * np.pi * t / period_s), 0.01, "surrogate")
    write_csv(motion, folder / f"{name}.csv")
    return str(folder / f"{name}.csv")


def curve(path, model, name, direction, safe, collapse):
    """An IDA table with one safe and, unless None, one collapsing intensity."""
    rows = f"{model},{name},{direction},{safe},0.4,0,ok,1e-4,1000,0.5\n"
    if collapse is not None:
        rows += f"{model},{name},{direction},{collapse},1,1,overturned,1e-4,1000,0.5\n"
    path.write_text(HEAD + rows)
    return str(path)


def collapse_tables(folder, curves, ending="", scans=()):
    """Tables of collapse intensities and probability; without scans, of YADE's runs alone."""
    names = {k: str(folder / f"{k}{ending}.csv") for k in ("collapse", "probability")}
    lists = {"ida": curves, "ensemble": [], "scans": scans}
    keys = [list(curve_key(pd.read_csv(path))) for path in scans or curves]
    params = {"spread": 0.01, "slope": 2.0, "curves": keys}
    script("table_ida_collapse", folder, input=lists, output=names, params=params)
    return names


@pytest.fixture(scope="module")
def fragility(tmp_path_factory):
    """Façade that falls at a PGV of 40 cm/s exactly, whatever the record; one curve never does."""
    folder = tmp_path_factory.mktemp("fragility")
    periods = PERIODS
    records = [record(folder, f"R{i}", 1 + i, period) for i, period in enumerate(periods)]
    curves = []
    for i, period in enumerate(periods):
        pga = 0.40 / (period / np.pi) / 9.80665  # PGV = aT/π from rest
        curves.append(curve(folder / f"W1_{i}.csv", "W1", f"R{i}", "pos", pga * 0.97, pga * 1.03))
    curves.append(curve(folder / "W1_never.csv", "W1", "R2", "neg", 3.0, None))
    names = {k: str(folder / f"{k}.csv") for k in OUTPUTS}
    settings = {
        "measures": ["pgv_cm_s", "pga_g", "p_pgv_over_g"],
        "confidence": 0.9,
        "resamples": 200,
        "min_stations": 12,
        "seed": 1,
    }
    script(
        "fragility_table",
        folder,
        input={**collapse_tables(folder, curves[:-1]), "records": records},
        output=names,
        params={
            "stations": STATIONS,
            "fragility": settings,
            "hazard_slope": 2.0,
            "facade": {"height_m": 6.48, "thickness_m": 0.375},
            "smdof": {"period_s": 0.27, "damping_ratio": 0.05},
        },
    )
    with_never = {k: v.replace(".csv", "_all.csv") for k, v in names.items()}
    script(
        "fragility_table",
        folder,
        input={**collapse_tables(folder, curves, "_all"), "records": records},
        output=with_never,
        params={
            "stations": STATIONS,
            "fragility": settings,
            "hazard_slope": 2.0,
            "facade": {"height_m": 6.48, "thickness_m": 0.375},
            "smdof": {"period_s": 0.27, "damping_ratio": 0.05},
        },
    )
    return {k: pd.read_csv(v) for k, v in names.items()}, pd.read_csv(with_never["fragility"])


@pytest.mark.xdist_group("fragility")
def test_the_measure_that_governs_has_no_dispersion_and_its_median_is_the_capacity(fragility):
    tables, _ = fragility
    fits = tables["fragility"].set_index("im")
    assert fits.loc["pgv_cm_s", "median"] == pytest.approx(40.0, rel=0.01)
    assert fits.loc["pgv_cm_s", "dispersion"] <= 0.02
    logs = -np.log(PERIODS)  # collapse PGA is inverse to the period
    assert fits.loc["pga_g", "dispersion"] == pytest.approx(np.std(logs), rel=0.01)
    p = np.sqrt(0.75 * 9.81 / (0.5 * np.hypot(6.48, 0.375)))
    assert fits.loc["p_pgv_over_g", "median"] == pytest.approx(p * 0.40 / 9.80665, rel=0.01)
    assert set(fits["remark"]) == {"indicative: 7 records of 7 stations"}
    share = tables["measures"].set_index("im")["less_than_pga"]
    assert share["pgv_cm_s"] > 0.95


@pytest.mark.xdist_group("fragility")
def test_a_curve_without_collapse_counts(fragility):
    tables, with_never = fragility
    row = with_never[with_never["im"] == "pga_g"].iloc[0]
    before = tables["fragility"].set_index("im").loc["pga_g"]
    assert (row["n"], row["n_censored"], row["n_records"], row["n_stations"]) == (8, 1, 7, 7)
    assert row["median"] > before["median"]
    assert row["dispersion"] > before["dispersion"]


def test_what_yade_does_not_confirm_rests_on_the_scan_alone(tmp_path):
    """Two scanned curves that fall at 0.31 g; YADE, which runs the second, falls at 0.28 g."""
    scans = [
        curve(tmp_path / f"scan_{name}.csv", "W1", name, "pos", 0.29, 0.31) for name in ("A", "B")
    ]
    own = curve(tmp_path / "ida_B.csv", "W1", "B", "pos", 0.27, 0.28)
    found = collapse_tables(tmp_path, [own], scans=scans)
    table = pd.read_csv(found["collapse"]).set_index("record")
    assert table["pga_collapse_g"].to_dict() == {"A": 0.31, "B": 0.28}
    assert table["runs_yade"].to_dict() == {"A": 0, "B": 2}
    assert (table["runs_planar"] == 2).all()
    assert table.loc["A", "pga_p10_g"] == table.loc["B", "pga_p10_g"]


def test_yade_confirms_the_records_that_the_configuration_says():
    config = {
        "models": ["W1", "W3"],
        "records_table": "config/records.tsv",
        "records": ["BUCAR0", "RRS228", "HVSC1"],
        "facade": {"courses": 0},
        "directions": ["neg"],
        "ida": {"confirm_every": 2},
    }
    runs = Runs(config, ROOT)
    curves = [(m, r, "neg") for m in config["models"] for r in config["records"]]
    assert runs.scans("main") == curves
    assert runs.by_yade("main") == [curve for curve in curves if "RRS228" not in curve]
    assert runs.confirmed("main") == ["BUCAR0", "HVSC1"]
    config["ida"] = {"mode": "grid", "confirm_every": 2}
    grid = Runs(config, ROOT)
    assert grid.scans("main") == []
    assert grid.by_yade("main") == curves


def test_committed_suite_is_the_one_its_rule_makes(tmp_path):
    script("surrogate_suite", tmp_path, output={"table": str(tmp_path / "suite.tsv")})
    committed = ROOT / "config/suites/surrogate_suite.tsv"
    assert (tmp_path / "suite.tsv").read_bytes() == committed.read_bytes()
    names = list(read_table(committed))
    assert len(names) == 44
    motion = load(names[0], committed)  # a surrogate of the given peaks can be made
    assert np.abs(motion.acceleration_m_s2).max() / 9.80665 == pytest.approx(0.618, rel=0.01)


@pytest.mark.parametrize("below", [0, 3])
def test_motion_of_a_facade_up_the_building_is_that_of_the_floors_it_stands_on(tmp_path, below):
    path = record(tmp_path, "R")
    out = {"motion": str(tmp_path / "m.csv"), "facts": str(tmp_path / "m.json")}
    chain = {"n_dof": 2, "damping_ratio": 0.05, "damping_model": "modal", "tail_s": 1.0}
    script(
        "capacity_reduction_motion",
        tmp_path,
        input={"record": path},
        output=out,
        params={"smdof": chain},
        wildcards={"t1": "0.3", "below": str(below)},
    )
    given = pd.read_csv(path)["acceleration_m_s2"].to_numpy()
    tail_s = np.log(1e4) * 0.3 / (2 * np.pi * 0.05)  # longer than the 1 s asked for
    whole = floor_motions(given, 0.01, below + 2, 0.3, 0.05, "modal", tail_s=tail_s)
    levels = np.vstack([whole.ground_m_s2, whole.floors_m_s2])
    found = pd.read_csv(out["motion"])
    assert list(found.columns) == ["time_s", "ground_m_s2", "floor1_m_s2", "floor2_m_s2"]
    motions = found.to_numpy()[:, 1:].T
    np.testing.assert_allclose(motions, levels[below:], rtol=1e-6, atol=1e-7)
    for level in motions:  # YADE holds the last value, so what drives a support ends at zero
        driven = SupportMotion(found["time_s"].to_numpy(), level)
        np.testing.assert_array_equal(driven.acceleration_m_s2[: level.size], level)
        assert driven.acceleration_m_s2[-1] == 0.0 or abs(level[-1]) < 1e-9 * abs(level).max()
    speed = np.cumsum(levels[-1] - levels[0]) * 0.01
    assert np.abs(speed[-30:]).max() < 0.005 * np.abs(speed).max()  # at rest on the ground
    facts = json.loads(Path(out["facts"]).read_text())
    assert facts["base_height_ratio"] == pytest.approx(below / (below + 2))
    assert facts["base_peak_g"] == pytest.approx(np.abs(levels[below]).max() / 9.80665)
    assert (facts["base_peak_g"] > 1.2 * facts["pga_g"]) == (below > 0)


def test_capacity_ratio_is_in_ground_acceleration(tmp_path):
    """A façade that falls at a base peak of 0.3 g and sits where the peak doubles: ratio 1/2."""
    record(tmp_path, "R")
    case = tmp_path / "T0.3_below4"
    case.mkdir()
    facts = {
        "record": "R",
        "t1_s": 0.3,
        "masses_below": 4,
        "base_height_ratio": 0.5,
        "pga_g": 0.3,
        "base_peak_g": 0.6,
    }
    (case / "R.json").write_text(json.dumps(facts))
    w1 = [
        curve(tmp_path / "w1p.csv", "W1", "R", "pos", 0.29, 0.31),
        curve(tmp_path / "w1n.csv", "W1", "R", "neg", 0.29, 0.31),
    ]
    w2 = [
        curve(case / "R_pos.csv", "W2", "R", "pos", 0.29, 0.31),
        curve(case / "R_neg.csv", "W2", "R", "neg", 3.0, None),
    ]
    out = {"table": "t.csv", "png": "f.png", "pdf": "f.pdf"}
    script(
        "figure_capacity_reduction",
        tmp_path,
        input={
            "w1": w1,
            "w2": w2,
            "w1_scans": w1,  # two amplitudes make a scan
            "w2_scans": w2,
            "facts": [str(case / "R.json")],
            "records": [str(tmp_path / "R.json")],
        },
        output={k: str(tmp_path / v) for k, v in out.items()},
        params={"spread": 0.01, "hazard_slope": 2.0, "w1": w1, "w2": w2},
    )
    table = pd.read_csv(tmp_path / "t.csv").set_index("direction")
    assert table.loc["pos", "ratio"] == pytest.approx(0.5)
    assert table.loc["pos", "ratio_equivalent"] == pytest.approx(0.5)
    assert np.isnan(table.loc["neg", "ratio_equivalent"])
    assert table["censored"].to_dict() == {"pos": 0, "neg": 1}
    assert table.loc["pos", "source"] == "surrogate"
    assert (tmp_path / "f.png").stat().st_size > 5000
