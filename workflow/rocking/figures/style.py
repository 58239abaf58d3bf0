"""What all figures share: the style file, colours of the models, and saving in two formats."""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D

GREY = "0.65"

plt.style.use(Path(__file__).with_name("paper.mplstyle"))


def _meets(line, box):
    """Whether a line passes through a box of the screen."""
    path = line.get_transform().transform_path(line.get_path()).cleaned(remove_nans=True)
    return len(path.vertices) > 1 and path.intersects_bbox(box, filled=False)


def _outside(axis, handle):
    """Whether a legend's entry stands for a line that never enters the axes."""
    own = isinstance(handle, Line2D) and handle.axes is axis and np.size(handle.get_xdata())
    return bool(own) and not _meets(handle, axis.get_window_extent())


def _covers(legend, axis):
    """Whether a legend lies on something that is drawn in its axes."""
    box = legend.get_window_extent()
    if any(line.get_visible() and _meets(line, box) for line in axis.lines):
        return True
    for drawn in axis.collections:
        offsets = np.ma.getdata(drawn.get_offsets())
        if offsets.any():  # symbols at points, else shapes where they are
            points = drawn.get_offset_transform().transform(offsets)
            if any(box.contains(*point) for point in points):
                return True
            continue
        shapes = (drawn.get_transform().transform_path(path) for path in drawn.get_paths())
        if any(shape.intersects_bbox(box) for shape in shapes):
            return True
    return any(patch.get_window_extent().overlaps(box) for patch in axis.patches)


def settle_legends(figure):
    """Leave out entries of lines outside the axes; put legends that lie on curves beside them."""
    figure.canvas.draw()
    for axis in figure.axes:
        legend = axis.get_legend()
        if legend is None:
            continue
        handles, labels = axis.get_legend_handles_labels()
        own = [text.get_text() for text in legend.get_texts()] == labels
        gone = [own and _outside(axis, handle) for handle in handles]
        covers = _covers(legend, axis)
        if not covers and not any(gone):
            continue
        if own:
            kept = [(h, t) for h, t, out in zip(handles, labels, gone, strict=True) if not out]
        else:
            texts = [text.get_text() for text in legend.get_texts()]
            kept = list(zip(legend.legend_handles, texts, strict=True))
        place = {"loc": "upper left", "bbox_to_anchor": (1.0, 1.0)} if covers else {}
        size = legend.get_texts()[0].get_fontsize()
        title = legend.get_title().get_text() or None
        axis.legend(*zip(*kept, strict=True), title=title, fontsize=size, **place)


def save(figure, output):
    """Save a figure to the job's outputs (png, pdf) without dates, then close it."""
    settle_legends(figure)
    plain = {"png": {"Software": None}, "pdf": {"CreationDate": None, "Producer": None}}
    for path in [str(p) for p in output]:
        figure.savefig(path, metadata=plain[path.rpartition(".")[2]])
    plt.close(figure)


def provenance(facts):
    """Say where a record comes from, for titles: one of `records.record.SOURCES`."""
    return f"{facts['name']} ({facts['source']})"
