"""The code on docs/python.md runs from top to bottom, and prints what the page says."""

import re
from pathlib import Path

import pytest
from matplotlib import pyplot

PAGE = Path(__file__).resolve().parents[2] / "docs" / "python.md"


@pytest.mark.slow
def test_the_page_s_code_runs_and_prints_what_it_says(capsys):
    page, names = PAGE.read_text("utf-8"), {}
    for block in re.findall(r"```python\n(.*?)```", page, re.DOTALL):
        exec(compile(block, PAGE.name, "exec"), names)
    half_g, histories = capsys.readouterr().out.splitlines()[0].split()
    assert f"print {float(half_g):.3f}, the PGA in g" in page
    assert f"and {histories}, the number of histories" in page
    half = names["half"]
    assert half["GMN_NS"][0.45] == pytest.approx(float(half_g), rel=0.03)  # the page's first curve
    assert (half["IS113_Lo"] > 2.0 * half["GMN_NS"]).all()
    steps = half["IS113_Lo"].diff().iloc[1:]  # near 0.95 g single ones hang on the last digits
    assert steps.sum() == pytest.approx(0.13, abs=0.01)
    assert steps.min() > 0.0
    assert half["GMN_NS"].diff().iloc[1:].tolist() == pytest.approx([0.04, 0.04], abs=0.005)
    assert len(pyplot.gcf().axes) == 1
    pyplot.close("all")
