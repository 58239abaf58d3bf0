"""The blocks of a report as pages of a PDF, drawn by matplotlib."""

import itertools
import textwrap
from typing import Any

import matplotlib.pyplot as plt
from matplotlib.backends.backend_pdf import PdfPages

from rocking.assessment.document import (
    MM,
    WIDTH_MM,
    Heading,
    List,
    PageBreak,
    Paragraph,
    Picture,
    Table,
)
from rocking.figures import style as _style  # noqa: F401  sets the project's type and lines

PAGE_MM = (210.0, 297.0)
MARGIN_MM = 18.0
TEXT_MM = PAGE_MM[0] - 2.0 * MARGIN_MM
SIZES = {1: 15.0, 2: 11.0, 3: 9.5}
BODY, SMALL = 8.5, 7.2
LEAD = 1.35  # of a line over the size of its type
ASCENT = 0.72  # of a line above the baseline
BOLD = 1.18  # of a bold character over a plain one
KEPT_MM = 150.0  # a table no higher than this goes to the next page whole
CHARACTER = 0.54  # mean width of a character over the size of its type


def _line_mm(size):
    return size * LEAD / 72.0 * 25.4


def _wrapped(text, size, width_mm=TEXT_MM):
    characters = max(4, int(width_mm / (CHARACTER * size / 72.0 * 25.4)))
    narrow = width_mm < 0.5 * TEXT_MM  # there alone words part at their hyphens
    return textwrap.wrap(text, characters, break_on_hyphens=narrow) or [""]


class _Pages:
    """Pages that fill from the top; a new one begins where a piece does not fit."""

    def __init__(self, pdf, foot, count=None):
        self.pdf, self.foot, self.count, self.number = pdf, foot, count, 0
        self.figure: Any = None
        self.left_mm = 0.0

    def need(self, height_mm):
        """Begin a page unless so much is left."""
        if self.figure is None or self.left_mm < height_mm:
            self.close()
            self.figure = plt.figure(
                figsize=(PAGE_MM[0] * MM, PAGE_MM[1] * MM), layout="constrained"
            )
            self.number += 1
            self.left_mm = PAGE_MM[1] - 2.0 * MARGIN_MM
            foot = f"{self.foot} · page {self.number} of {self.count}"
            self.figure.text(
                MARGIN_MM / PAGE_MM[0], 0.5 * MARGIN_MM / PAGE_MM[1], foot, size=6.5, color="0.3"
            )

    @property
    def top_mm(self):
        return MARGIN_MM + self.left_mm

    def text(self, words, size, x_mm=0.0, drop_mm=0.0, **style):
        self.figure.text(
            (MARGIN_MM + x_mm) / PAGE_MM[0],
            (self.top_mm - drop_mm - ASCENT * _line_mm(size)) / PAGE_MM[1],
            words,
            size=size,
            va="baseline",
            parse_math=False,
            **style,
        )

    def rule(self, drop_mm, weight=0.5, color="0.2"):
        y = (self.top_mm - drop_mm) / PAGE_MM[1]
        ends = [MARGIN_MM / PAGE_MM[0], 1.0 - MARGIN_MM / PAGE_MM[0]]
        self.figure.add_artist(plt.Line2D(ends, [y, y], lw=weight, color=color))

    def lines(self, text, size, after_mm=1.5, **style):
        """Text, line by line, over pages where it must."""
        bold = BOLD if style.get("weight") == "bold" else 1.0
        for line in _wrapped(text, size, TEXT_MM / bold):
            self.need(_line_mm(size))
            self.text(line, size, **style)
            self.left_mm -= _line_mm(size)
        self.left_mm -= after_mm

    def close(self):
        if self.figure is not None:
            if self.pdf is not None:
                self.pdf.savefig(self.figure)
            plt.close(self.figure)
        self.figure = None


def _heading(pages, block, after=None):
    """A heading, on one page with what comes after it."""
    size = SIZES[block.level]
    pages.need(_line_mm(size) + 5.0 + (_needed(after) if block.level > 1 else 0.0))
    pages.left_mm -= 3.0 * (block.level > 1)
    pages.lines(block.text, size, weight="bold")


def _needed(block):
    """Height that a block asks for at once [mm]."""
    if isinstance(block, Table):
        return _Laid(block).needed
    if isinstance(block, Picture):
        return block.height_mm + 10.0
    return 3.0 * _line_mm(BODY)


def _paragraph(pages, block):
    for line in block.text.split("\n"):
        pages.lines(line, BODY, after_mm=0.0, weight="bold" if block.strong else "normal")
    pages.left_mm -= 1.5


def _list(pages, block):
    for line in block.lines:
        for i, words in enumerate(_wrapped(line, BODY, TEXT_MM - 4.0)):
            pages.need(_line_mm(BODY))
            if i == 0:
                pages.text("–", BODY)
            pages.text(words, BODY, 4.0)
            pages.left_mm -= _line_mm(BODY)
    pages.left_mm -= 1.5


class _Laid:
    """A table's cells as lines, with the heights of its rows and what it asks for at once [mm]."""

    def __init__(self, table):
        self.widths = [TEXT_MM * w / sum(table.widths) for w in table.widths]
        self.starts = [sum(self.widths[:i]) for i in range(len(self.widths))]
        self.head = self._cells(table.columns) if any(table.columns) else None
        self.rows = [self._cells(words) for words in table.rows]
        self.caption = table.caption + (f" [{table.source}]" if table.source else "")
        heights = [self.height(row) for row in self.rows]
        above = self.height(self.head) if self.head else 0.0
        if self.caption:
            above += _line_mm(SMALL) * len(_wrapped(self.caption, SMALL)) + 0.5
        whole = above + sum(heights)
        self.needed = whole if whole <= KEPT_MM else above + sum(heights[:4])

    def _cells(self, words):
        pairs = zip(words, self.widths, strict=True)
        return [_wrapped(word, SMALL, width - 2.0) for word, width in pairs]

    @staticmethod
    def height(row):
        return _line_mm(SMALL) * max(map(len, row)) + 1.0


def _table(pages, table):
    laid = _Laid(table)

    def put(row, **style):
        for cell, x in zip(row, laid.starts, strict=True):
            for i, line in enumerate(cell):
                pages.text(line, SMALL, x, i * _line_mm(SMALL) + 0.6, **style)
        pages.left_mm -= laid.height(row)

    pages.need(laid.needed)
    if laid.caption:
        pages.lines(laid.caption, SMALL, after_mm=0.5, color="0.25")
    page = None
    for row in laid.rows:
        pages.need(laid.height(row))
        if laid.head and page != pages.number:  # again on every page that the table goes over to
            put(laid.head, weight="bold")
            pages.rule(0.0)
        page = pages.number
        put(row)
        pages.rule(0.0, 0.3, "0.8")
    pages.left_mm -= 3.0


def _picture(pages, picture):
    source = f" [{picture.source}]" if picture.source else ""
    caption = _wrapped(picture.caption + source, SMALL)
    pages.need(picture.height_mm + _line_mm(SMALL) * len(caption) + 3.0)
    if pages.pdf is not None:
        _place(pages, picture)
    pages.left_mm -= picture.height_mm
    pages.lines(picture.caption + source, SMALL, after_mm=3.0, color="0.25")


def _place(pages, picture):
    """Draw a picture into its part of the page."""
    above = PAGE_MM[1] - pages.top_mm
    rows = [above, picture.height_mm, PAGE_MM[1] - above - picture.height_mm]
    columns = [MARGIN_MM, WIDTH_MM, PAGE_MM[0] - MARGIN_MM - WIDTH_MM]
    grid = pages.figure.add_gridspec(3, 3, width_ratios=columns, height_ratios=rows)
    picture.draw(pages.figure.add_subfigure(grid[1, 1]))


def write(path, blocks, foot):
    """Write the blocks to a PDF without dates.

    Parameters
    ----------
    path : str
    blocks : list
        Of `document`.
    foot : str
        At the foot of every page, before its number.
    """
    draw = {Paragraph: _paragraph, Table: _table, Picture: _picture}
    draw |= {List: _list, PageBreak: lambda pages, _: pages.close()}

    def laid(pdf, count):
        pages = _Pages(pdf, foot, count)
        for block, after in itertools.zip_longest(blocks, blocks[1:]):
            if isinstance(block, Heading):
                _heading(pages, block, after)
            else:
                draw[type(block)](pages, block)
        pages.close()
        return pages.number

    count = laid(None, 0)  # once without drawing, for how many pages there are
    with PdfPages(path, metadata={"CreationDate": None, "Producer": None}) as pdf:
        laid(pdf, count)
