"""The short climb to 10 and 50 % collapse beside the dense scan, on a pulse."""

import numpy as np
import pytest
from rocking.assessment.collapse import collapse_pga
from rocking.collapse import search
from rocking.collapse.probability import first_crossing, from_scan
from rocking.collapse.scan import Screen
from rocking.configuration import config
from rocking.records import Record
from rocking.records.floors import floor_columns

SETTINGS = {"level_ratio": 0.02, "beyond": 1.35, "max_pga_g": 3.0, "members": 7}


def scene(model):
    cfg = config.resolve({"return_wall": {"building_mass_kg": 77000.0}})
    parts = ("facade", "return_wall", "smdof", "numerics")
    job = {key: cfg[key] for key in parts} | {"model": model, "beta_s": 0.00276}
    job["numerics"] |= {"after_motion_s": 3.0}
    return job


def pulse():
    t = 0.01 * np.arange(160)
    return Record("pulse", -np.sin(2.0 * np.pi * t / 0.8) * (t < 0.8), 0.01, source="file")


@pytest.mark.parametrize("model", ["W1", "W2"])
def test_the_climb_finds_what_the_dense_scan_finds(model):
    job, record = scene(model), pulse()
    job["smdof"] = job["smdof"] | {"tail_s": 1.0}
    ((direction, low, half, runs),) = collapse_pga(job, record, ["pos"], 3.0)
    table = Screen(job, *floor_columns(record, job["smdof"]), "pos").scan(
        SETTINGS | {"amplitude_spread": 0.01}
    )
    dense = from_scan(table, 0.01)
    expected = first_crossing(dense["pga_g"].to_numpy(), dense["probability"].to_numpy(), 0.5)
    assert half == pytest.approx(expected, rel=0.03)
    assert low <= half
    assert runs < len(table)


def test_a_façade_that_stands_has_no_crossing():
    job = scene("W1")
    ((_, low, half, _),) = collapse_pga(job, pulse(), ["pos"], 0.05)
    assert np.isnan(low)
    assert np.isnan(half)


def test_levels_end_where_they_are_told_to():
    levels = search.rising(0.1, 0.5, 1.3)
    assert levels[0] == 0.1
    assert levels[-1] == 0.5
    assert np.all(np.diff(levels) > 0.0)
    assert search.rising(0.5, 0.1, 1.3).size == 0
