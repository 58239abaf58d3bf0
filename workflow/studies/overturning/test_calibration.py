"""Calibration of predictions of falls: halves, bins, and pages without outcomes."""

import shutil
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pytest
from rocking.configuration.config import ConfigError

from studies.overturning import figure, study

ROOT = Path(__file__).resolve().parents[3]
FOLDER = ROOT / "config" / "predictions" / "overturning"


@pytest.fixture
def outcomes(tmp_path):
    """A table of tests whose outcomes are drawn with the fitted model's probabilities.

    Every other test counts as handed out.
    """
    rng = np.random.default_rng(70)
    predicted = study.predicted(FOLDER, "fitted").pivot(index="test", columns="specimen")
    known = sorted(study.handed_out())[0]
    p = predicted["probability_of_fall"]
    table = pd.DataFrame({"test": p.index, "pga_g": 0.1})
    table["motion"] = [known if k % 2 else "another" for k in range(len(p))]
    for specimen in p:
        table[f"overturned_specimen{specimen}"] = (
            rng.random(len(p)) < p[specimen].to_numpy()
        ).astype(int)
    table.to_csv(tmp_path / "tests.csv", index=False)
    return tmp_path / "tests.csv"


def test_outcomes_of_a_model_s_own_probabilities_lie_within(outcomes):
    """Nine in ten do by the interval's meaning, in either half; the blind model then fails."""
    found = study.calibration(FOLDER, outcomes)
    assert list(dict.fromkeys(found["half"])) == list(study.HALVES)
    assert found.groupby("model")["tests"].sum().to_dict() == {"geometry": 980, "fitted": 980}
    own = found[found["model"] == "fitted"]
    assert (own["within"] == "yes").sum() >= 8  # of 10; nine on average
    blind = found[found["model"] == "geometry"]
    assert blind["fell"].sum() > blind["most"].sum()


def test_without_outcomes_the_prediction_stands_alone():
    found = study.calibration(FOLDER)
    assert set(found["half"]) == {""}
    assert found["fell"].isna().all()
    assert (found["least"] <= found["foreseen"]).all()
    assert (found["foreseen"] <= found["most"]).all()


def test_a_changed_prediction_and_no_outcome_are_refused(tmp_path, outcomes):
    copy = tmp_path / "changed"
    shutil.copytree(FOLDER, copy)
    (copy / "fitted.csv").write_text((copy / "fitted.csv").read_text().replace("11,1,", "11,3,", 1))
    with pytest.raises(ConfigError, match=r"fitted.csv: not what digest.txt says"):
        study.calibration(copy, outcomes)
    table = pd.read_csv(outcomes)
    table[["overturned_specimen1", "overturned_specimen2"]] = np.nan
    table.to_csv(outcomes, index=False)
    with pytest.raises(ConfigError, match="expected outcomes of tests: none is known"):
        study.calibration(FOLDER, outcomes)


def test_dots_outside_are_hollow_and_halves_have_their_colours(outcomes):
    table = study.calibration(FOLDER, outcomes)
    drawn = figure.draw(table)
    dots = [
        (line.get_color(), line.get_markerfacecolor() == "none", line.get_xdata().size)
        for axis in drawn.axes
        for line in axis.lines
        if line.get_marker() == "o"
    ]
    full = table[table["tests"] > 0]
    assert sum(size for *_, size in dots) == len(full)
    assert sum(size for _, hollow, size in dots if hollow) == (full["within"] == "no").sum()
    assert {colour for colour, *_ in dots} == {figure.COLOURS[half] for half in study.HALVES}
    plt.close(drawn)
