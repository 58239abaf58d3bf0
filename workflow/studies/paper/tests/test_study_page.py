"""docs/study.yaml, the page made from it, and the study's values in the code: one and the same."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import yaml
from rocking.mechanics import closed_forms
from studies.paper import page as paper
from studies.shared.statements import COLUMNS, statement

DOCS = Path(__file__).parents[4] / "docs"
DATA = yaml.safe_load((DOCS / "study.yaml").read_text(encoding="utf-8"))
ROWS = [entry for section in DATA["sections"] for entry in section["rows"]]
FIGURES = ("1", "2abcd", "3abc", "4ab", "5abcd", "6abcdef", "7", "8abc", "9")


def test_every_figure_table_and_equation_has_a_row():
    names = {entry["id"].split(",")[0] for entry in ROWS}
    wanted = {f"figure {f[0]}{panel}" for f in FIGURES for panel in (f[1:] or [""])}
    wanted |= {f"table {n}" for n in (1, 2)} | {f"equation {n}" for n in range(1, 6)}
    assert wanted <= names
    sections = {entry["id"].split()[1].split(".")[0] for entry in ROWS if "sentence" in entry["id"]}
    assert sections == set("12345")
    ids = [entry["id"] for entry in ROWS]
    assert len(set(ids)) == len(ids)
    assert all(entry["says"] and entry["paper"] for entry in ROWS)


def test_values_of_the_study_hang_together():
    """Slips of the pen would break these: errors fall with n, eq. 5 gives the printed β, T(h)."""
    table_2 = [values for of_records in DATA["table_2"].values() for values in of_records.values()]
    small = max(abs(values[4] - values[3]) for values in table_2)  # what it calls minimal
    for values in table_2:
        assert values[0] == max(values)
        assert np.diff(values).max() <= small + 1e-9
    # acceleration is the hardest to match, the response spectrum the easiest
    by = {quantity: np.array(list(v.values())) for quantity, v in DATA["table_2"].items()}
    assert (by["acceleration"] > by["power_spectrum"]).all()
    assert (by["power_spectrum"] > by["response_spectrum"]).all()
    for wall, b, h, e in (("Sorrentino", 0.11, 0.8, 1800), ("Shawa", 0.25, 3.0, 4050)):
        assert closed_forms.beta_one_sided(b, h, e) == pytest.approx(DATA["beta_s"][wall], rel=0.01)
    periods = DATA["periods_s"]
    assert periods["CBDEM"]["y"] == pytest.approx(0.0625 * 6.48**0.75, abs=0.005)
    for direction, most in (("y", 0.02), ("rz", 0.02)):
        change = periods["SBDEM"][direction] - periods["CBDEM"][direction]
        assert 0.01 - 1e-9 <= change <= most + 1e-9


def test_the_committed_page_has_the_rows_of_the_data_file():
    """Made again by `make study`; a row changed in one place alone is seen here."""
    text = (DOCS / "study.md").read_text(encoding="utf-8")
    assert text.startswith(f"# The 3DEC study, row by row\n\n{DATA['study']}\n")
    assert DATA["suite"] in text
    lines = text.splitlines()
    rows = [
        line
        for line in lines
        if line.startswith(("| figure", "| sentence", "| equation", "| table"))
    ]
    assert len(rows) == len(ROWS)
    for line, entry in zip(rows, ROWS, strict=True):
        cells = [c.strip().replace(r"\|", "|") for c in line.strip("|").split(" | ")]
        assert cells[:3] == [entry["id"], entry["says"], entry["paper"]]
        assert cells[5] == entry.get("why", "")
        assert cells[4] in {*paper.MET, paper.NOT_RUN}
    # what differs says why
    assert all(
        row.split(" | ")[5].strip(" |") for row in rows if row.split(" | ")[4] in ("no", "open")
    )


def test_a_row_takes_numbers_and_verdicts_from_the_tables():
    modes = pd.DataFrame(
        {"model": ["A", "A", "B"], "period_s": [0.1, 0.2234, 0.3], "mass": [0.2, 0.7, 0.9]}
    )
    claims = pd.DataFrame(
        [
            statement("it holds well", "p", "0.5", True, "ours", "surrogate: X"),
            statement("it holds well", "p", "0.9", False, "the study's", "file: Y"),
        ],
        columns=COLUMNS,
    )
    entry = {
        "id": "figure 0",
        "says": "a period",
        "paper": "0.2 s",
        "here": "{t:} s",
        "values": {
            "t": {
                "table": "modes",
                "where": {"model": "A"},
                "largest": "mass",
                "column": "period_s",
                "digits": 3,
            }
        },
        "claim": "it holds",
    }
    assert paper.row(entry, {"modes": modes, "claims": claims}) == (
        "| figure 0 | a period | 0.2 s | 0.223 s; surrogates: 0.5†; recorded: 0.9 | partly |  |"
    )
    assert paper.row(entry, {}).count(paper.NOT_RUN) == 3
    elsewhere = modes.rename(columns={"model": "record"})
    spec = {"table": "modes", "where": {"record": "C"}, "column": "period_s", "digits": 1}
    assert paper.value(elsewhere, spec) == paper.NOT_RUN  # of a record that the run has not
    with pytest.raises(ValueError, match="2 rows"):
        paper.value(
            modes, {"table": "modes", "where": {"model": "A"}, "column": "mass", "digits": 1}
        )
    with pytest.raises(ValueError, match="met is 'None'"):
        paper.row({"id": "x", "says": "y", "paper": "z"}, {})


def test_figure_9_in_numbers_takes_the_median_and_else_the_bracket():
    table = pd.DataFrame(
        {
            "model": ["W1", "W2"],
            "record": ["X", "X"],
            "direction": ["neg", "neg"],
            "pga_safe_g": [0.2, 0.1],
            "pga_collapse_g": [0.3, 0.2],
            "pga_median_g": [0.22, np.nan],
        }
    )
    row = "| X− | not part of this run |"
    assert paper.collapse(DATA, {"ida_collapse": table})[-1] == f"{row} 0.220 | 0.150 |"
    both = paper.collapse(DATA, {"ida_collapse": table.assign(pga_equivalent_g=[0.25, np.nan])})
    assert both[-1] == f"{row} 0.250 (0.220) | 0.150 (0.150) |"
