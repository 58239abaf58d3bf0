"""Legends lie on no curve and name nothing that is not to be seen."""

import matplotlib.pyplot as plt
import numpy as np
import pytest
from rocking.figures import style


@pytest.fixture
def axis():
    figure, axis = plt.subplots()
    yield axis
    plt.close(figure)


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
