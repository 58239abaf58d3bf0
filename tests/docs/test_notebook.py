"""The notebook of the documentation runs from top to bottom, and its numbers are those it shows."""

import json
from pathlib import Path

import pytest

PAGE = Path(__file__).resolve().parents[2] / "docs" / "first_facade.ipynb"


@pytest.mark.slow
def test_the_notebook_runs_and_prints_what_it_shows(capsys):
    names: dict = {}
    cells = [c for c in json.loads(PAGE.read_text("utf-8"))["cells"] if c["cell_type"] == "code"]
    for cell in cells:
        exec(compile("".join(cell["source"]), PAGE.name, "exec"), names)
        shown = [o["text"] for o in cell["outputs"] if o["output_type"] == "stream"]
        assert capsys.readouterr().out == "".join("".join(text) for text in shown)
    assert names["more"]["pga_median_g"] > names["summary"]["pga_median_g"]  # stands more
