"""What the report says of ties, of tables whose answer is plain to see."""

from types import SimpleNamespace

import pandas as pd
import pytest
from rocking.assessment import ties_said, verdict

GABLE = "part above 6.40 m (foot of the gable)"


def data(forces, left=(), by_hand=0.1, tried=True, relied=None, levels=None, sold=None):
    """A report's tables: rows at 3.2 and 6.4 m, mechanisms that remain, a façade that fails."""
    rows = pd.DataFrame({"height_m": [3.2, 6.4][: len(forces)], "force_kn": forces})
    rows = rows.assign(count=2, commercial_mm=10, yield_mpa=235.0, relied="W2m")
    rows["force_relied_kn"] = forces if relied is None else relied
    rows["sold_holds"] = float("nan") if sold is None else sold
    found = [(name, int(name in left)) for name in ("whole", *left)]
    mechanisms = {"mechanism": ["whole"], "kind": ["as stated"], "pga_fails_g": [by_hand]}
    tables = {
        "ties": rows,
        "ties_mechanisms": pd.DataFrame(found, columns=["mechanism", "beyond"]),
        "ties_tried": pd.DataFrame({"holds": [1]} if tried else {"holds": []}),
        "code_checks": pd.DataFrame({"pga_demand_g": [0.2]}),
        "mechanisms": pd.DataFrame(mechanisms),
        "verdicts": pd.DataFrame(
            {"model": ["W1", "W2m"], "slv": [True, by_hand > 0.2], "agree": [1.0, 1.0]}
        ),
    }
    config = {"assessment": {"tie_levels_m": levels}, "facade": {"ties": []}}
    return SimpleNamespace(tables=tables, config=config)


@pytest.mark.parametrize(
    ("given", "starts", "ends"),
    [
        (
            data([8.0]),
            "With a row of ties of 8.0 kN at 3.20 m (2 φ10, 235 MPa) the kinematic checks and the "
            "dynamic check with W1 and W2m pass.",
            " With 95 % of the force they do not.",
        ),
        (
            data([8.0, 9.0]),
            "With rows of ties of 8.0 kN at 3.20 m (2 φ10, 235 MPa) and 9.0 kN at 6.40 m",
            " With 95 % of any one row, the others as they are, they do not.",
        ),
        (
            data([8.0, 9.0], [GABLE]),
            "With rows of ties of ",
            f" pass for all but one mechanism that no row at these levels holds, the {GABLE}. With "
            "ties at these levels alone the façade does not pass. With 95 % of any one row, the "
            "others as they are, a further mechanism fails.",
        ),
        (data([8.0], tried=False), "With a row", "they do not."),
        (
            data([8.0, 9.0], relied=[8.0, 2.0]),
            "",
            " W2m by itself asks for 8.0 kN at 3.20 m and 2.0 kN at 6.40 m.",
        ),
        (
            data([8.0, 0.0], relied=[0.0, 2.0]),
            "With a row",
            " W2m by itself asks for 2.0 kN at 6.40 m.",
        ),
        (data([8.0], relied=[0.0]), "", " W2m by itself asks for none."),
        (data([8.0], sold=1), "With a row", " With the rods in brackets the same pass."),
        (data([8.0], sold=0), "With a row", " With the rods in brackets fewer pass."),
        (data([]), "No row at floors or eaves", "under Ties."),
        (data([8.0], by_hand=0.3), "None are needed", "demand."),
        (data([8.0], levels=[]), "Not looked for", "is empty."),
    ],
)
def test_the_answer_on_the_first_page(given, starts, ends):
    said = ties_said.answer(given)
    assert said.startswith(starts)
    assert said.endswith(ends)


def test_a_row_of_a_few_newtons_is_not_none():
    assert [ties_said.kn(force) for force in (412.616, 0.05, 0.0148)] == [
        "412.6 kN",
        "0.1 kN",
        "0.015 kN",
    ]


def test_what_is_just_short_of_the_whole_is_not_100_per_cent():
    said = [verdict.per_cent(x) for x in (0.994, 0.9962, 0.99999, 1.0, 1.002, -0.05)]
    assert said == ["99 %", "99.6 %", "99.9 %", "100 %", "100 %", "−5 %"]


def test_without_a_dynamic_check_the_answer_says_so():
    assert "pass; the dynamic check was not made. With 95 %" in ties_said.answer(
        data([8.0], tried=False)
    )


def test_a_row_is_asked_for_by_hand_or_by_a_mechanism_under_a_model():
    rows = pd.DataFrame({"governed_by": [None, GABLE], "model": [None, "W2"]})
    first, second = rows.itertuples()
    assert ties_said.asked_by(first) == "checks by hand"
    assert ties_said.asked_by(second) == f"{GABLE}, W2"


def test_rows_that_are_there_are_not_said_to_be_needless():
    given = data([8.0], by_hand=0.3)
    given.config["facade"]["ties"] = [{"height_m": 3.0}]
    said = "None besides those that are there are needed for this demand."
    assert ties_said.answer(given) == said
    given.tables["verdicts"] = pd.DataFrame()
    said = "None besides those that are there are needed by hand; the dynamic check was not made."
    assert ties_said.answer(given) == said
