"""What the report says of ties, of tables whose answer is plain to see."""

from types import SimpleNamespace

import pandas as pd
import pytest
from studies.assess import ties_said, ties_tables
from studies.assess.catalogue import SAY
from studies.assess.names import PLACES
from studies.assess.shaken import CORNER

GABLE = {"part": "above_6.4", "foot_m": 6.4, "at_foot": "gable"}
BENT = {"part": "from_0.0_to_3.2", "held_m": 3.2, "hinge_m": 2.0}
LEFT = {"part": "left_corner", "foot_m": 1.0, "side": -1}


def after(rows):
    """Rows (where it is, why_not, beyond, model, holds) of ties_mechanisms.csv."""
    nowhere = {key: float("nan") for key in (*PLACES, "middle_m", "top_m")}
    found = [
        {
            **dict.fromkeys(ties_tables.AFTER, ""),
            **nowhere,
            **{"foot_m": 0.0, "side": 0, "at_foot": "base"},
            **place,
            "pga_fails_g": 0.3,
            "ratio": 1.5,
            "why_not": why,
            "beyond": beyond,
            "model": model,
            "holds": holds,
            "exceed_d0": 0,
            "mean_d_m": 0.01,
            "d_slv_m": 0.1,
        }
        for place, why, beyond, model, holds in rows
    ]
    return pd.DataFrame(found, columns=ties_tables.AFTER)


def data(forces, mechanisms=(), alone=(), tried=True, levels=None, holds=1):
    """A report's tables: rows at 3.2 and 6.4 m of 1.25 times the least, two rods each."""
    rows = pd.DataFrame({"height_m": [3.2, 6.4][: len(forces)], "force_kn": forces})
    rows = rows.assign(count=2, diameter_mm=10.0, yield_mpa=235.0, relied="W2m", margin=1.25)
    rows["force_built_kn"] = 1.25 * rows["force_kn"]
    rows = rows.assign(anchor_load_kn=5.0, anchor_kn=20.7, anchor_by="punching", built_holds=holds)
    tables = {
        "ties": rows,
        "ties_mechanisms": after(mechanisms),
        "ties_models": pd.DataFrame(alone, columns=ties_tables.MODELS),
        "ties_tried": pd.DataFrame({"holds": [1]} if tried else {"holds": []}),
    }
    config, facade = {"assessment": {"tie_levels_m": levels}}, SimpleNamespace(ties=())
    return SimpleNamespace(tables=tables, config=config, facade=facade, relied="W2m", say=SAY)


WHOLE = ({"part": "whole"}, "", 0)


def test_one_recommendation_for_the_model_of_the_rate_and_what_was_shaken_of_it():
    given = data([8.0], [(*WHOLE, "W2m", 1), (*WHOLE, "W2", 0)], [("W2", 3.2, 38.4, 1)])
    said = ties_said.answer(given)
    assert said.startswith(
        "2 rods φ10 of 235 MPa at 3.20 m (10.0 kN): with this row all 1 mechanisms pass by hand, "
        "and all 1 that were shaken with W2m. In rods that are sold this is "
        "1.25 times the least or more. Each anchor holds its rod: at 3.20 m 5.0 kN of "
        "20.7 kN, where it punches through the wall."
    )
    assert "With the same rows with W2 1 of 1 do not." in said
    assert said.endswith("By itself, without margin, W2 asks for about 38 kN at 3.20 m.")


def test_what_no_row_holds_and_what_was_not_shaken_are_named():
    rows = [(*WHOLE, "W2m", 1), (GABLE, "", 1, "W2m", 0)]
    rows += [(LEFT, CORNER, 0, "", ""), (BENT, "far", 0, "", "")]
    said = ties_said.answer(data([8.0, 9.0], rows))
    assert "No row at these levels holds the part above 6.40 m." in said
    assert "1 of 2 that were shaken with W2m" in said
    assert "Judged by hand alone: the left corner above 1.00 m (not over the whole width)" in said
    assert "vertical bending from 0.00 to 3.20 m, open at 2.00 m (far from the demand)" in said


@pytest.mark.parametrize(
    ("given", "starts", "ends"),
    [
        (
            data([], [(GABLE, "", 1, "", "")]),
            "No row at these levels",
            "the part above 6.40 m.",
        ),
        (data([]), "None are needed", "demand with W2m."),
        (data([], tried=False), "None are needed by hand", "not made."),
        (data([8.0], levels=[]), "Not looked for", "is empty."),
        (data([], alone=[("W2", 6.4, 30.0, 1)]), "None", "W2 asks for about 30 kN at 6.40 m."),
        (data([], alone=[("W2", float("nan"), float("nan"), 0)]), "None", "these levels hold."),
        (data([], alone=[("W1", float("nan"), 0.0, 1)]), "None", "W1 for none."),
    ],
)
def test_the_answer_on_the_first_page(given, starts, ends):
    said = ties_said.answer(given)
    assert said.startswith(starts)
    assert said.endswith(ends)


def test_rods_that_do_not_give_the_margin_are_said():
    given = data([8.0], [(*WHOLE, "W2m", 1)], holds=0)
    said = ties_said.answer(given)
    assert "give the margin: these do not." in said
    assert "1.25 times" not in said


def test_a_row_of_a_few_newtons_is_not_none():
    assert [SAY.number(force, "kn") for force in (412.616, 0.05, 0.0148)] == [
        "412.6 kN",
        "0.1 kN",
        "0.015 kN",
    ]
    assert [SAY.number(force, "two") for force in (0.1604, 38.4, 412.6)] == [
        "0.16",
        "38",
        "410",
    ]


def test_what_is_just_short_of_the_whole_is_not_100_per_cent():
    said = [SAY.number(x, "percent") for x in (0.994, 0.9962, 0.99999, 1.0, 1.002, -0.05)]
    assert said == ["99 %", "99.6 %", "99.9 %", "100 %", "100 %", "−5 %"]


def test_without_a_dynamic_check_the_answer_says_so():
    assert " The dynamic check was not made." in ties_said.answer(data([8.0], tried=False))


def test_a_row_is_asked_for_by_hand_or_by_a_mechanism_under_a_model():
    rows = pd.DataFrame({"governed_part": [None, GABLE["part"]], "model": [None, "W2"]})
    known = after([(GABLE, "", 0, "W2", 1)])
    first, second = rows.itertuples()
    assert ties_said.asked_by(first, known, SAY) == "checks by hand"
    said = ties_said.asked_by(second, known, SAY)
    assert said == "part above 6.40 m (foot of the gable), W2"


def test_rows_that_are_there_are_not_said_to_be_needless():
    given = data([])
    given.facade.ties = (3.0,)
    said = "None besides those that are there are needed for this demand with W2m."
    assert ties_said.answer(given) == said
