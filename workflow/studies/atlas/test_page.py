"""The page on which a reader moves a façade's numbers says what Python says."""

import json
import math
import shutil
import subprocess

import numpy as np
import pytest
from formula_cases import drawn
from rocking.formula import law, yielding
from scipy.special import ndtr

from studies.atlas import page


@pytest.fixture(scope="module")
def known():
    return law.read()


def test_page_carries_the_formula_and_loads_nothing(known):
    text = page.page(known)
    assert not any(word in text for word in ("src=", "href=", "fetch(", "import("))
    assert "http" not in text.replace("http://www.w3.org/2000/svg", "")
    inside = text.split("const LAW = ", 1)[1].split(";\n", 1)[0]
    assert json.loads(inside)["limits"] == known["limits"]
    assert set(json.loads(inside)["walls"]) == {known["made_of"]["base"], *known["bases"]}
    assert 'name="viewport" content="width=device-width' in text


@pytest.mark.skipif(not shutil.which("node"), reason="no Node.js; the browser was tried by hand")
def test_page_and_python_agree_at_a_thousand_inputs(known, tmp_path):
    """The page's own script, run without a page: median, probability at a PGA, error."""
    rng, rows = np.random.default_rng(11), drawn(1000)
    lowest = yielding.read()["lowest"]
    for row in rows[::2]:
        row["base_shear_ratio"] = float(rng.uniform(lowest, 0.6))
    models, measures = list(known["models"]), list(law.MEASURES)
    bases = [known["made_of"]["base"], *known["bases"]]
    asked = [
        {
            "x": row,
            "model": models[rng.integers(len(models))],
            "measure": measures[rng.integers(len(measures))],
            "base": bases[rng.integers(len(bases))],
            "factor": float(rng.uniform(0.3, 3.0)),
        }
        for row in rows
    ]
    script = page.page(known).split("<script>", 1)[1].split("</script>", 1)[0]
    script += (
        "\nconst asked = JSON.parse(require('fs').readFileSync(0, 'utf8'));\n"
        "console.log(JSON.stringify(asked.map((a) => { const f = estimate(a.x, a.model, a.measure, "
        "a.base); return [f.median, probability(f, a.factor * f.median), f.error, "
        "outside(a.x, a.model) === null]; })));\n"
    )
    (tmp_path / "page.js").write_text(script, "utf-8")
    run = subprocess.run(
        ["node", str(tmp_path / "page.js")],
        input=json.dumps(asked),
        capture_output=True,
        text=True,
        timeout=60,
        check=True,
    )
    for one, (median, share, error, inside) in zip(asked, json.loads(run.stdout), strict=True):
        own, spread, own_error = law.said(one["x"], one["model"], one["measure"], one["base"])
        assert inside
        assert median == pytest.approx(own, rel=1e-9)
        assert share == pytest.approx(ndtr(math.log(one["factor"]) / spread), rel=1e-6, abs=1e-12)
        assert error == pytest.approx(own_error, rel=1e-9)
