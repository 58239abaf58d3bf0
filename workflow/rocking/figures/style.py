"""What all figures share: the style file, colours of the models, and saving in two formats."""

import textwrap
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D
from matplotlib.mathtext import MathTextParser
from matplotlib.text import Text
from matplotlib.ticker import LogFormatter, LogFormatterSciNotation
from matplotlib.transforms import Bbox

from yade_scripts.files import read_json

GREY = "0.65"
SIGNS = {"pos": "+", "neg": "−"}  # of a direction
LOOKS = (  # colour, line and marker of curves that belong to no model
    ("#0072B2", "-", "o"),
    ("#D55E00", "--", "s"),
    ("#009E73", "-.", "^"),
    ("#CC79A7", ":", "D"),
    ("#56B4E9", "-", "v"),
    ("#E69F00", "--", "P"),
)
PLAIN = (1e-4, 1e5)  # range of a logarithmic axis that needs no powers of ten
MARGIN_IN = 0.05
NAMED = 4  # records that are named one by one below a figure
SOURCES = {
    "file": "as given",  # whether recorded, the project cannot know
    "recorded, shipped": "recorded, shipped",
    "surrogate": "surrogates, in place of",
}
# measured on the recorded suite, docs/motions.md
SURROGATE_NOTE = (
    "A surrogate is not its record: three of four collapse within a factor of 1.5 of it; which"
    " direction is the weak one, they do not tell (docs/motions.md)."
)

matplotlib.rcdefaults()  # whatever a file matplotlibrc of the user or the working folder sets
plt.style.use(Path(__file__).with_name("paper.mplstyle"))
MATH = MathTextParser("path")


class PlainNumbers(LogFormatter):
    """Labels of a logarithmic axis as numbers are written: 0.06, not 6×10⁻²."""

    def __call__(self, x, pos=None):
        """Text of one label; empty where the axis leaves it out."""
        return f"{x:g}" if super().__call__(x, pos) else ""


def plain_numbers(figure):
    """Write logarithmic axes within PLAIN in plain numbers, where their script chose no other."""
    for axes in figure.axes:
        for axis in (axes.xaxis, axes.yaxis):
            low, high = sorted(axis.get_view_interval())
            if low < PLAIN[0] or high > PLAIN[1]:
                continue
            if isinstance(axis.get_major_formatter(), LogFormatterSciNotation):
                axis.set_major_formatter(PlainNumbers())
            if isinstance(axis.get_minor_formatter(), LogFormatterSciNotation):
                axis.set_minor_formatter(PlainNumbers(labelOnlyBase=False))


def round_length(most):
    """Return the largest of 1, 2 and 5 times a power of ten within `most`, for a scale bar.

    Zero where `most` is not positive.
    """
    if not most > 0.0:
        return 0.0
    decade = 10.0 ** np.floor(np.log10(most))
    return float(max(step for step in (1.0, 2.0, 5.0) if step * decade <= most) * decade)


def _meets(line, box):
    """Whether a line passes through a box of the screen."""
    path = line.get_transform().transform_path(line.get_path()).cleaned(remove_nans=True)
    return len(path.vertices) > 1 and path.intersects_bbox(box, filled=False)


def _outside(axis, handle):
    """Whether a legend's entry stands for a line that never enters the axes."""
    drawn = isinstance(handle, Line2D) and handle.axes is axis and np.size(handle.get_xdata())
    return bool(drawn) and not _meets(handle, axis.get_window_extent())


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
    """Leave out entries of lines outside the axes; put legends that lie on curves beside them.

    A legend beside its axes makes the others narrower, so they are looked at again.
    """
    for _ in range(len(figure.axes) + 1):
        figure.canvas.draw()
        if not any([_settle(axis) for axis in figure.axes]):
            return


def _settle(axis):
    """Settle the legend of one axes as drawn; return whether it moved."""
    legend = axis.get_legend()
    if legend is None:
        return False
    handles, labels = axis.get_legend_handles_labels()
    texts = [text.get_text() for text in legend.get_texts()]
    as_labelled = texts == labels
    gone = [as_labelled and _outside(axis, handle) for handle in handles]
    covers = _covers(legend, axis)
    if not covers and not any(gone):
        return False
    if as_labelled:
        kept = [(h, t) for h, t, out in zip(handles, labels, gone, strict=True) if not out]
    else:
        kept = list(zip(legend.legend_handles, texts, strict=True))
    place = {"loc": "upper left", "bbox_to_anchor": (1.0, 1.0)} if covers else {}
    size = legend.get_texts()[0].get_fontsize()
    title = legend.get_title().get_text() or None
    axis.legend(*zip(*kept, strict=True), title=title, fontsize=size, **place)
    return covers


def as_written(text):
    """A user's words for a figure, in which $ is a sign as any other."""
    return str(text).replace("$", r"\$")


def settle_math(figure):
    """Show text as it is written where its signs $ hold no mathematics that can be read."""
    for text in figure.findobj(Text):
        if "$" in (words := text.get_text()):
            try:
                MATH.parse(words)
            except ValueError:
                text.set_parse_math(False)


def save(figure, output, facts=()):
    """Save a figure to those of the job's outputs that are pictures, without dates; close it.

    `facts` are one or more provenance files of the records whose results it shows; what they say is
    added below the figure, which keeps its size.
    """
    settle_math(figure)
    plain_numbers(figure)
    settle_legends(figure)
    box = figure.bbox_inches.extents
    if text := origins(facts, figure.get_figwidth()):
        line = figure.text(0.5, 0.0, text, fontsize=6.5, ha="center", va="top")
        figure.set_dpi(plt.rcParams["savefig.dpi"])  # letters are not as wide at every other
        figure.draw_without_rendering()
        figure.set_layout_engine("none")  # all stays where it is now
        for legend in figure.legends:
            legend.set_bbox_to_anchor((0.0, 0.0, 1.0, 1.0), figure.transFigure)
        box[1] = line.get_window_extent().y0 / figure.dpi - MARGIN_IN
    plain = {"png": {"Software": None}, "pdf": {"CreationDate": None, "Producer": None}}
    for path in [str(p) for p in output]:
        if (kind := path.rpartition(".")[2]) in plain:
            figure.savefig(path, metadata=plain[kind], bbox_inches=Bbox.from_extents(*box))
    plt.close(figure)


def provenance(facts):
    """Say where a record comes from, for titles: one of `record_files.record.SOURCES`."""
    return as_written(f"{facts['name']} ({facts['source']})")


def titles(facts):
    """Return {record: what `provenance` says of it}, of provenance files."""
    return {known["name"]: provenance(known) for known in map(read_json, facts)}


def origins(facts, width_in):
    """Where records of one or more provenance files come from, below a figure so wide [inch]."""
    paths = [facts] if isinstance(facts, str) else facts
    lines = sources([read_json(path) for path in paths])
    return "\n".join(_balanced(as_written(line), int(20 * width_in)) for line in lines)


def _balanced(text, most):
    """Break a text into lines of at most so many characters, as few as it takes and alike long."""
    few = textwrap.wrap(text, most, break_on_hyphens=False)
    for width in range(-(-len(text) // len(few)), most):
        lines = textwrap.wrap(text, width, break_on_hyphens=False)
        if len(lines) == len(few):
            return "\n".join(lines)
    return "\n".join(few)


def sources(facts):
    """Lines on the origin of records, one a kind of source, of what their provenance files hold.

    Station, event, component and file of up to `NAMED` records, of more their numbers; a record
    that several runs have is one.
    """
    lines = []
    facts = {(f["name"], f["source"], f["details"].get("sha256")): f for f in facts}.values()
    for source, words in SOURCES.items():
        mine = [f["details"] | {"name": f["name"]} for f in facts if f["source"] == source]
        if not mine:
            continue
        named = "; ".join(map(_origin, mine)) if len(mine) <= NAMED else _count(mine)
        lines.append(f"{words}: {named}{_licence(mine[0])}")
        if source == "surrogate":
            lines.append(SURROGATE_NOTE)
    return lines


def _about(details, key):
    """What the records table says of a record, else its file."""
    return details.get("about", {}).get(key, details.get(key))


def _origin(details):
    parts = [_about(details, key) for key in ("station", "event", "component")]
    parts.append(details.get("file"))
    known = ", ".join(str(part) for part in parts if part)
    return f"{details['name']} ({known})" if known else details["name"]


def _count(many):
    text = f"{len(many)} ({many[0]['name']} to {many[-1]['name']})"
    for key in ("station", "event"):
        different = {_about(details, key) for details in many} - {None}
        if different:
            text += f", {len(different)} {key}{'s' if len(different) > 1 else ''}"
    return text


def _licence(details):
    """Author, year and licence of shipped motions."""
    if "licence" not in details:
        return ""
    author = details["source"].partition(")")[0]
    return f". {author}), {details['licence'].partition(',')[0]}"
