"""What a run says at its end: shares over curves, the building's, and what YADE was foretold."""

import numpy as np
import pandas as pd
import pytest
from made_curves import collapse_tables
from made_curves import curve as made
from rocking.collapse import answer
from run_script import script


def curve(edge_g, building_g=None, top_g=1.0):
    """Collapse probabilities of a curve that falls from one amplitude on."""
    pga_g = np.linspace(0.05, top_g, 381)
    table = {"pga_g": pga_g, "probability": (pga_g >= edge_g).astype(float)}
    fell = np.full(pga_g.size, np.nan) if building_g is None else (pga_g >= building_g)
    return pd.DataFrame({**table, "probability_building": fell})


def told(building_g):
    first = [np.nan if g is None else float(g < 0.3) for g in building_g]
    return pd.DataFrame({"pga_building_g": building_g, "building_first": first}, dtype=float)


NONE = pd.DataFrame(columns=["pga_g", "fell", "foretold"])


def row(tables, collapse=None, checked=NONE):
    collapse = told([None] * len(tables)) if collapse is None else collapse
    return answer.row("W1", "how they move", 2, 1, tables, collapse, checked)


def test_every_curve_counts_alike():
    """Of four that fall from 0.2, 0.3, 0.4 and 0.5 g on, half have from 0.3 g on."""
    found = row([curve(g) for g in (0.2, 0.3, 0.4, 0.5)])
    assert found["pga_low_g"] == pytest.approx(0.2, abs=0.005)
    assert found["pga_half_g"] == pytest.approx(0.3, abs=0.005)
    assert found["pga_high_g"] == pytest.approx(0.5, abs=0.005)
    assert [found[f"p_at_{g}g"] for g in (0.1, 0.2, 0.4)] == pytest.approx([0.0, 0.25, 0.75])
    assert (found["curves"], found["motions"], found["stations"]) == (4, 2, 1)


def test_beyond_what_was_run_a_curve_keeps_its_last_share():
    """One whose scan ended since all fell has fallen; one that never fell has not."""
    short, standing = curve(0.2, top_g=0.4), curve(2.0)
    assert answer.over_curves([short, standing], [0.9]) == pytest.approx([0.5])
    assert answer.over_curves([short], [0.01]) == [0.0]
    found = row([standing, standing, curve(0.3)])
    assert np.isnan(found["pga_half_g"])
    assert found["pga_low_g"] == pytest.approx(0.3, abs=0.005)


def test_the_building_is_told_where_it_yields_and_only_there():
    tables = [curve(0.4, building_g=g) for g in (0.2, 0.3, 0.8)]
    found = row(tables, told([0.2, 0.3, np.nan]))
    assert found["pga_building_g"] == pytest.approx(0.3)
    assert found["building_first"] == pytest.approx(1 / 3)
    share = answer.over_curves(tables, [0.25, 0.5], "probability_building")
    assert share == pytest.approx([1 / 3, 2 / 3])
    elastic = row([curve(0.4)])
    assert np.isnan([elastic["pga_building_g"], elastic["building_first"]]).all()
    assert np.isnan(answer.over_curves([curve(0.4)], [0.5], "probability_building")).all()


def test_half_of_the_building_is_where_its_drawn_share_reaches_half():
    """Of an even number of curves a median of their own lies between two; the façade's does not."""
    edges = (0.2, 0.3, 0.4, 0.5)
    found = row([curve(g, building_g=g) for g in edges], told(edges))
    assert found["pga_building_g"] == found["pga_half_g"] == pytest.approx(0.3, abs=0.005)


def test_yade_is_compared_with_what_the_scan_said_there():
    """A history that failed counts for nothing; one that falls where none should is told."""
    scan = pd.DataFrame(
        {"pga_g": [0.1, 0.2, 0.3, 0.4], "status": ["ok", "ok", "failed", "overturned"]}
    )
    runs = pd.DataFrame(
        {"pga_g": [0.11, 0.2, 0.39, 0.5], "status": ["ok", "overturned", "overturned", "failed"]}
    )
    found = answer.told_by_yade(scan, runs)
    assert found.values.tolist() == [[0.11, 0, 0], [0.2, 1, 0], [0.39, 1, 1]]
    counts = row([curve(0.3)], checked=found)
    assert (counts["yade_fell"], counts["yade_stood"], counts["yade_otherwise"]) == (1, 1, 1)
    assert len(answer.told_by_yade(scan[:0], runs)) == 0


def test_the_terminal_says_it_in_a_line_a_model():
    checked = pd.DataFrame({"pga_g": [0.2, 0.31], "fell": [0, 1], "foretold": [0, 1]})
    tables = [curve(0.3, building_g=0.25), curve(0.4, building_g=0.25)]
    table = pd.DataFrame(
        [row(tables, told([0.25, 0.25]), checked), {**row([curve(3.0)] * 2), "model": "W2m"}]
    )
    head, first, second, building = answer.lines(table)
    assert head == "half of the histories fell from this PGA on (2 motions of 1 station):"
    assert first.startswith("  W1   0.30 g (0 % at 0.2 g, 50 % at 0.3 g, 100 % at 0.4 g)")
    assert first.endswith("YADE: 1 fell and 1 stood as foretold")
    assert second.startswith("  W2m  more than was run")
    assert "YADE" not in second
    assert building == "  the building itself is down from 0.25 g in half of them"


@pytest.mark.parametrize("scanned", [True, False])
def test_table_and_figure_of_a_run_with_and_without_a_scan(tmp_path, scanned):
    """YADE's only run that fell stood in the scan; without one YADE's answer is its own."""
    own = [made(tmp_path / "ida.csv", "W1", "A", "pos", 0.2, 0.21)]
    where = [(tmp_path / f"scan_{name}.csv", name) for name in "AB"]
    scans = [made(path, "W1", name, "pos", 0.21, 0.3) for path, name in where if scanned]
    tables = collapse_tables(tmp_path, own, scans=scans)
    answers = {name: str(tmp_path / f"{name}.csv") for name in ("answer", "curves", "checked")}
    script(
        "table_answer",
        tmp_path,
        input={"ida": own, "scans": scans, **tables},
        output=answers,
        params={"models": ["W1"], "stations": {"A": "S", "B": "S"}},
    )
    (found,) = pd.read_csv(answers["answer"]).to_dict("records")
    counts = [found[f"yade_{name}"] for name in ("fell", "stood", "otherwise")]
    assert counts == ([0, 1, 1] if scanned else [0, 0, 0])
    assert found["pga_half_g"] == pytest.approx(0.255 if scanned else 0.21, abs=0.002)
    pictures = {kind: str(tmp_path / f"answer.{kind}") for kind in ("png", "pdf")}
    params = {"about": "a façade", "drift": 0.005}
    inputs = {**answers, "facts": []}
    script("answer", tmp_path, input=inputs, output=pictures, params=params)
    assert (tmp_path / "answer.png").stat().st_size > 10_000
