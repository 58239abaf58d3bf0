"""Predictions: what was stated and predicted is held by digests, and scored against outcomes."""

import math
import shutil
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from rocking.configuration.config import ConfigError

from studies.validation import predicted_motions, predictions

ROOT = Path(__file__).resolve().parents[3]
FOLDERS = [ROOT / "config" / "predictions" / name for name in ("sin01", "gables")]
MADE = [folder for folder in FOLDERS if (folder / predictions.DIGEST).is_file()]


@pytest.mark.parametrize("folder", MADE, ids=lambda path: path.name)
def test_what_is_committed_is_what_its_digests_say(folder):
    specimen, _ = predictions.read(folder)
    assert predictions.unchanged(folder) == {"stated": True, "predicted": True}
    table = pd.read_csv(folder / predictions.TABLE)
    assert set(table["variant"]) == set(specimen["variants"])
    assert (table["fell"] <= table["members"]).all()
    assert table["probability"].to_numpy() == pytest.approx(
        table["fell"] / table["members"], abs=1e-4
    )


@pytest.fixture
def small(tmp_path):
    """A prediction of three runs by two readings, made by hand."""
    for name in predictions.STATED:
        shutil.copy(FOLDERS[0] / name, tmp_path)
    rows = [("a", 1, 10, 0), ("a", 2, 10, 5), ("a", 3, 10, 10), ("b", 1, 10, 10), ("b", 2, 10, 10)]
    table = pd.DataFrame(rows, columns=["variant", "run", "members", "fell"])
    table["probability"] = table["fell"] / table["members"]
    table.to_csv(tmp_path / predictions.TABLE, index=False)
    lines = [
        f"stated {predictions.digest(*(tmp_path / n for n in predictions.STATED))}",
        f"predicted {predictions.digest(tmp_path / predictions.TABLE)}",
    ]
    (tmp_path / predictions.DIGEST).write_text("\n".join(lines) + "\n")
    return tmp_path


def outcomes(folder, *rows):
    text = "run,outcome,peak_mm\n" + "".join(f"{n},{what},\n" for n, what in rows)
    (folder / predictions.OUTCOMES).write_text(text)


def test_scores(small):
    """By hand: Brier (0² + 0.5² + 0²)/3 and 1 for what was sure and wrong; likelihoods smoothed."""
    outcomes(small, (1, "stood"), (2, "fell"), (3, "fell"))
    a, b = predictions.score(small).to_dict("records")
    assert (a["runs"], a["fell"], a["foreseen"]) == (3, 2, 1.5)
    assert a["brier"] == pytest.approx(0.25 / 3.0)
    assert a["likelihood"] == pytest.approx((11 / 12 * 6 / 12 * 11 / 12) ** (1 / 3))
    assert b["brier"] == pytest.approx(0.5)
    assert b["likelihood"] == pytest.approx(math.sqrt(1 / 12 * 11 / 12))


@pytest.mark.parametrize("name", ["runs.csv", "predicted.csv"])
def test_a_prediction_that_was_changed_is_not_scored(small, name):
    outcomes(small, (1, "stood"))
    with open(small / name, "a") as file:
        file.write("\n")
    with pytest.raises(ConfigError, match="is not what digest.txt says"):
        predictions.score(small)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("run,outcome,peak_mm\n1,leant,\n", "outcome = leant: expected stood or fell"),
        ("run,outcome,peak_mm\n", "expected rows of run,outcome,peak_mm"),
        ("", "expected rows of run,outcome,peak_mm"),
        ("run;outcome\n1;stood\n", "with commas between"),
        ("run,outcome\n1,stood\n2,fell,3,4\n", "Expected 2 fields in line 3"),
        ("run,outcome\n99,stood\n", "run = 99: expected a run of predicted.csv"),
        ("run,outcome\n1,stood\n1,fell\n", "run = 1: expected each run once"),
    ],
)
def test_outcomes_that_are_none(small, text, said):
    (small / predictions.OUTCOMES).write_text(text)
    with pytest.raises(ConfigError, match=said) as caught:
        predictions.score(small)
    assert str(small / predictions.OUTCOMES) in str(caught.value)


def test_a_prediction_that_is_not_there_is_one_line(small, capsys):
    (small / predictions.DIGEST).unlink()
    for folder, said in (
        (small / "nope", "no folder of a prediction"),
        (small, "expected this file of the prediction"),
    ):
        assert predictions.main(["score", str(folder)]) == 1
        error = capsys.readouterr().err
        assert error.startswith(f"predictions: {folder}")
        assert said in error
        assert error.count("\n") == 1


def test_a_motion_amplified_and_shifted():
    """A sine of 2 Hz by 90° is its cosine, and both supports end where they began."""
    t = np.arange(0.0, 20.0, 0.005)
    foot = np.sin(4.0 * np.pi * t) * np.sin(np.pi * t / 20.0) ** 2
    time_s, same, top = predicted_motions.shifted(t, foot, 2.0, 90.0)
    middle = np.abs(time_s - time_s[-1] / 2.0) < 2.0
    turned = -2.0 * np.cos(4.0 * np.pi * (time_s - predicted_motions.PAUSE_S))
    envelope = np.sin(np.pi * (time_s - predicted_motions.PAUSE_S) / 20.0) ** 2
    assert top[middle] == pytest.approx((turned * envelope)[middle], abs=0.02)
    assert np.interp(t + predicted_motions.PAUSE_S, time_s, same) == pytest.approx(foot, abs=5e-3)
    for a in (same, top):
        place = np.cumsum(np.cumsum(a)) * 0.005**2
        assert abs(place[-1]) < 0.02 * np.abs(place).max()


def test_runs_take_their_file_or_their_motions_strongest_one(tmp_path):
    specimen, runs = predictions.read(FOLDERS[0])
    t = np.arange(0.0, 2.0, 1.0 / 256.0)
    lines = [f"{a:.4f},{b:.8f}" for a, b in zip(t, 0.1 + 0.2 * np.sin(3.0 * t), strict=True)]
    text = "Velocity\n512,0\n" + "\n".join(lines) + "\n"
    (tmp_path / "Gr_1_350_BottomShakeTable.txt").write_text(text)
    found = {
        row["record"]: predicted_motions.table_motion(specimen, row, tmp_path)
        for _, row in runs.iterrows()
    }
    time_s, ground, source = found["Gr_1_350"]
    assert source == "file"
    assert ground == pytest.approx(0.6 * np.cos(3.0 * t), abs=0.02)
    assert found["Gr_1_40"][2] == "scaled"
    assert found["Gr_1_40"][1] == pytest.approx(ground * 40.0 / 350.0, rel=1e-3)
    assert found["RWA_4"] is None
    name = predicted_motions.table_motion(specimen, runs.iloc[-1], None)[2]
    assert name == specimen["motions"]["stand_in"]["RWA"][0]


@pytest.mark.slow
def test_readings_side_by_side_are_those_one_after_another():
    specimen, runs = predictions.read(FOLDERS[0])
    readings = list(specimen["variants"].items())
    small = {**specimen, "members": 1, "variants": dict(readings[:5:4])}
    alone, beside = (
        predictions.shake_table(small, runs.iloc[:1], None, False, cores) for cores in (1, 2)
    )
    pd.testing.assert_frame_equal(alone, beside, check_exact=True)
    assert list(beside["variant"].unique()) == list(small["variants"])
    assert len(beside) == 2 * 2


@pytest.fixture
def gable(tmp_path):
    """The gable of one reading and one rung, with a run of its own that is to be read."""
    text = (FOLDERS[1] / "specimen.yaml").read_text("utf-8")
    text = text.replace("[1.0, 2.0, 3.0]", "[1.0]").replace("[0, 90, 180]", "[0]")
    text = text.replace("[GMN_NS, GMN_WE, IS113_Tr]", "[IS113_Tr]")
    text = text.replace("[0.1, 0.2, 0.3, 0.45, 0.65, 1.0]", "[0.1]")
    (tmp_path / "specimen.yaml").write_text(text, "utf-8")
    (tmp_path / "runs.csv").write_text("run,foot,top\n1,foot.csv,top.csv\n")
    return tmp_path


def supports(folder, peak_m_s2):
    """Files of a foot and a top that move alike, two seconds at 2 Hz."""
    t = np.arange(0.0, 2.0, 0.01)
    wave = np.sin(4.0 * np.pi * t) * np.sin(np.pi * t / 2.0) ** 2
    wave *= peak_m_s2 / np.abs(wave).max()
    text = "".join(f"{a:.2f},{b:.5f}\n" for a, b in zip(t, wave, strict=True))
    for name in ("foot.csv", "top.csv"):
        (folder / name).write_text(text)


@pytest.mark.slow
def test_a_gables_own_runs_are_predicted_and_scored(gable):
    """A motion that hardly moves it, and one of 30 m/s² at foot and top alike."""
    found = []
    for peak_m_s2, outcome in ((0.1, "stood"), (30.0, "fell")):
        supports(gable, peak_m_s2)
        table = predictions.run(gable, motions=gable)
        own = table[table["run"] == 1]
        assert own["pga_g"].to_numpy() == pytest.approx(peak_m_s2 / 9.80665, rel=1e-4)
        outcomes(gable, (1, outcome))
        held, _ = predictions.score(gable).to_dict("records")
        assert held["runs"] == 1
        assert held["brier"] == 0.0
        found.append(own["fell"].iloc[0])
    assert found == [0, 1]


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("top.csv", "time,a\n0,1\n1,2\n", "growing time [s],value with a comma and no heading"),
        ("foot.csv", "0,1\n0,2\n", "growing time [s],value"),
        ("foot.csv", "0 1\n1 2\n", "growing time [s],value"),
        ("top.csv", "0,1\n0.5,2\n", "expected the times of"),
        ("runs.csv", "run\n1\n", "expected columns foot, top"),
    ],
)
def test_motions_of_a_gable_that_are_none(gable, name, text, said):
    supports(gable, 1.0)
    (gable / name).write_text(text)
    with pytest.raises(ConfigError) as caught:
        predictions.run(gable, motions=gable)
    assert said in str(caught.value)
    assert str(gable / name) in str(caught.value)


def test_a_gables_prediction_asks_for_its_folder_of_motions(gable, capsys):
    (gable / predictions.OUTCOMES).write_text("run,outcome,peak_mm\n1,fell,\n")
    for words, said in (
        (("run",), "--motions: expected the folder"),
        (("run", "--motions", str(gable)), "foot.csv: expected this file"),
        (("run", "--yade"), "--yade: "),
    ):
        assert predictions.main([words[0], str(gable), *words[1:]]) == 1
        error = capsys.readouterr().err
        assert said in error
        assert error.count("\n") == 1


def test_a_prediction_of_no_run_is_not_scored(tmp_path):
    for path in FOLDERS[1].iterdir():
        shutil.copy(path, tmp_path)
    outcomes(tmp_path, (1, "fell"))
    with pytest.raises(ConfigError, match="fill in runs.csv"):
        predictions.score(tmp_path)
