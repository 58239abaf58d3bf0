"""Vertical motion: closed forms, three solvers beside each other, its energy, its files."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import reference_solver as reference
from rocking.collapse.scan import carried_masses
from rocking.configuration.config import ConfigError
from rocking.mechanics import closed_forms as cf
from rocking.records import RecordError, load, read_csv, write_csv
from rocking.records.floors import floor_columns
from rocking.runs import Runs
from rocking.solver import Motions, history, peaks
from test_plane import BETA_S, case, shaking, slender, wall_of
from yade_process import in_yade, resolved

from yade_scripts.model import floor_motions, registry
from yade_scripts.model.models import build_scene

ROOT = Path(__file__).parents[2]
TABLE = ROOT / "config" / "suites" / "recorded_suite.tsv"
CHAIN = {"n_dof": 4, "period_s": 0.27, "damping_ratio": 0.05, "damping_model": "modal"}
CHAIN["tail_s"] = 1.0
G = 9.81
LIFTS = (-0.4, 0.4)  # a_z/g
SOFT = {"height_m": 2.0, "e_mpa": 20.0, "width_m": 1.0}  # holds a tenth of what overturns it
MASS = {"building_mass_kg": 66e3}
BURST = {"peak_m_s2": 1.2, "vertical_m_s2": 6.0}
FACTOR = -0.7
ROOF = {"floors": [{"height_m": 6.48, "load_kn": 40.0, "friction": 0.05}]}


def motions(peak_m_s2, vertical_m_s2):
    """Floor motions of a burst with a faster vertical one."""
    t, ground = shaking(peak_m_s2, 2.5)
    up = np.interp(t, t / 3.1, shaking(vertical_m_s2, 2.5)[1], right=0.0)
    up += 0.5 * vertical_m_s2 * np.sin(2 * np.pi * t / t[-1])
    record = replace(load("GMN_NS", TABLE), acceleration_m_s2=ground, dt_s=t[1])
    return floor_columns(replace(record, vertical_m_s2=up), CHAIN)


# Closed forms --------------------------------------------------------------------------------


@pytest.mark.parametrize("lift", LIFTS)
def test_static_capacity_grows_with_gravity(lift):
    """A slow push overturns from tan α (g + a_z) on: not 1 % below, but 1 % above."""
    config, planar = case("free", 2e-5, **slender())
    t = np.linspace(0.0, 8.0, 801)
    push = 0.1 * G * (1.0 + lift) * np.minimum(t / 5.0, 1.0)
    found = []
    for share in (0.99, 1.01):
        motion = Motions(t, -share * push, (), np.full(t.size, lift * G))
        found.append(peaks(planar, motion, config["numerics"], 1.0))
    assert not any(f.failed[0] for f in found)
    assert [bool(f.overturned[0]) for f in found] == [False, True]


def test_a_mirror_image_keeps_the_vertical_motion():
    """Both directions, in the compiled solver and the reference, which share no line: 0.2 %."""
    config, planar = case("W1")
    time_s, columns = motions(**BURST)
    ground, up = columns["ground"], columns["vertical"]
    wall = wall_of(config, 1)
    for factor in (1.0, -1.0):
        found = {}
        for lift in (up, None):
            h = history(planar, Motions(time_s, ground, (), lift), config["numerics"], factor)
            motion = reference.SupportTable(time_s[1], ground, None, lift)
            expected = reference.simulate(wall, motion, scale=factor, tolerance=3e-6)
            assert h.peak_d_over_b > 0.03
            assert h.peak_d_over_b == pytest.approx(expected.d_over_b.max(), rel=2e-3)
            found[lift is None] = h.peak_d_over_b
            stored = expected.kinetic_j + expected.potential_j - expected.input_work_j
            left = stored - expected.contact_work_j
            assert np.ptp(left) < 1e-3 * expected.kinetic_j.max()
        assert abs(found[True] / found[False] - 1.0) > 0.02


# YADE ----------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def in_engine():
    """Releases under constant a_z, shaken façades and the energy balance of one, in one process."""
    free, _ = case("free", 2e-5, **slender())
    config, _ = case("W2", return_wall=MASS)
    loaded, _ = case("W1", facade=ROOF)
    time_s, columns = motions(**BURST)
    columns = {name: row.tolist() for name, row in columns.items()}
    given = {"config": config, "beta_s": BETA_S, "time_s": time_s.tolist(), "columns": columns}
    freed = {"config": free, "beta_s": 2e-5, "ratio": 0.5, "limit_s": 0.6}
    return in_yade(
        "vertical_cases",
        "every",
        releases=[{**freed, "vertical_m_s2": lift * G} for lift in LIFTS],
        launched={
            "config": resolved(facade=SOFT),
            "beta_s": 1e-5,
            "ratio": 1e-6,
            "limit_s": 0.05,
            "vertical_m_s2": -2.0 * G,
        },
        shakings={model: {**given, "factor": FACTOR} for model in ("W1", "W2", "W2m")},
        balance={**given, "config": loaded, "model": "W1", "fraction": 0.1},
    )


@pytest.mark.xdist_group("vertical")
@pytest.mark.yade
def test_a_constant_vertical_motion_is_gravity(in_engine):
    """Quarter period of free rocking with p = √(3(g + a_z)/4R), 1 % as without vertical motion."""
    for lift, found in zip(LIFTS, in_engine["releases"], strict=True):
        outward = np.array(found["rotation_rad"])
        i = np.flatnonzero(outward <= 0.0)[0]
        time = np.interp(0.0, outward[[i, i - 1]], np.array(found["time_s"])[[i, i - 1]])
        p = cf.block(1.0, 0.1, G * (1.0 + lift)).p_rad_s
        assert time == pytest.approx(cf.quarter_period(0.5, p), rel=0.01)


@pytest.mark.xdist_group("vertical")
@pytest.mark.yade
def test_the_ledger_counts_the_inertia_along_z(in_engine):
    """Before the impact energy gained is work done: 2 % of it for the springs under the toe."""
    for lift, found in zip(LIFTS, in_engine["releases"], strict=True):
        energy, work = np.array(found["ledger"])[250]
        assert work * lift > 0.0  # the façade falls
        assert energy == pytest.approx(work, rel=0.02)


@pytest.mark.xdist_group("vertical")
@pytest.mark.yade
def test_a_base_gives_back_what_the_weight_had_put_into_it(in_engine):
    """Ground falling at 2 g: W²/2k is set free, a tenth of what overturns it, and no failure."""
    found, weight = in_engine["launched"], 1800.0 * G * 2.0 * 0.375
    stiffness = SOFT["e_mpa"] * 1e6 / 2.0 * 0.375
    assert found["stored"] == pytest.approx(weight**2 / (2.0 * stiffness), rel=1e-3)
    energy, work = np.array(found["ledger"])[-1]
    assert energy - work > 0.9 * found["stored"]
    assert found["excess"] < 0.05
    assert found["status"] == "ok"


@pytest.mark.xdist_group("vertical")
@pytest.mark.yade
@pytest.mark.parametrize("model", ["W1", "W2", "W2m"])
def test_yade_agrees_with_the_planar_solver(in_engine, model):
    """Within 1 %, in the direction that mirrors the record, where it moves d/b by more."""
    config, planar = case(registry.model(model).one_way_model)
    time_s, columns = motions(**BURST)
    carried = None
    if registry.model(model).two_way:
        job = {**config, "return_wall": {**config["return_wall"], **MASS}}
        carried = carried_masses(job, build_scene({**job, "model": "W2", "beta_s": BETA_S}))
    floors = [columns[f"floor{j}"] for j in range(1, 5)] if model == "W2" else ()
    found = []
    for up in (columns["vertical"], None):
        driven = Motions(time_s, columns["ground"], floors, up)
        h = history(planar, driven, config["numerics"], FACTOR, carried=carried)
        found.append(h.peak_d_over_b)
    peak, status, reason = in_engine["peaks"][model]
    assert status == "ok", reason
    assert peak > 0.03
    assert peak == pytest.approx(found[0], rel=0.01)
    assert abs(found[1] / peak - 1.0) > 0.015


@pytest.mark.yade
def test_a_factor_turns_what_is_level_and_sizes_what_is_vertical():
    """In YADE's motions: the sign of the factor is the direction, which the vertical has not."""
    config, _ = case("W2")
    time_s, columns = motions(**BURST)
    given = {name: row.tolist() for name, row in columns.items()}
    factors = (0.7, -0.7)
    found = in_yade(
        "vertical_cases", "set_up",
        config=config, beta_s=BETA_S, time_s=time_s.tolist(), columns=given, factors=factors,
    )  # fmt: skip
    for factor, by_name in zip(factors, found, strict=True):
        assert set(by_name) == set(columns)
        for name, values in by_name.items():
            size = abs(factor) if name == "vertical" else factor
            assert np.array(values) == pytest.approx(size * columns[name], rel=1e-12)


@pytest.mark.xdist_group("vertical")
@pytest.mark.yade
def test_energy_balances_under_vertical_motion(in_engine):
    """Input, inertia of façade and roof along z included = stored + lost: to a thousandth of
    what overturns."""
    balance = in_engine["balance"]
    assert balance["peak"] > 0.05
    assert balance["residual"] < 1e-3 * balance["overturning"]


# Files ---------------------------------------------------------------------------------------


def test_from_the_table_to_the_motion_file(tmp_path):
    """Both motions of a station, their steps and lengths, through the files between jobs."""
    record = load("GMN_NS", TABLE, vertical_motion="on")
    alone, up = load("GMN_NS", TABLE), load("GMN_NS", TABLE, vertical=True)
    assert np.array_equal(record.acceleration_m_s2, alone.acceleration_m_s2)
    assert np.array_equal(record.vertical_m_s2, up.acceleration_m_s2)
    assert record.details["vertical"]["component"] == "GMN UD"
    write_csv(record, tmp_path / "GMN_NS.csv")
    again = read_csv(tmp_path / "GMN_NS.csv")
    assert again.vertical_m_s2 == pytest.approx(up.acceleration_m_s2, rel=1e-8, abs=1e-12)
    time_s, columns = floor_columns(again, CHAIN)
    vertical = columns["vertical"]
    inside = time_s <= again.time_s[-1]
    assert vertical[inside] == pytest.approx(
        np.interp(time_s[inside], again.time_s, again.vertical_m_s2), abs=1e-12
    )
    assert not vertical[time_s > again.time_s[-1] + again.dt_s].any()
    path = tmp_path / "motion.csv"
    ground, *floors = (columns[name] for name in columns if name != "vertical")
    floor_motions.write(path, time_s, ground, floors, vertical)
    assert floor_motions.read(path)[1]["vertical"] == pytest.approx(vertical, rel=1e-8, abs=1e-12)
    assert list(floor_motions.read(path)[1])[-2:] == ["floor4", "vertical"]


def test_a_vertical_motion_of_another_step_is_refused(tmp_path):
    for name, step in (("a", 0.01), ("b", 0.02)):
        rows = "\n".join(f"{step * i:.3f},{np.sin(i):.6f}" for i in range(50))
        (tmp_path / f"{name}.csv").write_text(f"time_s,acceleration_m_s2\n{rows}\n")
    table = tmp_path / "records.tsv"
    table.write_text("record\tfile\tvertical_file\nx\ta.csv\tb.csv\n")
    with pytest.raises(RecordError, match=r"record x: vertical .* 0\.02 s, expected 0\.01 s"):
        load("x", table, vertical_motion="on")


def test_a_record_without_a_vertical_motion_is_named():
    """Before anything is planned, in one line; off asks for none."""
    Runs({}, ROOT)
    with pytest.raises(ConfigError, match=r"vertical_motion = on: .*line 2: record BUCAR0 has no"):
        Runs({"vertical_motion": "on", "records_table": "config/records.tsv"}, ROOT)
