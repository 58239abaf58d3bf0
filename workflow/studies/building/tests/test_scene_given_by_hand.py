"""A scene given to the command by hand that it cannot use ends in one line that names it."""

import json

import numpy as np
import pytest
from studies.building.yade import explicit_building

from yade_scripts.model import floor_motions


@pytest.mark.parametrize("content", [None, [], {"a": 1}])
def test_a_scene_that_is_none_is_named(tmp_path, content):
    wrong, motion = tmp_path / "wrong.json", str(tmp_path / "m.csv")
    wrong.write_text(json.dumps(content))
    floor_motions.write(motion, np.array([0.0, 0.01]), np.array([0.0, 1.0]))
    words = ["--scene", str(wrong), "--motion", motion, "--output", str(tmp_path / "out.csv")]
    with pytest.raises(ValueError, match=".") as caught:
        explicit_building.main(words)
    said = str(caught.value)
    assert said.startswith(f"{wrong}: ")
    assert "\n" not in said
