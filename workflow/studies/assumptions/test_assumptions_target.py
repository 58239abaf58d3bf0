"""The target `assumptions`: its plan, and a reduced map whose limit is known."""

from pathlib import Path

import pandas as pd
import pytest
from forked import snakemake

ROOT = Path(__file__).resolve().parents[3]
REDUCED = [
    "--config",
    "run=small",
    f"records_table={ROOT}/config/records.tsv",
    "records=RRS228",
    "directions=neg",
    "models=[W2, W2m]",
    "return_wall={building_mass_kg: 66000}",
    "numerics={after_motion_s: 0.1}",
    "ida={level_ratio: 0.1, power: 0}",  # what is asserted of the curves are their models
    "ensemble={realisations: 3, amplitude_spread: 0.05}",
    "assumptions={mass_ratios: [0.001, 0.3], periods_s: [0.27], damping_ratios: [],"
    " level_ratio: 0.1}",
]


@pytest.mark.slow
def test_the_scenario_plans_every_chart(tmp_path):
    """Both runs: the map over the recorded suite, the charts of W2 and of W3."""
    scenario = str(ROOT / "workflow/studies/assumptions/scenario.yaml")
    done = snakemake(tmp_path, "-n", "--configfile", scenario, "--", "assumptions")
    assert done.returncode == 0, done.stderr[-2000:]
    jobs = dict(
        line.split() for line in (done.stdout + done.stderr).splitlines() if len(line.split()) == 2
    )
    assert jobs["assumptions_map"] == "44"
    assert jobs["assumptions_varied"] == "8"
    assert jobs["figure_assumptions_tornado"] == "2"


@pytest.mark.slow
def test_a_light_facade_cannot_push_its_building(tmp_path):
    """Through the rules: at a thousandth of the building's mass W2 has no error.

    A complete building's curves join those of the run's records, and no others do.
    """
    rows = ("0.20,0,1", "0.22,0.5,2", "0.25,1,3")
    given = [f"CB,{record},neg,{row}" for record in ("RRS228", "elsewhere") for row in rows]
    (tmp_path / "cb.csv").write_text(
        "\n".join(["model,record,direction,pga_g,probability,realisations", *given, ""])
    )
    options = [*REDUCED[:-1], REDUCED[-1].replace("{", "{other_curves: [cb.csv], ")]
    done = snakemake(
        tmp_path, *options, "--", "results/small/tables/assumptions_map.csv",
        "results/small/tables/assumptions.csv",
    )  # fmt: skip
    assert done.returncode == 0, done.stderr[-3000:]
    results = tmp_path / "results/small"
    table = pd.read_csv(results / "tables/assumptions_map.csv").set_index(["mass_ratio", "measure"])
    assert table.loc[(0.001, "median"), "median"] == pytest.approx(1.0, abs=0.02)
    beside = pd.read_csv(results / "tables/assumptions.csv")
    assert beside["model"].tolist() == ["W2", "W2m", "CB"]
    # half a straight line to each side of 0.22 g
    assert beside["pga_mean_g"].iloc[2] == pytest.approx(0.2 + 0.75 * 0.02 + 0.25 * 0.03, abs=1e-4)
