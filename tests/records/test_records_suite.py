"""The shipped recorded motions: peaks of their source, provenance, and damage refused."""

import csv
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import record_samples as samples
from record_files import packed
from record_files.reader import open_file, pick
from rocking.records import (
    RecordError,
    integrate,
    load,
    measures,
    read_csv,
    read_record,
    read_table,
    write_csv,
)

ROOT = Path(__file__).parents[2]
TABLE = ROOT / "config" / "suites" / "recorded_suite.tsv"
MOTIONS = TABLE.with_suffix(".motions")
with open(
    Path(__file__).parents[1] / "data" / "recorded_suite_inventory.tsv", encoding="utf-8"
) as _:
    INVENTORY = list(csv.DictReader(_, delimiter="\t"))


@pytest.fixture(scope="module")
def opened():
    return open_file(MOTIONS)


def test_peaks_and_durations_of_all_motions_are_the_inventory_s(opened):
    assert len(opened[2]) == len(INVENTORY) == 66
    for item in INVENTORY:
        record = pick(*opened, component=f"{item['station']} {item['component']}")
        peaks = measures(record)
        assert len(record) == int(item["samples"])
        assert record.dt_s == float(item["dt_s"])
        # The inventory's velocity is Δt Σ a_i; exact integration differs by up to 1.05 %.
        peaks["pgv_cm_s"] = 100 * np.abs(np.cumsum(record.acceleration_m_s2)).max() * record.dt_s
        for key in ("pga_g", "pgv_cm_s", "pgd_cm"):
            assert peaks[key] == pytest.approx(float(item[key]), rel=0.01), (item["file"], key)
        assert peaks["significant_duration_s"] == pytest.approx(float(item["d5_95_s"]), abs=0.011)


def test_one_row_adds_a_record_of_one_s_own(tmp_path):
    """The row of docs/motions.md, in a copy of the project's folders."""
    suites = tmp_path / "config" / "suites"
    suites.mkdir(parents=True)
    for path in (TABLE, MOTIONS):
        (suites / path.name).write_bytes(path.read_bytes())
    (tmp_path / "my_record.txt").write_text("0.0\n0.1\n-0.2\n0.1\n0.0\n")
    page = (ROOT / "docs" / "motions.md").read_text("utf-8")
    command = next(line for line in page.splitlines() if line.startswith("printf 'MINE"))
    subprocess.run(command, shell=True, cwd=tmp_path, check=True, timeout=60)
    assert list(read_table(suites / TABLE.name))[-2:] == ["T1214_NS", "MINE"]
    peaks = measures(load("MINE", suites / TABLE.name))
    assert (peaks["pga_g"], peaks["duration_s"]) == pytest.approx((0.2, 0.04))


def test_the_table_has_44_horizontal_motions_with_their_vertical_ones():
    rows = read_table(TABLE)
    horizontal = [item for item in INVENTORY if item["axis"] == "horizontal"]
    names = {f"{item['station']}_{item['component']}" for item in horizontal}
    assert set(rows) == names
    assert len(rows) == 44
    vertical = {item["station"]: item for item in INVENTORY if item["axis"] == "vertical"}
    row = rows["AQV_WE"]
    assert row.vertical == "AQV UD"
    up = measures(load("AQV_WE", TABLE, vertical=True))
    assert up["pga_g"] == pytest.approx(float(vertical["AQV"]["pga_g"]), rel=1e-3)
    for row in rows.values():
        item = next(i for i in horizontal if f"{i['station']} {i['component']}" == row.component)
        assert row.targets["pga_g"] == float(item["pga_g"])
        assert row.vertical == f"{item['station']} UD"


def test_provenance_reaches_the_facts_beside_a_record(tmp_path):
    write_csv(load("LPCC_H1", TABLE), tmp_path / "LPCC_H1.csv")
    record = read_csv(tmp_path / "LPCC_H1.csv")
    assert record.source == "recorded, shipped"
    assert record.details["station"] == "LPCC"
    assert "Kallioras" in record.details["source"]
    assert record.details["licence"].startswith("CC BY 4.0")
    assert "rounded" in record.details["changes"]


@pytest.mark.parametrize("seed", range(3))
def test_packing_keeps_acceleration_velocity_and_displacement(tmp_path, seed):
    """|a − q n| ≤ q and |Δv| ≤ q Δt, whatever the motion; so displacement hardly drifts."""
    rng = np.random.default_rng(seed)
    a = np.cumsum(rng.standard_normal(5000)) * np.exp(-np.linspace(0, 6, 5000))
    about = {"label": "X", "station": "", "event": "", "time_utc": "", "units": "m/s2"}
    path = tmp_path / "x.motions"
    packed.write(path, [(a, about | {"dt_s": 0.01})], source="s", licence="l")
    b = read_record(path).acceleration_m_s2
    q = packed.RESOLUTION * np.abs(a).max() * (1 + 1e-6)
    assert np.abs(a - b).max() <= q
    (va, da), (vb, db) = integrate(a, 0.01), integrate(b, 0.01)
    assert np.abs(va - vb).max() <= q * 0.01
    assert np.abs(da - db).max() <= q * 0.01**2 * len(a)


def test_damage_is_refused_by_its_line(tmp_path):
    lines = samples.packed().data.decode().splitlines()
    start = next(i for i, line in enumerate(lines) if line.startswith("motion: "))
    path = tmp_path / "x.motions"
    for place, change in (
        (start + 2, lambda line: line[:-1] + ("0" if line[-1] != "0" else "1")),
        (start + 2, lambda line: ""),
        (start + 3, lambda line: ""),
        (start, lambda line: line.replace('"samples": ', '"samples": 1')),
        (start, lambda line: line.replace("dt_s", "dt")),
        (start, lambda line: line[:40]),
        (1, lambda line: ""),
    ):
        damaged = [*lines[:place], change(lines[place]), *lines[place + 1 :]]
        path.write_text("\n".join(damaged) + "\n", encoding="utf-8")
        with pytest.raises(RecordError, match=r"line \d+: "):
            open_file(path)


def test_the_committed_files_are_those_of_the_tool(tmp_path, monkeypatch):
    folder = ROOT.parent / "shared" / "suite"
    if not folder.is_dir():
        pytest.skip("the source files are not here")
    monkeypatch.syspath_prepend(str(ROOT / "tools"))
    import pack_motions

    monkeypatch.setattr(pack_motions, "SUITE", tmp_path / MOTIONS.name)
    pack_motions.main(folder)
    for path in (MOTIONS, TABLE):
        assert (tmp_path / path.name).read_bytes() == path.read_bytes()
    sys.modules.pop("pack_motions")
