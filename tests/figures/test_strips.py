"""The strip of a model beside Figure 9: its colour is the share that falls."""

import numpy as np
import pandas as pd
import pytest
from matplotlib.colors import to_rgb
from rocking.figures import style
from rocking.figures.ida import draw_probability, draw_scan, symbols

from yade_scripts.model.registry import MODELS

PGA = np.array([0.1, 0.2, 0.3, 0.4])
SHARE = np.array([0.0, 0.5, 0.0, 1.0])  # falls, stands again and falls
ROW = {"model": "W1", "pga_safe_g": 0.1, "pga_collapse_g": 0.2}


def table(**changes):
    whole = {"pga_g": PGA, "probability": SHARE, "realisations": 11, "probability_yade": np.nan}
    return pd.DataFrame(whole | changes)


def test_a_strip_is_white_where_nothing_falls_and_full_where_all_does(axis):
    draw_probability(axis, 0, table(), ROW, 0.5)
    (mesh,) = axis.collections
    colours = np.asarray(mesh.get_array())[:, 0]
    full = np.array(to_rgb(MODELS["W1"].colour))
    assert colours[0] == pytest.approx([1.0, 1.0, 1.0])
    assert colours[3] == pytest.approx(full)
    assert colours[1] == pytest.approx((1.0 + full) / 2.0)
    edges = np.asarray(mesh.get_coordinates()[:, 0, 1])
    assert edges == pytest.approx([0.0, 0.15, 0.25, 0.35, 0.5])  # each level to its neighbours


def test_without_a_scan_what_is_not_known_is_hatched(axis):
    draw_probability(axis, 0, table().iloc[:0], ROW, 0.5)
    hatched, fallen = axis.collections
    assert hatched.get_hatch()
    low, high = (np.ptp(c.get_paths()[0].vertices[:, 1]) for c in (hatched, fallen))
    assert low == pytest.approx(0.1)  # from what stood to what fell
    assert high == pytest.approx(0.3)


def test_symbols_name_what_is_drawn():
    assert list(symbols(scanned=False)) == ["YADE: stood", "YADE: fell"]
    assert "planar solver" in symbols()


@pytest.mark.parametrize(("most", "length"), [(1.9, 1.0), (0.7, 0.5), (3e-4, 2e-4), (0.0, 0.0)])
def test_a_scale_bar_has_a_round_length(most, length):
    assert style.round_length(most) == pytest.approx(length)


def test_a_panel_holds_no_pixels(axis, tmp_path):
    """A PDF keeps those of the whole figure for each part drawn so: 88 panels filled a machine."""
    about = {"model": "W1", "record": "GMN_NS", "direction": "pos", "status": "ok"}
    draw_scan(axis, pd.DataFrame({**about, "d_over_b": SHARE, "pga_g": PGA}))
    draw_probability(axis, 0, table(), ROW, 0.5)
    style.save(axis.figure, [str(tmp_path / "a.pdf")])
    assert b"/Subtype /Image" not in (tmp_path / "a.pdf").read_bytes()
