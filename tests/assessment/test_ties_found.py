"""Rows of ties that make a façade pass: by closed form, by the checks themselves, under motions."""

import json
import math

import pytest
from rocking import Case, Motion
from rocking.assessment import inputs, ties, ties_shaken
from rocking.assessment.code_checks import slv_pga
from rocking.assessment.code_spectrum import CodeDemand
from rocking.assessment.shaken import label
from rocking.configuration import config as configuration

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
    return configuration.resolve({"facade": facade, "smdof": chain, "assessment": own})


def times(rows, factor):
    return [row._replace(force_n=factor * row.force_n) for row in rows]


def test_rows_may_stand_at_floors_and_eaves_or_where_it_is_said():
    assert ties.levels_of(sections(STOREYS)) == [2.8, 5.5, 8.0]
    near = [{"height_m": z, "load_kn": 5.0} for z in (7.9, 0.2, 4.0)]
    assert ties.levels_of(sections({**PLAIN, "height_m": 8.0, "floors": near})) == [4.0, 8.0]
    assert ties.levels_of(sections(STOREYS, tie_levels_m=[4.0])) == [4.0]
    assert ties.levels_of(sections(STOREYS, tie_levels_m=[])) == []


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
    known = {label(one): one for one in tied.family(rows).all()}
    held = [
        slv_pga(one, tied.sections, DEMAND) for name, one in known.items() if name not in beyond
    ]
    assert DEMAND.pga_g <= min(held) < 1.02 * DEMAND.pga_g


@pytest.mark.parametrize("facade", [PLAIN, STOREYS], ids=["plain", "storeys"])
def test_with_the_rows_every_mechanism_passes_and_with_95_per_cent_of_any_it_does_not(facade):
    """By the checks of all mechanisms, that the search has no part in."""
    tied = ties.Tied(sections(facade), DEMAND)
    assert tied.failing([])
    rows, beyond = tied.least(ties.levels_of(tied.sections))
    assert rows

    def failing(own):
        known = {label(one): one for one in tied.family(own).all()}
        fails = {
            k for k, one in known.items() if slv_pga(one, tied.sections, DEMAND) < DEMAND.pga_g
        }
        return fails - set(beyond)

    assert not failing(rows)
    assert failing(times(rows, 0.95))
    for k in range(len(rows)):
        less = [*rows[:k], *times(rows[k : k + 1], 0.95), *rows[k + 1 :]]
        assert failing(less), rows[k]


def test_a_gable_that_no_row_holds_is_named_and_does_not_stop_the_search():
    tall = {**PLAIN, "thickness_m": 0.3, "gable_height_m": 4.5}
    tied = ties.Tied(sections(tall), DEMAND)
    free = next(one for one in tied.family([]).all() if one.foot_m == 6.0 and one.plane)
    assert slv_pga(free, tied.sections, DEMAND) < DEMAND.pga_g
    rows, beyond = tied.least([6.0])
    assert label(free) in beyond
    assert not set(tied.failing(rows)) - set(beyond)


def test_a_facade_that_passes_needs_no_row():
    assert ties.Tied(sections(PLAIN), CodeDemand(0.03, 2.4, 0.3, "A")).least([6.0]) == ([], [])


def test_what_is_sold_is_not_thinner():
    assert [ties.commercial(d) for d in (7.2, 8.0, 8.01, 27.0, 95.2)] == [8, 8, 10, 28, 96]


class Shaken:
    """Stands in for the dynamic check: holds from a factor on."""

    def __init__(self, from_factor, tied):
        self.tied, self.least, self.tried, self.all = tied, from_factor, [], 0.0

    def holds(self, rows, factor, whole=False, short=False):
        self.tried.append(factor)
        return factor >= (self.least if short else max(self.least, self.all))


@pytest.mark.parametrize("least", [0.2, 1.0, 1.03, 1.7, 6.0])
def test_rows_grow_until_the_dynamic_check_holds_and_95_per_cent_was_tried(least):
    tied = ties.Tied(sections(PLAIN), DEMAND)
    rows = [ties.TieRow(6.0, 0.01 * tied.weight_n)]
    shaken = Shaken(least, tied)
    factor = ties_shaken.stronger(shaken, rows, by_hand=least >= 1.0)
    assert factor >= least
    assert 0.95 * factor < least
    if least > 1.0 or least < 0.5:
        assert any(tried == pytest.approx(0.95 * factor) for tried in shaken.tried)
    assert ties_shaken.stronger(Shaken(math.inf, tied), rows) is None


def test_a_mechanism_that_did_not_fail_first_is_held_too():
    """It asks for twice the rows, which no short trial knows."""
    tied = ties.Tied(sections(PLAIN), DEMAND)
    rows = [ties.TieRow(6.0, 0.01 * tied.weight_n)]
    shaken = Shaken(1.3, tied)
    shaken.all = 2.0
    factor = ties_shaken.stronger(shaken, rows)
    assert factor >= 2.0
    assert shaken.tried.count(factor) >= 2


@pytest.mark.slow
def test_the_dynamic_check_of_a_tied_facade_holds_at_the_end_and_not_one_step_before():
    """Both by histories of its own: mean of the largest displacements, d_SLV of the tied curve."""
    resolved = sections(PLAIN, tie_levels_m=[6.0], shaken_within=1.0)
    damping = {"law": "value", "beta_s": 0.001}
    given = {"facade": PLAIN, "smdof": {"n_dof": 3, "period_s": 0.3}, "damping": damping}
    case = Case.configured("W1", given)
    tied = ties.Tied(resolved, DEMAND)
    table = "config/suites/recorded_suite.tsv"
    motions = [(Motion.named(name, table).record, 0.5) for name in ("IS101_Lo", "GMN_NS")]
    shaken = ties_shaken.Shaken([case], tied, motions, ["neg"])
    found = ties.found(tied, shaken, False)
    assert found.rows
    assert found.factor >= 1.0
    assert shaken.final
    assert all(row["holds"] or part in shaken.unheld for part, row in shaken.final.items())
    if found.factor > 1.0:
        again = ties_shaken.Shaken([case], tied, motions, ["neg"])
        assert not again.holds(times(found.rows, 0.95), 0.95)
    rows = ties.table_of(found, resolved["strengthening"])
    for row, own in zip(rows, found.rows, strict=True):
        area = math.pi / 4.0 * row["diameter_mm"] ** 2
        assert row["count"] * area * row["yield_mpa"] == pytest.approx(own.force_n, rel=1e-9)
    json.dumps(ties.after(tied, found, shaken))
