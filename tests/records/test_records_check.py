"""Faults and doubts of all records of a study, found at once and remembered by content."""

import json
import os
import time
from pathlib import Path

import numpy as np
import pytest
import record_samples as samples
from record_files.reader import open_file, pick
from record_files.record import G_M_S2, Record
from rocking.records import check as module
from rocking.records import read_table
from rocking.records.check import check_records, check_runs
from rocking.runs import Runs
from run_script import script

ROOT = Path(__file__).parents[2]
SUITE = ROOT / "config" / "suites" / "recorded_suite.tsv"


@pytest.fixture
def study(tmp_path):
    """Return a table with a sound record, a missing unit, a wrong component and a cut file."""
    several, single, at2 = samples.geonet(), samples.single_column(), samples.at2()
    for sample in (several, single):
        (tmp_path / sample.name).write_bytes(sample.data)
    (tmp_path / "cut.AT2").write_bytes(at2.data[:-200])
    path = tmp_path / "records.tsv"
    path.write_text(
        "record\tfile\tcomponent\tdt_s\tvertical\n"
        f"good\t{several.name}\t2\t\tUp\n"
        f"wrong\t{several.name}\t7\t\t\n"
        f"bare\t{single.name}\t\t0.02\t\n"
        "cut\tcut.AT2\t\t\t\n"
        f"up\t{several.name}\t1\t\tDown\n"
    )
    return path


def test_each_fault_is_one_line_with_its_file(study):
    found = {f.record: f for f in check_records(read_table(study).values())}
    assert {name: f.status for name, f in found.items()} == {
        "good": "ok",
        "wrong": "fault",
        "bare": "fault",
        "cut": "fault",
        "up": "fault",
    }
    for name, words in {
        "wrong": "'7' is none of #1 'S26W', #2 'S64E'",
        "bare": "states no units; state one of g, m/s2",
        "cut": "of 64 onwards",
        "up": "'Down' is none of",
    }.items():
        line = str(found[name])
        assert words in line
        assert found[name].file in line
        assert "\n" not in line


def test_a_repeated_check_reads_nothing_until_a_file_a_row_or_the_baseline_changes(
    study, tmp_path, monkeypatch
):
    cache = tmp_path / "new" / "cache.json"
    rows = list(read_table(study).values())
    first = check_records(rows, cache=cache)
    reads = []
    monkeypatch.setattr(module, "open_file", lambda *a: reads.append(a) or open_file(*a))
    assert check_records(rows, cache=cache) == first
    assert not reads
    assert check_records(rows, cache=cache, baseline="mean")[0].status == "ok"
    assert reads
    reads.clear()
    (tmp_path / "cut.AT2").write_bytes(samples.at2().data)
    again = check_records(rows, cache=cache)
    assert [path for path, _ in reads] == [str(tmp_path / "cut.AT2")]
    assert again[3].status == "ok"


def test_all_runs_of_a_study_are_checked_each_combination_once(study, tmp_path, monkeypatch):
    calls = []

    def counted(*args, **kwargs):
        calls.append(args)
        return check_records(*args, **kwargs)

    monkeypatch.setattr(module, "check_records", counted)
    config = {
        "records_table": str(study),
        "grid": {"facade.height_m": [6.0, 7.0], "baseline.method": ["none", "mean"]},
    }
    findings = check_runs(Runs(config, ROOT), cache=tmp_path / "c.json")
    assert len(calls) == 2
    assert [f.record for f in findings] == ["good", "wrong", "bare", "cut", "up"]


@pytest.mark.parametrize("content", ["", "[1]", '{"a": 1}', "\x00", '{"a": ["b"]}'])
def test_a_damaged_or_unwritable_cache_is_done_without(study, tmp_path, content):
    rows = list(read_table(study).values())
    cache = tmp_path / "cache.json"
    cache.write_text(content)
    expected = check_records(rows)
    assert check_records(rows, cache=cache) == expected
    assert json.loads(cache.read_text())
    assert check_records(rows, cache="/proc/none/cache.json") == expected
    assert not [name for name in os.listdir(tmp_path) if name.endswith(".tmp")]


def test_a_repeated_start_costs_far_less_than_reading(tmp_path):
    rows, times = list(read_table(SUITE).values()), []
    for _ in range(3):
        started = time.process_time()
        assert {f.status for f in check_records(rows, cache=tmp_path / "c.json")} == {"ok"}
        times.append(time.process_time() - started)
    assert min(times[1:]) < 0.1 * times[0]


def test_surrogates_that_cannot_be_are_faults(tmp_path):
    path = tmp_path / "r.tsv"
    path.write_text(
        "record\tpga_g\tpgv_cm_s\tpgd_cm\tduration_s\nno\t0.1\t100\t1\t10\nyes\t0.3\t30\t8\t20\n"
    )
    rows = list(read_table(path).values())
    for draw in (False, True):
        no, yes = check_records(rows, draw=draw)
        assert "PGA·PGD/PGV²" in no.message
        assert (no.status, yes.status) == ("fault", "ok")


def _record(a, source="file", units="g"):
    return Record("x", np.asarray(a, dtype=float), 0.01, source, units)


def test_doubtful_peaks_and_offsets_are_said():
    t = 0.01 * np.arange(2000)
    wave = np.sin(2 * np.pi * 5 * t)
    assert module.warnings(_record(2.9 * G_M_S2 * wave)) == []
    assert "above 3 g" in module.warnings(_record(3.1 * G_M_S2 * wave))[0]
    assert module.warnings(_record(wave + 1e-6)) == []  # drifts by 0.2 mm
    assert "offset 1.0" in module.warnings(_record(wave + 0.0105))[0]
    assert "61 samples, 0.6 s in all" in module.warnings(_record(wave[:61] - np.mean(wave[:61])))[0]
    # A fast sine of 1 g at 0.5 Hz moves at 3.1 m/s.
    slow = module.warnings(_record(G_M_S2 * np.sin(np.pi * t)))
    assert len(slow) == 1
    assert "m/s² called g? That would be 0.10 g, 0.32 m/s" in slow[0]


def test_m_s2_called_g_is_caught_and_true_motions_are_not():
    """Of the suite's 44 horizontal motions all but a few weak ones; no vertical or true one."""
    opened, caught = open_file(SUITE.with_suffix(".motions")), 0
    for row in read_table(SUITE).values():
        true = pick(*opened, **row.stated())
        assert module.warnings(true) == []
        caught += bool(module.warnings(_record_as(true)))
    assert caught >= 40


def _record_as(record):
    return Record("x", G_M_S2 * record.acceleration_m_s2, record.dt_s, "file", "g")


def test_the_script_writes_the_table_of_all(study, tmp_path):
    output = tmp_path / "records_check.csv"
    done = script("check_records", tmp_path, params={"table": str(study)}, output=str(output))
    assert output.read_text().startswith(
        "record,file,status,message,dt_s,duration_s,pga_g,pgv_cm_s,"
    )
    assert done.stderr.count("fault: record") == 4
    assert "1 ok" in done.stdout


def test_an_offset_of_any_size_is_named_with_its_drift():
    """Of half a percent over 20 s the ground goes farther than the motion: ½·a·T²."""
    t = 0.01 * np.arange(2000)
    said = module.warnings(_record(np.sin(2 * np.pi * 5 * t) + 0.005))
    assert len(said) == 1
    assert "mean offset 0.5 % of the peak, by which the displacement drifts 1 m in 20 s" in said[0]


def of_peak(folder, pga_g):
    (folder / "weak.txt").write_text("".join(f"{pga_g * np.sin(k / 5):.9f}\n" for k in range(943)))
    (folder / "t.tsv").write_text("record\tfile\tdt_s\tunits\nweak\tweak.txt\t0.01\tg\n")
    return list(read_table(folder / "t.tsv").values())


@pytest.mark.parametrize(("pga_g", "status"), [(0.3, "ok"), (0.011, "ok"), (0.009, "warning")])
def test_a_record_that_is_scaled_far_is_said_with_its_factor(tmp_path, pga_g, status):
    (found,) = check_records(of_peak(tmp_path, pga_g), reach_g=0.2)
    assert found.status == status
    assert found.factor == pytest.approx(0.2 / pga_g, rel=1e-3)
    assert ("scaled some 22 times to 0.2 g" in found.message) is (status == "warning")


def test_a_check_tells_step_duration_and_peaks_also_from_its_memory(tmp_path):
    rows = of_peak(tmp_path, 0.2)
    for _ in range(2):
        (found,) = check_records(rows, cache=tmp_path / "c.json")
        assert (found.dt_s, found.duration_s) == (0.01, pytest.approx(9.42))
        assert found.pga_g == pytest.approx(0.2, rel=1e-3)
        # integral of a sine by trapezia of 0.2 rad
        assert found.pgv_cm_s == pytest.approx(0.2 * 980.665 * 0.01 / np.tan(0.1), rel=1e-3)
        assert found.drift_m < 0.02


def test_what_a_run_takes_records_to_is_its_grid_or_where_a_facade_may_fall():
    run = {"ida": {"mode": "adaptive", "grid_g": [0.1, 1.2], "max_pga_g": 3.0}}
    run["facade"] = {"thickness_m": 0.375, "height_m": 6.48}
    assert module.reach_g(run) == pytest.approx(0.174, abs=1e-3)
    assert module.reach_g({**run, "ida": {**run["ida"], "max_pga_g": 0.1}}) == 0.1
    assert module.reach_g({**run, "ida": {**run["ida"], "mode": "grid"}}) == 1.2


def test_a_motion_under_two_names_is_said(tmp_path):
    of_peak(tmp_path, 0.2)
    with open(tmp_path / "t.tsv", "a") as handle:
        handle.write("again\tweak.txt\t0.01\tg\n")
    first, second = check_records(read_table(tmp_path / "t.tsv").values())
    assert first.status == "ok"
    assert (second.status, second.message) == (
        "warning",
        "the same motion as record weak: it counts twice",
    )


def test_another_peak_than_the_table_s_and_samples_cut_off_are_said(tmp_path):
    t = 0.01 * np.arange(2000)
    a = 0.3 * np.sin(2.0 * np.pi * 1.3 * t) * np.hanning(2000)
    np.savetxt(tmp_path / "whole.txt", a, fmt="%.6f")
    np.savetxt(tmp_path / "cut.txt", np.clip(a, -0.2, 0.25), fmt="%.6f")
    rows = [
        ("GOOD", "whole", 0.3),
        ("NONE", "whole", ""),
        ("MS2", "whole", 2.9),
        ("CUT", "cut", ""),
    ]
    (tmp_path / "mine.tsv").write_text(
        "record\tfile\tdt_s\tunits\tpga_g\n"
        + "".join(f"{name}\t{file}.txt\t0.01\tg\t{pga}\n" for name, file, pga in rows)
    )
    said = {f.record: f.message for f in check_records(read_table(tmp_path / "mine.tsv").values())}
    assert said["GOOD"] == ""
    assert "the table says a peak of 2.9 g, the file has 0.3" in said["MS2"]
    assert "samples in a row: was it cut off" in said["CUT"]


def test_no_recorded_motion_is_said_to_be_cut_off_or_other_than_its_table():
    for row in list(read_table(SUITE).values())[:8]:
        record = pick(*open_file(row.path, row.format), **row.stated())
        assert module._as_read(record, row.targets["pga_g"]) == []


def test_a_surrogate_s_facts_are_its_targets(tmp_path):
    path = tmp_path / "records.tsv"
    path.write_text("record\tpga_g\tpgv_cm_s\tpgd_cm\tduration_s\nA\t0.21\t23.6\t4.4\t16.2\n")
    (found,) = check_records(read_table(path).values(), reach_g=0.42)
    facts = (found.dt_s, found.duration_s, found.pga_g, found.pgv_cm_s)
    assert facts == (None, 16.2, 0.21, 23.6)
    assert found.factor == pytest.approx(2.0)


def test_a_pipe_in_the_place_of_what_is_remembered_is_not_waited_for(study, tmp_path):
    cache = tmp_path / "cache.json"
    os.mkfifo(cache)
    assert len(check_records(read_table(study).values(), cache=cache)) == 5
