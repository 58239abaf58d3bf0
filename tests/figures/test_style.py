"""Legends lie on no curve and name nothing that is not to be seen; figures say their records."""

import json
import re
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.lines import Line2D
from rocking.figures import style

ROOT = Path(__file__).resolve().parents[2]


def texts(axis):
    return [text.get_text() for text in axis.get_legend().get_texts()]


def beside(axis):
    axis.figure.canvas.draw()
    return axis.get_legend().get_window_extent().x0 >= axis.get_window_extent().x1


@pytest.mark.parametrize("kind", ["line", "points", "area", "bars"])
def test_a_legend_on_what_is_drawn_goes_beside_it(axis, kind):
    x = np.linspace(0.0, 1.0, 400)
    if kind == "line":
        axis.plot(x, 0.5 + 0.5 * np.sin(300 * x), label="all over")
    elif kind == "points":
        axis.scatter(np.tile(x, 9), np.repeat(np.linspace(0, 1, 9), 400), label="all over")
    elif kind == "area":
        axis.fill_between(x, 0.0, 1.0, label="all over")
    else:
        axis.bar([0.25, 0.75], [1.0, 1.0], width=0.5, label="all over")
    axis.legend()
    style.settle_legends(axis.figure)
    assert beside(axis)
    assert texts(axis) == ["all over"]


def test_a_legend_that_lies_on_nothing_stays(axis):
    axis.plot([0.0, 1.0], [0.0, 0.0], label="low")
    axis.set_ylim(-0.1, 1.0)
    axis.legend(loc="upper left")
    style.settle_legends(axis.figure)
    assert not beside(axis)


def test_what_never_enters_the_axes_is_not_named(axis):
    axis.plot([0.0, 1.0], [0.0, 0.1], label="seen")
    axis.plot([0.0, 1.0], [5.0, 6.0], label="above")
    axis.plot([-1.0, 2.0], [-1.0, 2.0], label="through")
    axis.set(xlim=(0, 1), ylim=(0, 1))
    axis.legend(loc="upper left")
    style.settle_legends(axis.figure)
    assert texts(axis) == ["seen", "through"]


def facts(folder, name, kind, details):
    path = folder / f"{name}.json"
    path.write_text(json.dumps({"name": name, "source": kind, "details": details}))
    return str(path)


def test_what_records_are_is_said_by_kind_and_counted_where_they_are_many(tmp_path):
    about = {"about": {"station": "ABC", "event": "Somewhere, 1990"}}
    few = [
        facts(tmp_path, "A", "surrogate", about),
        facts(tmp_path, "B", "file", {"file": "b.at2", "component": "North"}),
    ]
    recorded, stands_for, note = style.origins(few, 20.0).splitlines()
    assert recorded == "as given: B (North, b.at2)"
    assert stands_for == "surrogates, in place of: A (ABC, Somewhere, 1990)"
    assert "not its record" in note
    licence = {"source": "A. Author (2001), Journal", "licence": "CC BY 4.0, https://x"}
    many = [
        facts(tmp_path, f"R{i}", "recorded, shipped", {"station": i // 2, "event": "E"} | licence)
        for i in range(6)
    ]
    assert style.origins(many, 20.0) == (
        "recorded, shipped: 6 (R0 to R5), 3 stations, 1 event. A. Author (2001), CC BY 4.0"
    )
    assert style.origins([], 20.0) == ""


def test_what_records_are_stands_in_lines_alike_long_that_part_at_no_hyphen(tmp_path):
    """As few lines as the width takes; the last holds no lone word."""
    about = {"about": {"event": "Somewhere, 2011-06-13 and 2011-02-21, " + "both " * 5 + "there"}}
    path = facts(tmp_path, "A", "file", about)
    (text,) = style.origins([path], 20.0).splitlines()
    for width_in, count in ((2.0, 3), (2.6, 2), (4.0, 2), (4.2, 1)):
        lines = style.origins([path], width_in).splitlines()
        assert " ".join(lines) == text
        assert max(map(len, lines)) <= 20 * width_in
        assert len(lines) == count
        assert min(map(len, lines)) > 0.6 * max(map(len, lines))


def test_a_record_of_several_runs_is_one_and_another_of_its_name_is_not(tmp_path):
    paths = []
    for folder, digest in (("a", "1"), ("b", "1"), ("c", "2")):
        (tmp_path / folder).mkdir()
        details = {"file": f"{digest}.at2", "sha256": digest}
        paths.append(facts(tmp_path / folder, "A", "file", details))
    assert style.origins(paths, 20.0) == "as given: A (1.at2); A (2.at2)"


NO_RECORD = {  # the building, restitution, shaking tables of others, pushover
    *("fig01_building", "fig02_modes", "fig08_w3"),
    *("fig04_calibration", "fig05_sorrentino", "fig06_shawa", "calibrate_wall"),
    *("figure_shake_table", "figure_models"),  # name their motions themselves
}


def test_every_figure_of_a_record_says_what_it_is():
    scripts = [*(ROOT / "workflow").glob("scripts/*/*.py")]
    scripts += (ROOT / "workflow").glob("studies/*/scripts/*.py")
    silent = {
        path.stem
        for path in scripts
        for line in path.read_text("utf-8").splitlines()
        if "style.save(" in line and not re.search(r"\bfacts\)|input\.records\)", line)
    }
    assert silent == NO_RECORD & {path.stem for path in scripts}  # of studies that are there


@pytest.mark.parametrize("side", ["lower", "upper"])
def test_the_line_on_records_is_below_all_else(tmp_path, side):
    """Red, the legend's, stays in the figure, whose size grows by the line alone."""
    known, shapes = [facts(tmp_path, "A", "surrogate", {})], []
    for name, records in (("bare", ()), ("said", known)):
        figure, axis = plt.subplots(figsize=(5.0, 3.0))
        axis.plot([0.0, 1.0], [0.0, 1.0], color="0.5")
        red = Line2D([], [], color="red", lw=4)
        figure.legend([red], ["legend"], loc=f"outside {side} center")
        style.save(figure, [tmp_path / f"{name}.png"], records)
        image = plt.imread(tmp_path / f"{name}.png")
        rows = np.flatnonzero((image[..., :3] == (1.0, 0.0, 0.0)).all(axis=2).any(axis=1))
        shapes.append((image.shape[0], rows.min(), rows.max()))
    (height, *legend), (taller, *same) = shapes
    np.testing.assert_allclose(same, legend, atol=3)
    assert height + 20 < taller < height + 120


@pytest.mark.parametrize(
    ("ends", "some"), [((0.03, 0.2), ["0.06", "0.1"]), ((0.2, 0.4), ["0.3"]), ((1, 1e3), ["100"])]
)
def test_logarithmic_axes_are_written_in_plain_numbers(axis, ends, some):
    axis.loglog(ends, ends)
    style.plain_numbers(axis.figure)
    axis.figure.canvas.draw()
    for side in (axis.xaxis, axis.yaxis):
        said = {label.get_text() for label in side.get_ticklabels(which="both")}
        assert set(some) <= said
        assert not any("10^" in text for text in said)


def test_a_logarithmic_axis_of_many_decades_keeps_powers_of_ten(axis):
    axis.semilogy([0.0, 1.0], [1e-9, 1.0])
    style.plain_numbers(axis.figure)
    axis.figure.canvas.draw()
    assert any("10^" in label.get_text() for label in axis.get_yticklabels())
