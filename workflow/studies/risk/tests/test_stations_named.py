"""Intervals come from stations: records that name none are told of, once."""

import numpy as np
import pytest
from forked import snakemake

pytestmark = pytest.mark.slow


def test_records_without_a_station_are_named_where_an_interval_is_drawn(tmp_path):
    """Once, and not by a target that draws none, nor where the table names stations."""
    sine = 0.3 * np.sin(2 * np.pi * 1.2 * np.arange(0.0, 10.0, 0.01))
    np.savetxt(tmp_path / "good.txt", sine, fmt="%.6f")
    table, path = "record\tfile\tdt_s\tunits\tstation", tmp_path / "mine.tsv"
    rows = [f"S{i}{c}\t{tmp_path / 'good.txt'}\t0.01\tg" for i in range(4) for c in "NE"]
    words = ["-n", "--config", "records_table=mine.tsv", "models=W1,W2", "directions=pos", "--"]

    def said(stations, target):
        path.write_text("\n".join([table, *map("{}\t{}".format, rows, stations)]) + "\n")
        done = snakemake(tmp_path, *words, target, snakefile="Snakefile")
        assert done.returncode == 0, done.stderr[-2000:]
        lines = [line for line in done.stderr.splitlines() if line.startswith("warning")]
        return [line for line in lines if "station" in line]

    (line,) = said([""] * 8, "fragility")
    assert line.startswith("warning: mine.tsv: 8 of 8 records name no station")
    assert said([""] * 8, "all") == []
    assert said([f"S{i // 2}" for i in range(8)], "fragility") == []
