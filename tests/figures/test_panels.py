"""What figures share: panels in rows, one legend, distributions, intervals, maps."""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pytest
from matplotlib.colors import to_rgb
from rocking.figures import panels


@pytest.mark.parametrize(
    ("count", "shape", "below"),
    [(1, (1, 1), [0]), (3, (1, 3), [0, 1, 2]), (7, (2, 4), [3, 4, 5, 6])],
)
def test_panels_stand_in_rows_and_none_is_empty(count, shape, below):
    figure, axes = panels.panels(count, 4, (2.0, 1.5), around=(0.5, 0.25), sharex=True)
    assert axes.shape == shape
    np.testing.assert_allclose(
        figure.get_size_inches(), (0.5 + 2.0 * shape[1], 0.25 + 1.5 * shape[0])
    )
    assert [axis.axison for axis in axes.flat] == [i < count for i in range(axes.size)]
    lowest = panels.lowest(axes, count)
    assert lowest == [axes.flat[i] for i in below]
    # where nothing stands below, the shared side has its labels
    assert all(axis.xaxis.get_tick_params()["labelbottom"] for axis in lowest)
    plt.close(figure)


def test_a_common_legend_names_what_any_panel_draws_once():
    figure, (one, two) = plt.subplots(1, 2)
    one.plot([0, 1], [0, 1], color="red", label="both")
    two.plot([0, 1], [0, 1], color="blue", label="both")
    two.plot([0, 1], [1, 0], color="green", label="second alone")
    panels.common_legend(figure, loc="upper left")
    (legend,) = figure.legends
    assert [text.get_text() for text in legend.get_texts()] == ["both", "second alone"]
    assert legend.legend_handles[0].get_color() == "red"
    plt.close(figure)
    figure, _ = plt.subplots()
    panels.common_legend(figure)
    assert not figure.legends
    plt.close(figure)


def test_a_distribution_has_half_of_its_values_below_the_median(axis):
    values = np.array([3.0, np.nan, 1.0, 2.0, 10.0])
    panels.distribution(axis, values)
    x, share = axis.lines[0].get_data()
    np.testing.assert_array_equal(x, [1.0, 2.0, 3.0, 10.0])
    np.testing.assert_allclose(share, [0.125, 0.375, 0.625, 0.875])
    assert np.interp(0.5, share, x) == np.nanmedian(values)
    panels.distribution(axis, [np.nan])
    assert len(axis.lines) == 1


@pytest.mark.parametrize("along", ["x", "y"])
def test_intervals_reach_to_their_ends(axis, along):
    middle, low, high = [1.0, 2.0, 3.0], [0.5, np.nan, np.nan], [1.5, 4.0, np.nan]
    panels.intervals(axis, [10, 20, 30], middle, low, high, along=along)
    (bars,) = axis.containers
    side = 1 if along == "y" else 0
    first, second, third = bars[2][0].get_segments()
    np.testing.assert_allclose(first[:, side], (0.5, 1.5))
    np.testing.assert_allclose(second[:, side], (2.0, 4.0))  # the end that is known
    assert not third.size


def test_a_map_has_its_columns_along_x_and_can_be_read_on_dark(axis):
    table = pd.DataFrame([[0.0, 1.0, 0.5]], index=["row"], columns=[0.1, 20.0, 100000.0])
    image = panels.heat_map(axis, table, [["a", "b", "c"]], cmap="gray", vmin=0.0, vmax=1.0)
    assert image.origin == "lower"
    assert [label.get_text() for label in axis.get_xticklabels()] == ["0.1", "20", "100000"]
    assert [label.get_text() for label in axis.get_yticklabels()] == ["row"]
    assert [(t.get_text(), to_rgb(t.get_color())) for t in axis.texts[:2]] == [
        ("a", (1.0, 1.0, 1.0)),
        ("b", (0.0, 0.0, 0.0)),
    ]
