"""Rows of ties that `assess` finds, given back: with them it passes, with 95 % it does not."""

import pandas as pd
import pytest
import yaml
from forked import snakemake
from rocking.assessment import verdict
from rocking.tables import read_tables

pytestmark = [pytest.mark.slow, pytest.mark.yade]

CONFIG = """
models: [W2]
records_table: config/suites/recorded_suite.tsv
records: [GMN_NS, IS101_Lo, IS113_Lo, LPCC_H1, BGI_NS, IS106_Lo, IS108_Lo]
directions: [neg]
facade:
  height_m: 4.2
  thickness_m: 0.3
  width_m: 4.0
  density_kg_m3: 1700
damping: {law: value, beta_s: 0.001}
smdof: {n_dof: 2, period_s: 0.2}
assessment: {confidence_factor: 1.2, ag_g: 0.16, f0: 2.4, tc_star_s: 0.3, soil: B,
  motions: 7, yade_histories: 0, dynamic_realisations: 0, resamples: 100, shaken_within: 1.1}
"""
TABLES = ["code_checks", "mechanisms", "parts_check_W2", "dynamic_check_W2"]


def assessed(here, run, *files):
    """Whether a run passes by hand, and shaken."""
    wanted = [f"results/{run}/assessment/{name}.csv" for name in TABLES]
    given = ["--configfile", "small.yaml", *files, "--config", f"run={run}", "--", *wanted]
    done = snakemake(here, *given)
    assert done.returncode == 0, done.stderr
    checks, mechanisms = (pd.read_csv(here / path) for path in wanted[:2])
    return verdict.passes(checks, mechanisms, read_tables([here / path for path in wanted[2:]]))


def test_with_the_rows_given_back_it_passes_and_with_95_per_cent_of_the_force_it_does_not(tmp_path):
    (tmp_path / "small.yaml").write_text(CONFIG)
    found = tmp_path / "results/small/assessment/ties.yaml"
    words = ["--configfile", "small.yaml", "--config", "run=small", "--"]
    done = snakemake(tmp_path, *words, str(found.relative_to(tmp_path)))
    assert done.returncode == 0, done.stderr
    assert pd.read_csv(found.with_name("ties_mechanisms.csv"))["beyond"].sum() == 0
    (tmp_path / "all.yaml").write_text(found.read_text())
    given = yaml.safe_load(found.read_text())
    assert given["facade"]["ties"]
    for row in given["facade"]["ties"]:
        row["diameter_mm"] *= 0.95**0.5
    (tmp_path / "less.yaml").write_text(yaml.safe_dump(given))
    assert not all(assessed(tmp_path, "small"))
    assert all(assessed(tmp_path, "tied", "all.yaml"))
    assert not all(assessed(tmp_path, "less", "less.yaml"))
