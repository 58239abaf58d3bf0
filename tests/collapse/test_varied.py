"""Cases, variants and directions in one table: what is varied, and what the rows are called."""

import numpy as np
import pytest
from rocking import Motion, Variant
from rocking.collapse.varied import collapses
from rocking.records import Record
from study_cases import study_case

UP = np.array([0.0, 1.0, 0.0])
MOTION = Motion(Record("R1", np.array([0.0, 2.0, -1.0]), 0.01, source="file", vertical_m_s2=UP))
VARIANTS = [
    Variant(about={"share": 1.0}),
    Variant(
        changes={"model": "W2", "facade.height_m": 5.0},
        motion={"vertical": 0.5},
        about={"share": 0.5},
    ),
]


def test_each_variant_changes_its_own_case_and_motion():
    """Rows by case, variant and direction; the model is that of the case before it is varied."""

    def find(case, motion, direction):
        up = motion.record.vertical_m_s2.max()
        return {"height_m": case["facade"]["height_m"], "run": case.model, "up": up}

    cases = [study_case(name) for name in ("W1", "W3")]
    rows = collapses(cases, MOTION, ["pos", "neg"], find, VARIANTS)
    assert [(r["model"], r["share"], r["direction"]) for r in rows] == [
        (model, share, direction)
        for model in ("W1", "W3")
        for share in (1.0, 0.5)
        for direction in ("pos", "neg")
    ]
    assert {r["record"] for r in rows} == {"R1"}
    assert [(r["run"], r["height_m"], r["up"]) for r in rows[:4:2]] == [
        ("W1", pytest.approx(6.48), 1.0),
        ("W2", 5.0, 0.5),
    ]
