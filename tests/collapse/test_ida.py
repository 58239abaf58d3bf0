"""Tables of curves by what they are of, and how far up a curve is worth drawing."""

import math

import pandas as pd
from rocking.collapse.ida import by_curve, highest


def test_tables_stand_by_model_record_and_direction_and_empty_ones_are_left_out(tmp_path):
    head = "model,record,direction,pga_g"
    for name, row in (("a", "W1,R,pos,0.2"), ("b", "W2,R,neg,0.3"), ("empty", "")):
        (tmp_path / name).write_text(f"{head}\n{row}\n")
    found = by_curve([tmp_path / name for name in ("a", "b", "empty")])
    assert {key: table["pga_g"].tolist() for key, table in found.items()} == {
        ("W1", "R", "pos"): [0.2],
        ("W2", "R", "neg"): [0.3],
    }


def test_a_curve_is_drawn_to_where_all_collapse_or_as_far_as_it_was_run():
    row = pd.Series({"pga_all_g": math.nan, "pga_collapse_g": math.nan, "pga_max_g": 2.0})
    assert highest(row) == 2.0
    assert highest({**row, "pga_collapse_g": 0.5}) == 0.5
    assert highest({**row, "pga_collapse_g": 0.5, "pga_all_g": 0.7}) == 0.7
    assert math.isnan(highest({**row, "pga_max_g": math.nan}))
