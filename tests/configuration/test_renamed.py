"""Former names of keys and values mean the same for one version, and say so."""

from pathlib import Path

import pytest
from rocking.configuration import config, renamed
from rocking.configuration.config import ConfigError
from rocking.configuration.files import check_text

ROOT = Path(__file__).resolve().parents[2]

OLD = {"premises": {"mass_ratios": [0.1]}, "accuracy": {"judge_step": 0.004, "reference": "judge"}}
NEW = {
    "assumptions": {"mass_ratios": [0.1]},
    "accuracy": {"reference_scan_step": 0.004, "reference": "adaptive"},
}


def test_former_names_mean_the_same_and_are_told_once():
    assert config.resolve(OLD) == config.resolve(NEW)
    assert renamed.lines(NEW) == []
    told = renamed.lines({**OLD, "scenarios": {"a": OLD}})
    assert [line.split(" is now")[0] for line in told] == [
        "premises",
        "accuracy.judge_step",
        "accuracy.reference = judge",
    ]


def test_scenarios_and_grids_take_former_names_too():
    grid = {"premises.mass_ratios": [[0.1], [0.2]], "accuracy.judge_step": [0.004]}
    runs = config.expand_scenarios(
        {"grid": grid, "scenarios": {"a": {"premises.periods_s": [0.3]}}}
    )
    assert [one["assumptions"]["mass_ratios"] for one in runs.values()] == [[0.1], [0.2]]
    assert {one["accuracy"]["reference_scan_step"] for one in runs.values()} == {0.004}
    assert all(one["assumptions"]["periods_s"] == [0.3] for one in runs.values())
    assert len(renamed.lines({"grid": grid})) == 2


def test_both_names_at_once_are_refused():
    with pytest.raises(ConfigError, match="premises is now called assumptions: given under both"):
        config.resolve({"premises": {}, "assumptions": {}})


@pytest.mark.parametrize(
    "path",
    sorted({*ROOT.glob("workflow/schemas/*.yaml"), *ROOT.glob("config/**/*.yaml")}),
    ids=lambda path: path.name,
)
def test_no_key_of_ours_stands_twice(path):
    """YAML itself lets the last of two keys of one name win, and the first is gone unseen."""
    check_text(path.read_text("utf-8"), path.name)
