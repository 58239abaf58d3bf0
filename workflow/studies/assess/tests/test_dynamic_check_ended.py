"""A dynamic check that ends once it cannot be passed: what is repeated, steps, turns at once."""

from concurrent.futures import ThreadPoolExecutor

import pandas as pd
import pytest
from studies.assess import dynamic_check

LIMITS = dynamic_check.Limits(0.5, 0.2, 0.3)
ROUGH, FINE = dynamic_check.ROUGH, dynamic_check.FINE


def shaken_by_hand(monkeypatch, shares, fallen=()):
    """Peaks over d0 by motion, of repetitions with some that fall; returns what was asked for."""
    asked = []

    def rows(name, ends):
        about = {"record": name, "direction": "pos", "d_m": shares[name] * LIMITS.d0_m}
        return pd.DataFrame([{**about, "realisation": k, "status": s} for k, s in ends])

    def run(job, turns, fraction=None, realisations=0):
        asked.extend((name, realisations, fraction) for (name, _), _ in turns)
        ends = ["overturned" if k in fallen else "ok" for k in range(realisations)]
        given = list(enumerate(ends, 1)) or [(0, "ok")]
        return [rows(name, given) for (name, _), _ in turns]

    monkeypatch.setattr(dynamic_check, "histories", run)
    return asked


@pytest.mark.parametrize(("fallen", "holds"), [((), True), ((3,), False)])
def test_a_part_of_which_one_repetition_falls_does_not_hold(monkeypatch, fallen, holds):
    """One motion at 0.4 of d0, five repetitions: one that falls leaves 83 % of draws."""
    asked = shaken_by_hand(monkeypatch, {"calm": 0.1, "far": 0.4}, fallen)
    turns = [((name, 0.3), "pos") for name in ("calm", "far")]
    said, turn = dynamic_check.decided({}, turns, LIMITS, 5, 1)
    assert [name for name, count, _ in asked if count] == ["far"]
    assert said["holds"] is holds
    assert said["exceed_d0"] == 0
    assert said["agree"] == pytest.approx(1.0 if holds else 5 / 6, abs=0.03)
    assert turn == (None if holds else turns[1])
    for care, count in ((FINE, 0), (ROUGH, 5)):  # a rough one repeats from half of d0 on
        assert dynamic_check.decided({}, turns, LIMITS, count, 1, care)[0]["holds"]


def test_short_steps_are_taken_where_long_ones_move_a_part_far(monkeypatch):
    asked = shaken_by_hand(monkeypatch, {"calm": 0.15, "near": 0.25, "far": 0.6})
    turns = [((name, 0.3), "pos") for name in ("calm", "near", "far")]
    dynamic_check.decided({}, turns, LIMITS, 5, 1, ROUGH)
    long = dynamic_check.LONG_STEP
    assert asked == [(n, 0, long) for n in ("calm", "near", "far")] + [("far", 5, long)]
    asked.clear()
    dynamic_check.decided({}, turns, LIMITS, 5, 1, FINE)
    assert [name for name, _, step in asked if step is None] == ["near", "far", "far"]
    assert [name for name, count, _ in asked if count] == ["far"]
    asked.clear()
    courses = {"facade": {"courses": 4}}
    dynamic_check.decided(courses, turns, LIMITS, 5, 1, FINE)
    assert asked == [(n, 0, None) for n in ("calm", "near", "far")] + [("far", 5, None)]
    asked.clear()
    dynamic_check.decided(courses, turns, LIMITS, 5, 1, ROUGH)
    assert {step for *_, step in asked} == {long}


@pytest.mark.parametrize("falls", [None, 0, 2, 9])
def test_turns_side_by_side_decide_as_one_after_another(monkeypatch, falls):
    """What was run beyond the turn that ends the check counts for nothing, and is a vector."""
    limits, asked = dynamic_check.Limits(0.5, 0.3, 0.3), []

    def history(job, turns, fraction=None, realisations=0):
        asked.extend(name for (name, _), _ in turns)
        ends = ["overturned" if name == falls else "ok" for (name, _), _ in turns]
        return [
            pd.DataFrame([{"record": n, "direction": way, "d_m": 0.02 * n, "status": end}]).assign(
                realisation=0
            )
            for ((n, _), way), end in zip(turns, ends, strict=True)
        ]

    monkeypatch.setattr(dynamic_check, "histories", history)
    turns = [((name, 0.3), "pos") for name in range(20)]
    alone = dynamic_check.decided({}, turns, limits, 0, 1, ROUGH)
    with ThreadPoolExecutor(2) as pool:
        beside = dynamic_check.decided({}, turns, limits, 0, 1, ROUGH, pool.map, 2)
    assert beside == alone
    assert alone[1] == (None if falls is None else turns[falls])
    first, then, last = dynamic_check.VECTOR, dynamic_check.THEN, 19 if falls is None else falls
    counts = [
        min(20, n * (first + then * max(0, -(-(last + 1 - n * first) // (n * then)))))
        for n in (1, 2)
    ]
    assert sorted(asked) == sorted(n for count in counts for n in range(count))
