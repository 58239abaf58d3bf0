"""The report on paper and on a screen: one page of HTML from a template, and the PDF of it.

Style and pictures are inside the page, so it opens without a network; its print rules make the
PDF, with bookmarks, title and author, as PDF/A-3u, whose text can be searched and copied.
"""

import base64
import io
import os
import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import jinja2
import matplotlib.pyplot as plt
from markupsafe import Markup, escape
from matplotlib.ticker import Formatter
from rocking.figures import style

from studies.assess.catalogue import SAY

TEMPLATES = Path(__file__).parent / "templates"
VARIANT = "pdf/a-3u"
DATE = "SOURCE_DATE_EPOCH"  # of fonts, as fontTools reads it
MM = 1.0 / 25.4  # inches
WIDTH_MM = 120.0  # of a picture: readable at a phone's width too
NUMBER = re.compile(r"[<>]?[−-]?[0-9.,]+(e-?[0-9]+)?( ?[%A-Za-zα/²³]{1,5})?|–")
FIGURES = re.compile(r"[−+-]?[0-9.,]+")
TEXT: dict[Any, Any] = {  # of pictures: text stays text, of the size of captions
    "svg.fonttype": "none",
    "svg.hashsalt": "report",
    "font.family": "DejaVu Sans",
    "font.size": 7.0,
    "axes.linewidth": 0.6,
    "lines.linewidth": 1.2,
}
WHOLE = 24  # rows of a table that is not parted between pages


@dataclass(frozen=True)
class Table:
    """Rows of words under column names, with the file that the numbers stand in."""

    caption: str
    columns: tuple  # all empty: no head
    rows: list  # of tuples of words
    widths: tuple  # shares of the width
    source: str = ""
    strong: tuple = ()  # numbers of rows set apart, as what governs


@dataclass(frozen=True)
class Picture:
    """Picture with its caption and its text alternative."""

    draw: Callable  # into a figure
    height_mm: float
    caption: str
    words: str  # the text alternative
    source: str = ""
    wide_mm: float = WIDTH_MM


def broken(text):
    """Escaped text that may break after the signs within names and paths."""
    return Markup(re.sub(r"([_./])(?=[a-z]{2})", r"\1<wbr>", str(escape(text))))


def kind(word):
    """Class of a cell: a number keeps together and stands in columns."""
    return "number" if NUMBER.fullmatch(str(word)) else "words"


class Marked(Formatter):
    """Numbers of an axis as another formatter writes them, with a language's decimal mark."""

    def __init__(self, formatter, marks):
        """Keep the other formatter, and the table for `str.translate`."""
        self.formatter, self.marks = formatter, marks

    def set_axis(self, axis):
        """Tell the other formatter its axis."""
        super().set_axis(axis)
        self.formatter.set_axis(axis)

    def __call__(self, value, pos=None):
        """One number."""
        return self._marked(self.formatter(value, pos))

    def format_ticks(self, values):
        """All of them."""
        return [self._marked(text) for text in self.formatter.format_ticks(values)]

    def get_offset(self):
        """Power of ten beside the axis."""
        return self._marked(self.formatter.get_offset())

    def _marked(self, text):
        """A number's text; words stay as they are."""
        return text.translate(self.marks) if FIGURES.fullmatch(text) else text


def image(picture, say=SAY):
    """Address of a picture as SVG that carries its text as text, numbers as the language does."""
    with plt.rc_context(TEXT):
        size = picture.wide_mm * MM, picture.height_mm * MM
        figure = plt.figure(figsize=size, layout="constrained")
        picture.draw(figure)
        for axes in figure.axes if say.marks else ():
            for axis in (axes.xaxis, axes.yaxis):
                axis.set_major_formatter(Marked(axis.get_major_formatter(), say.marks))
        style.settle_math(figure)
        data = io.BytesIO()
        figure.savefig(data, format="svg", metadata={"Date": None, "Creator": None})
        plt.close(figure)
    return f"data:image/svg+xml;base64,{base64.b64encode(data.getvalue()).decode()}"


def page(context):
    """The report as one HTML page: style and pictures inside, no script, nothing fetched.

    `context` is what the template shows.
    """
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(TEMPLATES),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    say = context["say"]
    environment.filters |= {"broken": broken, "image": partial(image, say=say)}
    environment.globals |= {"kind": kind, "WHOLE": WHOLE}
    return environment.get_template("report.html.j2").render(**context)


def write_pdf(path, text):
    """Write a page as PDF/A, by its print rules; nothing is fetched, and no clock is read."""
    import weasyprint  # loads Pango, which no other part of the project needs

    alone = weasyprint.URLFetcher(allowed_protocols=["data"], fail_on_errors=True)
    document = weasyprint.HTML(string=text, url_fetcher=alone)
    dated = os.environ.get(DATE)
    os.environ[DATE] = dated or "0"  # else every font has the second in which it was cut out
    try:
        document.write_pdf(str(path), pdf_variant=VARIANT, pdf_identifier=b"report")
    except weasyprint.urls.FatalURLFetchingError as error:
        said = str(error)[:80]
        raise ValueError(f"report: {said}: expected a page that holds all it shows") from None
    finally:
        if dated is None:
            del os.environ[DATE]
