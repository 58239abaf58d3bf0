"""A plan given to the command by hand that it cannot use ends in one line that names it."""

import json

import pytest
from studies.accuracy.yade import accuracy


@pytest.mark.parametrize("content", [None, [], {"a": 1}])
def test_a_plan_that_is_none_is_named(tmp_path, content):
    wrong = tmp_path / "wrong.json"
    wrong.write_text(json.dumps(content))
    with pytest.raises(ValueError, match=".") as caught:
        accuracy.main(["--plan", str(wrong), "--output", str(tmp_path / "out.csv")])
    said = str(caught.value)
    assert said.startswith(f"{wrong}: ")
    assert "\n" not in said
