"""What many figures draw: panels in rows, one legend for all, ticks, distributions, intervals."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import FormatStrFormatter, LogLocator, NullFormatter, NullLocator

BRIGHTNESS = np.array([0.299, 0.587, 0.114])  # of red, green and blue, as one sees them


def panels(count, most, size, around=(0.0, 0.0), **options):
    """Make a figure of panels in rows, at most so many side by side; return it and its axes.

    The panels are the first `count` of `axes.flat`, the places left over stay empty. `size` and
    `around` are width and height of a panel and of what stands around all of them [inch];
    `options` are of `plt.subplots`.
    """
    columns = max(1, min(most, count))
    rows = max(1, -(-count // columns))
    whole = around[0] + size[0] * columns, around[1] + size[1] * rows
    figure, axes = plt.subplots(rows, columns, figsize=whole, squeeze=False, **options)
    for axis in axes.flat[count:]:
        axis.set_axis_off()
    for axis in lowest(axes, count):
        axis.tick_params(labelbottom=True)  # a shared side has none but in the last row
    return figure, axes


def lowest(axes, count):
    """Return the panels with no other below them, of the first `count` of `axes.flat`."""
    return list(axes.flat[max(0, count - axes.shape[1]) : count])


def common_legend(figure, more=(), **place):
    """Give a figure one legend, where it has labels: each once, as it is drawn first.

    Those of `more`, {label: handle}, come last. `ncols` of `place` is the most: rows are made as
    long as each other.
    """
    entries: dict = {}
    for axis in figure.axes:
        for handle, label in zip(*axis.get_legend_handles_labels(), strict=True):
            entries.setdefault(label, handle)
    names = [*entries, *more]
    entries.update(more)
    if names:
        if most := place.get("ncols"):
            place["ncols"] = -(-len(names) // -(-len(names) // most))
        figure.legend([entries[name] for name in names], names, **place)


def ticks(side, values, labels=None):
    """Put ticks of a side (`axes.xaxis`, `axes.yaxis`) at these values alone, as plain numbers."""
    side.set_ticks(values, [f"{value:g}" for value in values] if labels is None else labels)
    side.set_minor_locator(NullLocator())


def plain_log(side, steps=(1.0,)):
    """Label a logarithmic side with plain numbers at these steps of every decade, and no others."""
    side.set_major_locator(LogLocator(subs=steps))
    side.set_major_formatter(FormatStrFormatter("%g"))
    side.set_minor_formatter(NullFormatter())


def distribution(axis, values, **look):
    """Draw the distribution of values: the k-th of n, by size, at (k − ½)/n; NaN do not count."""
    values = np.asarray(values, float)
    known = np.sort(values[~np.isnan(values)])
    if known.size:
        axis.plot(known, (np.arange(known.size) + 0.5) / known.size, **look)


def band(axis, x, middle, low, high, color, alpha=0.15, **look):
    """Draw a line with its band, of one colour."""
    axis.fill_between(x, low, high, color=color, alpha=alpha, lw=0)
    axis.plot(x, middle, color=color, **look)


def intervals(axis, place, middle, low, high, along="y", **look):
    """Draw symbols with intervals along "x" or "y"; an unknown end has no bar.

    `place` is where on the other side; it, the values `middle` and their ends have shape (n,).
    """
    middle, place = np.asarray(middle, float), np.asarray(place, float)
    length = np.array([middle - low, high - middle]).clip(0.0)
    known = np.isfinite(length)
    length[~known & known.any(axis=0)] = 0.0
    x, y = (place, middle) if along == "y" else (middle, place)
    axis.errorbar(x, y, **{f"{along}err": length}, **{"ls": "", "capsize": 2, **look})


def heat_map(axis, table, texts, **colours):
    """Draw a table as coloured squares with a text in each; return the image.

    Its columns, along x, and its index give the ticks. `texts` have its shape; `colours` are of
    `imshow`.
    """
    image = axis.imshow(table.to_numpy(float), origin="lower", aspect="auto", **colours)
    bright = image.to_rgba(table.to_numpy(float))[..., :3] @ BRIGHTNESS
    for (i, j), text in np.ndenumerate(np.asarray(texts, object)):
        colour = "black" if bright[i, j] > 0.4 else "white"
        axis.text(j, i, text, ha="center", va="center", fontsize=6.5, color=colour)
    for side, values in ((axis.xaxis, table.columns), (axis.yaxis, table.index)):
        side.set_ticks(range(len(values)), list(map(_name, values)))
    axis.tick_params(length=0)
    axis.grid(False)
    return image


def _name(value):
    """Text of a column or row: a word, or a number with three digits and all before the point."""
    if isinstance(value, str):
        return value
    return f"{value:.3g}" if abs(value) < 1000.0 else f"{value:g}"
