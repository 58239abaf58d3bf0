"""A run of the defaults ends with an answer: said, tabled, drawn, and checked by YADE."""

import pandas as pd
import pytest
from forked import snakemake

SMALL = (
    *("--config", "run=one", "records=GMN_NS", "directions=pos", "models=W1,W2m"),
    *("ida={level_ratio: 0.05, power: 0}", "numerics={step_fraction: 0.4, after_motion_s: 1.0}"),
)


@pytest.mark.yade
@pytest.mark.slow
def test_a_run_of_the_defaults_ends_with_an_answer_that_yade_has_checked(tmp_path):
    """Of each model one history below the lowest collapse and one at it, on recorded motions."""
    done = snakemake(tmp_path, *SMALL)
    assert done.returncode == 0, done.stderr[-3000:]
    tables = tmp_path / "results/one/tables"
    answer, checked = (pd.read_csv(tables / f"{name}.csv") for name in ("answer", "answer_yade"))
    assert answer["model"].tolist() == ["W1", "W2m"]
    assert answer["pga_half_g"].between(0.2, 0.6).all()
    ran = answer[["yade_fell", "yade_stood", "yade_otherwise"]]
    assert ran.sum(axis=1).tolist() == [2, 2]
    assert checked.groupby("model")["foretold"].agg(list).tolist() == [[0, 1], [0, 1]]
    assert answer["pga_building_g"].notna().tolist() == [False, True]  # no building moves W1's
    assert (tmp_path / "results/one/figures/answer.png").stat().st_size > 10_000
    said = done.stderr.partition("one: half of the histories fell from this PGA on (1 motion")[2]
    first, second, building = said.splitlines()[1:4]
    assert first.startswith(f"  W1   {answer['pga_half_g'][0]:.2f} g")
    assert second.startswith(f"  W2m  {answer['pga_half_g'][1]:.2f} g")
    assert building.startswith("  the building itself is down from")
