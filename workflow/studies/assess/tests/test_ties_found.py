"""Rows of ties that make a façade pass: by closed form, by the checks themselves, under motions."""

import json
import math
from concurrent.futures import ThreadPoolExecutor

import pandas as pd
import pytest
from rocking import Motion
from studies.assess import (
    anchors,
    inputs,
    ties,
    ties_built,
    ties_grown,
    ties_shaken,
    ties_tables,
)
from studies.assess.code_spectrum import CodeDemand
from studies.assess.dynamic_check import FINE
from studies.assess.slv import Slv
from study_cases import study_case, study_settings

DEMAND = CodeDemand(0.26, 2.4, 0.32, "B")
PLAIN = {"height_m": 6.0, "thickness_m": 0.4, "width_m": 5.0, "density_kg_m3": 1800.0}
STOREYS = {
    **PLAIN,
    "height_m": 8.0,
    "gable_height_m": 1.6,
    "openings": [{"x_m": 0.0, "z_m": 3.4, "width_m": 1.2, "height_m": 1.6}],
    "floors": [{"height_m": 2.8, "load_kn": 15.0}, {"height_m": 5.5, "load_kn": 15.0}],
}


def sections(facade, **own):
    chain = {"n_dof": 3, "period_s": 0.3}
    return study_settings({"facade": facade, "smdof": chain, "assessment": own})


def times(rows, factor):
    return [row._replace(force_n=factor * row.force_n) for row in rows]


def test_rows_may_stand_at_floors_and_eaves_or_where_it_is_said():
    assert ties.levels_of(sections(STOREYS)) == [2.8, 5.5, 8.0]
    near = [{"height_m": z, "load_kn": 5.0} for z in (7.9, 0.2, 4.0)]
    assert ties.levels_of(sections({**PLAIN, "height_m": 8.0, "floors": near})) == [4.0, 8.0]
    assert ties.levels_of(sections(STOREYS, tie_levels_m=[4.0])) == [4.0]
    assert ties.levels_of(sections(STOREYS, tie_levels_m=[])) == []


def test_other_levels_are_taken_where_they_need_less_in_sum(monkeypatch):
    """Of all levels, each alone and all but one: the least sum that leaves nothing more beyond."""
    tied, need = (
        ties.Tied(sections(STOREYS), DEMAND),
        {
            (2.8, 5.5, 8.0): ([20e3, 0.0, 30e3], ["gable"]),
            (2.8,): ([10e3], ["gable", "above"]),  # less, and leaves another
            (5.5,): ([45e3], ["gable"]),
            (8.0,): ([60e3], ["gable"]),
        },
    )

    def least(levels):
        forces, beyond = need.get(tuple(levels), ([], []))
        rows = map(ties.TieRow, levels, forces)
        return [row for row in rows if row.force_n], beyond

    monkeypatch.setattr(tied, "_least", least)
    monkeypatch.setattr(tied, "looked_again", lambda rows: False)
    assert tied.least([2.8, 5.5, 8.0]) == ([ties.TieRow(5.5, 45e3)], ["gable"])
    need[5.5,] = ([55e3], ["gable"])
    rows, _ = tied.least([2.8, 5.5, 8.0])
    assert [row.height_m for row in rows] == [2.8, 8.0]


def test_a_row_above_the_return_walls_is_refused_in_one_line():
    resolved = sections(STOREYS, tie_levels_m=[4.0, 9.0])
    with pytest.raises(ValueError, match=r"tie_levels_m: 9 m; expected heights up to .* 8 m"):
        inputs.check_mechanisms(resolved)


def test_the_least_row_on_a_plain_wall_brings_the_weakest_just_to_the_demand():
    """A row of force F at the top raises α0 by F h/(W h/2), and nothing is left over."""
    tied = ties.Tied(sections(PLAIN, tie_levels_m=[6.0]), DEMAND)
    rows, beyond = tied.least([6.0])
    (row,) = rows
    whole, added = (tied.family(own).part(0.0, "whole").mechanism for own in ([], rows))
    weight = 1800.0 * 9.81 * 6.0 * 0.4 * 5.0
    gain = added.multiplier() - whole.multiplier()
    assert gain == pytest.approx(2.0 * row.force_n / weight, rel=1e-6)
    known = {one.part: one for one in tied.family(rows).all()}
    held = [Slv(tied.sections, DEMAND)(one) for name, one in known.items() if name not in beyond]
    assert DEMAND.pga_g <= min(held) < 1.02 * DEMAND.pga_g


@pytest.mark.parametrize("facade", [PLAIN, STOREYS], ids=["plain", "storeys"])
def test_with_the_rows_every_mechanism_passes_and_with_95_per_cent_of_any_it_does_not(facade):
    """By the checks of all mechanisms, that the search has no part in."""
    tied = ties.Tied(sections(facade), DEMAND)
    assert tied.failing([])
    rows, beyond = tied.least(ties.levels_of(tied.sections))
    assert rows

    def failing(own, share=1.0):
        known = {one.part: one for one in tied.family(own, tied.slv).all()}
        least_g = share * DEMAND.pga_g
        fails = {k for k, one in known.items() if Slv(tied.sections, DEMAND)(one) < least_g}
        return fails - set(beyond)

    assert not failing(rows, 0.98)  # another search finds places that are weaker by so much
    assert failing(times(rows, 0.95))
    for k in range(len(rows)):
        less = [*rows[:k], *times(rows[k : k + 1], 0.95), *rows[k + 1 :]]
        assert failing(less), rows[k]


def test_a_gable_that_no_row_holds_is_named_and_does_not_stop_the_search():
    tall = {**PLAIN, "thickness_m": 0.3, "gable_height_m": 4.5}
    tied = ties.Tied(sections(tall), DEMAND)
    free = next(one for one in tied.family([]).all() if one.foot_m == 6.0 and one.plane)
    assert Slv(tied.sections, DEMAND)(free) < DEMAND.pga_g
    rows, beyond = tied.least([6.0])
    assert free.part in beyond
    assert not set(tied.failing(rows)) - set(beyond)


def test_a_facade_that_passes_needs_no_row():
    assert ties.Tied(sections(PLAIN), CodeDemand(0.03, 2.4, 0.3, "A")).least([6.0]) == ([], [])


def test_what_is_sold_is_not_thinner():
    assert [ties_built.commercial(d) for d in (7.2, 8.0, 8.01, 27.0, 95.2)] == [8, 8, 10, 28, 96]


class Shaken:
    """Stands in for the dynamic check: a mechanism holds where its weighted forces suffice.

    `asks` gives for a mechanism the rows that pull on it, the highest first, the weight of each
    row's force, and the sum that it asks for.
    """

    models = ("W1",)
    care = FINE

    def __init__(self, tied, asks):
        self.tied, self.asks, self.left, self.tried = tied, asks, set(), []
        self.beyond = set()

    def failing(self, rows, model, start=None):
        for name, (own, _, _) in self.asks.items():
            failing = ties_shaken.Failing(model, name, name, own)
            if name not in self.left and not self.holds(rows, failing):
                return failing
        return None

    def holds(self, rows, failing):
        _, weights, asked_n = self.asks[failing.part]
        self.tried.append((failing.part, rows))
        pull_n = sum(w * row.force_n for w, row in zip(weights, rows, strict=True))
        return pull_n >= asked_n


def two_rows(tied):
    return [ties.TieRow(z, 0.01 * tied.weight_n) for z in (3.0, 6.0)]


@pytest.mark.parametrize("times_more", [1.03, 1.7, 6.0])
def test_a_row_grows_until_its_mechanism_holds_and_95_per_cent_was_tried(times_more):
    """The upper one alone, whose arm is twice the other's: no other way takes less force."""
    tied = ties.Tied(sections(PLAIN), DEMAND)
    rows = two_rows(tied)
    asked = (0.5 + times_more) * rows[1].force_n
    shaken = Shaken(tied, {"whole": ([1, 0], (0.5, 1.0), asked)})
    found, governs = ties_grown.grown(shaken, rows, shaken.models)
    assert found[0] == rows[0]
    assert 1.0 <= found[1].force_n / (times_more * rows[1].force_n) < 1.0 / 0.95 + 1e-9
    assert [(g.which, g.why.part) for g in governs] == [((1,), "whole")]
    less = [rows[0], found[1]._replace(force_n=0.95 * found[1].force_n)]
    if less[1].force_n > 1.001 * rows[1].force_n:
        tried = [own[1].force_n for _, own in shaken.tried if own[0] == rows[0]]
        assert any(force_n == pytest.approx(less[1].force_n) for force_n in tried)


def test_only_rows_that_pull_on_what_fails_grow_and_those_that_take_the_least_force():
    """A part held by the upper row alone, then the whole, of which the lower row holds more."""
    tied = ties.Tied(sections(PLAIN), DEMAND)
    rows = two_rows(tied)
    force = 4.0 * rows[0].force_n
    asks = {"part": ([1], (0.0, 1.0), force), "whole": ([1, 0], (1.0, 0.1), 2.0 * force)}
    found, governs = ties_grown.grown(Shaken(tied, asks), rows, ["W1"])
    assert [g.which for g in governs] == [(1,), (0,)]
    assert force <= found[1].force_n < force / 0.95
    asked = 2.0 * force - 0.1 * found[1].force_n
    assert asked <= found[0].force_n < asked / 0.95


def test_rows_grow_together_where_none_alone_is_of_use():
    """Both have to be strong, as where a wall bends between them once either has broken."""
    tied = ties.Tied(sections(PLAIN), DEMAND)
    rows = two_rows(tied)
    shaken = Shaken(tied, {"bending": ([1, 0], (1.0, 1.0), 0.0)})
    shaken.holds = lambda own, failing: min(r.force_n for r in own) >= 3.0 * rows[0].force_n
    found, (growth,) = ties_grown.grown(shaken, rows, shaken.models)
    assert growth.which == (1, 0)
    assert all(3.0 <= r.force_n / rows[0].force_n < 3.0 / 0.95 for r in found)


def test_a_level_without_a_row_gets_one_where_no_row_that_is_there_helps():
    """The foot of the part is at 4 m; the row at 3 m does not pull on it, one at 6 m does."""
    tied = ties.Tied(sections(PLAIN), DEMAND)
    tied.passes = lambda rows, beyond: True
    rows = two_rows(tied)
    rows[1] = rows[1]._replace(force_n=0.0)
    family = tied.family([rows[0], rows[1]._replace(force_n=1.0)])
    name = family.part(3.0, "part").part  # above the row that is there
    shaken = Shaken(tied, {name: ([], (0.0, 1.0), 0.05 * tied.weight_n)})
    assert ties_grown.free_levels(shaken, rows, shaken.failing(rows, "W1")) == [1]
    found, (growth,) = ties_grown.grown(shaken, rows, ["W1"])
    assert growth.which == (1,)
    assert found[0] == rows[0]
    assert 1.0 <= found[1].force_n / (0.05 * tied.weight_n) < 1.0 / 0.95 + 1e-9
    tied.passes = lambda rows, beyond: False  # by hand the wall bends about the new row
    again = Shaken(tied, shaken.asks)
    assert ties_grown.grown(again, rows, ["W1"]) == (rows, [])
    assert again.left == {name}


def test_rows_give_back_what_the_others_have_made_needless_and_no_more():
    """The upper row alone asks for 3, both together for 4: of 2 and 6 the lower one gives 1."""
    tied = ties.Tied(sections(PLAIN), DEMAND)
    tied.passes = lambda rows, beyond: True
    asks = {"part": ([1], (0.0, 1.0), 3e3), "whole": ([1, 0], (1.0, 1.0), 4e3)}
    shaken = Shaken(tied, asks)
    start = [ties.TieRow(3.0, 2e3), ties.TieRow(6.0, 6e3)]
    found, why = ties_grown.lowered(shaken, start, ["W1"])
    low, high = (row.force_n for row in found)
    assert 3e3 <= high < 3e3 / 0.95
    assert low + high >= 4e3
    assert low == 0.0 or 0.95 * low + high < 4e3
    assert why[1].part == "part"
    for k, row in enumerate(found):
        if row.force_n:
            less = [*found[:k], *times([row], 0.95), *found[k + 1 :]]
            tried = [own for _, own in shaken.tried]
            assert any(
                all(a.force_n == pytest.approx(b.force_n) for a, b in zip(own, less, strict=True))
                for own in tried
            )


def test_a_row_that_all_checks_do_without_goes_and_checks_by_hand_keep_their_share():
    tied = ties.Tied(sections(PLAIN), DEMAND)
    least_n = 1.5e3
    tied.passes = lambda rows, beyond: rows[1].force_n >= least_n
    start = [ties.TieRow(3.0, 2e3), ties.TieRow(6.0, 6e3)]
    found, why = ties_grown.lowered(Shaken(tied, {}), start, ["W1"])
    assert found[0].force_n == 0.0
    assert least_n <= found[1].force_n < least_n / 0.95
    assert why == [None, ties_grown.BY_HAND]


def test_the_table_has_what_fails_with_less_and_rods_whose_anchors_hold():
    failing = ties_shaken.Failing("W2m", "above_6", "part above 6 m", [1])
    tied = ties.Tied(sections(PLAIN), DEMAND)
    rows = [ties.TieRow(z, f) for z, f in ((2.0, 0.0), (3.0, 5e3), (6.0, 40e3))]
    why = [None, ties_grown.BY_HAND, failing]
    made = [row if not row.force_n else ties_built.in_steel(tied, row, row.force_n) for row in rows]
    found = ties.Recommended(rows, [0.0, 4e3, 0.0], [], why, made, True, {"W1": [0.0, 0.0, 7e3]})
    table = ties_tables.table_of(tied, found, "W2m")
    assert [row["height_m"] for row in table] == [3.0, 6.0]
    assert [row["governed_by"] for row in table] == ["", "part above 6 m"]
    for row in table:
        steel = row["count"] * row["yield_mpa"] * math.pi / 4.0 * row["diameter_mm"] ** 2
        assert row["force_built_kn"] == pytest.approx(1e-3 * steel)
        assert row["force_built_kn"] >= row["force_kn"]
        assert row["anchor_load_kn"] < row["anchor_kn"]
        assert row["count"] <= row["anchors_most"]
    assert ties_tables.of_models(found) == [("W1", 6.0, 7.0, 1)]


def test_an_anchor_by_hand():
    """0.3 m plate on 0.4 m: 0.05/(2·1.35) MPa on 4·0.7·0.4 m²; crushing 2.6/2.7 MPa on 0.09 m²."""
    tied = ties.Tied(sections(PLAIN), DEMAND)
    held = tied.anchor(6.0)
    assert held.by == anchors.PUNCHING
    assert held.force_n == pytest.approx(0.05e6 / 2.7 * 4.0 * 0.7 * 0.4)
    small = ties.Tied(sections(PLAIN, anchor_plate_m=0.1), DEMAND).anchor(6.0)
    assert (small.by, small.force_n) == (anchors.CRUSHING, pytest.approx(2.6e6 / 2.7 * 0.01))
    assert tied.most(6.0) == 4  # of 5 m, each 0.3 + 2·0.4 m
    assert tied.most_n(6.0) < 4 * tied.anchor(6.0).force_n


def test_a_tie_without_a_stated_anchor_gets_the_estimate_and_keeps_a_stated_one():
    rows = [{"height_m": 3.0}, {"height_m": 6.0, "anchor_kn": 12.0}]
    resolved = sections({**PLAIN, "ties": rows})
    found = anchors.completed(resolved["facade"], resolved["assessment"])["ties"]
    held = anchors.anchor(resolved["assessment"], 0.4)
    assert [row["anchor_kn"] for row in found] == [pytest.approx(1e-3 * held.force_n), 12.0]
    assert resolved["facade"]["ties"][0]["anchor_kn"] is None
    stepped = {**resolved["facade"], "thickness_steps": [{"z_m": 3.0, "thickness_m": 0.3}]}
    assert anchors.thickness_at(stepped, 3.0) == pytest.approx(0.4)
    assert anchors.thickness_at(stepped, 3.1) == pytest.approx(0.3)


def test_what_is_built_has_the_margin_and_is_the_next_size_with_which_it_holds():
    """A stronger row that fails where a weaker one holds is passed over, the highest first."""
    tied = ties.Tied(sections(PLAIN, tie_levels_m=[3.0, 6.0], masonry_shear_mpa=1.0), DEMAND)
    tied.failing, tied.passes = lambda rows: {}, lambda rows, beyond: True
    rows = [ties.TieRow(3.0, 30e3), ties.TieRow(6.0, 40e3)]
    shaken = Shaken(tied, {"whole": ([1, 0], (0.0, 1.0), 0.0)})
    first, holds = ties_built.built(tied, rows, [], shaken)
    assert holds
    for row, made in zip(rows, first, strict=True):
        assert 1.25 * row.force_n <= made.force_n <= made.rods * tied.anchor(6.0).force_n
    least_n = first[1].force_n
    shaken.holds = lambda rows, failing: not math.isclose(rows[1].force_n, least_n)
    second, holds = ties_built.built(tied, rows, [], shaken)
    assert holds
    assert second[0] == first[0]
    assert second[1].force_n > 1.02 * least_n
    shaken.holds = lambda rows, failing: False
    assert not ties_built.built(tied, rows, [], shaken)[1]


def test_what_no_row_makes_hold_is_left_out_and_grows_none():
    tied = ties.Tied(sections(PLAIN), DEMAND)
    rows = two_rows(tied)
    shaken = Shaken(tied, {"gable": ([], (0.0, 0.0), 1.0), "whole": ([1, 0], (1, 1), math.inf)})
    found, governs = ties_grown.grown(shaken, rows, shaken.models)
    assert (found, governs) == (rows, [])
    assert shaken.left == {"gable", "whole"}
    most = tied.most_n(6.0)  # what anchors hold, less than twice the weight
    assert 0.9 * most < max(r.force_n for _, own in shaken.tried for r in own) <= most


def test_rows_pull_on_what_turns_below_them():
    """On a part whose foot is at 4 m, only the row above it; the whole façade hangs on both."""
    tied = ties.Tied(sections(PLAIN), DEMAND)
    rows = two_rows(tied)
    family = tied.family(rows)
    assert ties_built.held_by(family.part(0.0, "whole").mechanism, rows) == [1, 0]
    assert ties_built.held_by(family.part(4.0, "part").mechanism, rows) == [1]


def test_behind_a_part_are_the_rows_of_its_case():
    """Bending below a row leaves it in place by hand; shaken, the row gives, and may grow."""
    tied = ties.Tied(sections(PLAIN), DEMAND)
    rows = two_rows(tied)
    known = {one.part: one for one in tied.family(rows).all() if one.plane}
    bends = next(one for one in known.values() if one.foot_m == 3.0 and one.held_m == 6.0)
    assert ties_built.held_by(bends.mechanism, rows) == []
    given = {"facade": {**PLAIN, "ties": tied.entries(rows)}, "smdof.n_dof": 3}
    case = study_case("W1", {**given, "damping": {"law": "value", "beta_s": 0.001}})
    for one in known.values():
        behind = ties_shaken.behind(one, rows)
        part = case.part(one.foot_m, one.held_m, one.hinge_m).sections["facade"]
        heights = {row["height_m"] + one.foot_m for row in part["ties"]}
        assert {rows[k].height_m for k in behind} == heights
        assert behind == sorted(behind, reverse=True)


@pytest.mark.slow
def test_the_dynamic_check_of_a_tied_facade_holds_at_the_end_and_not_one_step_before():
    """Both by histories of its own: mean of the largest displacements, d_SLV of the tied curve."""
    resolved = sections(PLAIN, tie_levels_m=[6.0], shaken_within=1.0)
    damping = {"law": "value", "beta_s": 0.001}
    given = {"facade": PLAIN, "smdof": {"n_dof": 3, "period_s": 0.3}, "damping": damping}
    case = study_case("W1", given)
    tied = ties.Tied(resolved, DEMAND)
    table = "config/suites/recorded_suite.tsv"
    motions = [(Motion.named(name, table), 0.5) for name in ("IS101_Lo", "GMN_NS")]
    shaken = ties_shaken.Shaken([case], tied, motions, ["neg"])
    found = ties.recommended(tied, shaken)
    assert found.rows
    with ThreadPoolExecutor(2) as pool:  # the same trials in the same order
        beside = ties_shaken.Shaken([case], tied, motions, ["neg"], pool.map, 2)
        assert ties.recommended(tied, beside) == found
    assert pd.DataFrame(beside.rows).equals(pd.DataFrame(shaken.rows))
    for rows in (found.rows, found.built):
        final = shaken.everything(rows)
        assert final
        assert all(row["W1"]["holds"] or part in found.beyond for part, row in final.items())
    again = ties_shaken.Shaken([case], tied, motions, ["neg"])
    again.left = set(found.beyond)
    assert again.failing(found.rows, "W1") is None
    (k,) = (k for k, row in enumerate(found.rows) if row.force_n)
    assert found.why[k].model == "W1"
    less = times(found.rows, 0.95)
    assert again.failing(less, "W1").part == found.why[k].part
    json.dumps(ties_tables.after(tied, found, shaken))
