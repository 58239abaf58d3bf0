"""Masonry buildings that were shaken, by run and damage grade: what waits for them."""

import shutil
from pathlib import Path

import pytest
from rocking.configuration.config import ConfigError

from studies.validation import shaken_buildings

FOLDER = Path(__file__).resolve().parents[3] / "config" / "predictions" / "shaken_buildings"


def test_a_folder_that_waits_says_so(capsys):
    assert shaken_buildings.main([str(FOLDER)]) == 1
    assert "nobody has filled it in yet" in capsys.readouterr().err


def test_buildings_are_predicted_by_the_formula(tmp_path):
    shutil.copytree(FOLDER, tmp_path / "mine")
    path = tmp_path / "mine" / "facades.csv"
    rows = "b,1,W2m,6.5,0.4,0.27,64000,0.1,0\nb,2,W2m,6.5,0.4,0.27,64000,2.0,5\n"
    path.write_text(path.read_text() + rows)
    found = shaken_buildings.predict(shaken_buildings.read(tmp_path / "mine"))
    assert found["probability_of_fall"].iloc[0] < 0.05
    assert found["probability_of_fall"].iloc[1] > 0.95
    assert shaken_buildings.score(found)["correct"] == 1.0
    path.write_text(path.read_text() + "b,3,W2m,6.5,0.4,0.27,64000,0.1,7\n")
    with pytest.raises(ConfigError, match="row 3: grade = 7"):
        shaken_buildings.read(tmp_path / "mine")
