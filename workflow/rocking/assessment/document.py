"""A short report as blocks, and its page for a browser: one file that needs nothing else.

Blocks are headings, paragraphs, tables and pictures; a picture is a function that draws into a
matplotlib figure of a given size, with a text that stands for it. `pages` writes the same blocks
as a PDF.
"""

import base64
import html
import io
import re
from collections.abc import Callable
from dataclasses import dataclass

import matplotlib.pyplot as plt

MM = 1.0 / 25.4  # inches
WIDTH_MM = 120.0  # of a picture: readable at a phone's width too


@dataclass(frozen=True)
class Heading:
    """Heading; level 1 is the title."""

    text: str
    level: int = 2


@dataclass(frozen=True)
class Paragraph:
    """Lines of text; `strong` sets them apart, as the answer."""

    text: str
    strong: bool = False


@dataclass(frozen=True)
class List:
    """Lines with a mark before each."""

    lines: list


@dataclass(frozen=True)
class PageBreak:
    """What follows begins a page, on paper."""


@dataclass(frozen=True)
class Table:
    """Rows of words under column names, with the file that the numbers stand in.

    Without column names no head is drawn.

    Attributes
    ----------
    caption : str
    columns : tuple of str
    rows : list of tuple of str
    widths : tuple of float
        Shares of the width.
    source : str
        File.
    """

    caption: str
    columns: tuple
    rows: list
    widths: tuple
    source: str


@dataclass(frozen=True)
class Picture:
    """Picture with its caption and its text alternative.

    Attributes
    ----------
    draw : callable
        Draws into a figure or subfigure.
    height_mm : float
    caption, words, source : str
    """

    draw: Callable
    height_mm: float
    caption: str
    words: str
    source: str


STYLE = """
:root { color-scheme: light; }
body { font: 16px/1.45 system-ui, sans-serif; color: #111; margin: 0 auto; max-width: 52rem;
  padding: 1rem; }
h1 { font-size: 1.5rem; line-height: 1.2; } h2 { font-size: 1.15rem; margin-top: 2rem;
  border-bottom: 1px solid #888; }
p.answer { border: 2px solid #111; padding: .6rem .8rem; }
figure { margin: 1rem 0; }
figure img { width: 100%; max-width: 38rem; height: auto; display: block; }
figcaption, caption { font-size: .85rem; color: #333; text-align: left; padding: .2rem 0; }
.wide { overflow-x: auto; margin: 1rem 0; }
table { border-collapse: collapse; width: 100%; font-size: .85rem; }
th, td { text-align: left; vertical-align: top; padding: .2rem .5rem .2rem 0;
  border-bottom: 1px solid #ccc; overflow-wrap: break-word; }
th { border-bottom: 1.5px solid #111; overflow-wrap: normal; }
td.number { font-variant-numeric: tabular-nums; white-space: nowrap; }
code, .source { font-size: .75rem; color: #444; overflow-wrap: anywhere; }
@media (max-width: 30rem) { body { font-size: 15px; padding: .6rem; } table { font-size: .75rem; }
  th, td { padding-right: .3rem; } }
ul { padding-left: 1.2rem; margin: .3rem 0; }
@media print { @page { size: A4; margin: 16mm;
  @bottom-right { content: "page " counter(page) " of " counter(pages); font-size: 8pt; } }
  .break { break-after: page; }
  body { max-width: none; padding: 0; font-size: 10pt; }
  figure, tr, .wide { break-inside: avoid; } h2 { break-after: avoid; }
  figure img { max-width: 120mm; }
  .wide { overflow: visible; } }
"""


NUMBER = re.compile(r"[−-]?[0-9.]+(e-?[0-9]+)?( ?[%A-Za-zα/²³]{1,5})?|–")


def _words(text):
    """Escaped text that may break after the signs within names and paths."""
    return re.sub(r"([_./])(?=[a-z]{2})", r"\1<wbr>", html.escape(text))


def _image(picture):
    figure = plt.figure(figsize=(WIDTH_MM * MM, picture.height_mm * MM))
    picture.draw(figure)
    data = io.BytesIO()
    figure.savefig(data, format="svg", metadata={"Date": None, "Creator": None})
    plt.close(figure)
    code = base64.b64encode(data.getvalue()).decode()
    caption = html.escape(picture.caption) + _source(picture.source)
    return (
        f'<figure><img alt="{html.escape(picture.words)}"'
        f' src="data:image/svg+xml;base64,{code}">'
        f"<figcaption>{caption}</figcaption></figure>"
    )


def _source(path):
    return f' <span class="source">[{_words(path)}]</span>' if path else ""


def _table(table):
    head = "".join(f'<th scope="col">{html.escape(c)}</th>' for c in table.columns)
    head = f"<thead><tr>{head}</tr></thead>" if any(table.columns) else ""
    body = []
    for row in table.rows:
        cells = [
            f'<td class="{"number" if NUMBER.fullmatch(word) else "words"}">{_words(word)}</td>'
            for word in row
        ]
        body.append("<tr>" + "".join(cells) + "</tr>")
    groups = "".join(f'<col style="width:{100 * w:g}%">' for w in table.widths)
    return (
        f'<div class="wide" tabindex="0" role="region" aria-label="{html.escape(table.caption)}">'
        f"<table><caption>{html.escape(table.caption)}{_source(table.source)}</caption>"
        f"<colgroup>{groups}</colgroup>{head}\n<tbody>" + "\n".join(body) + "</tbody></table></div>"
    )


def page(blocks):
    """The blocks as one HTML page: style and pictures inside, no script, nothing fetched.

    Returns
    -------
    str
    """
    parts = []
    for block in blocks:
        if isinstance(block, Heading):
            parts.append(f"<h{block.level}>{html.escape(block.text)}</h{block.level}>")
        elif isinstance(block, Paragraph):
            kind = ' class="answer"' if block.strong else ""
            text = "<br>\n".join(html.escape(line) for line in block.text.split("\n"))
            parts.append(f"<p{kind}>{text}</p>")
        elif isinstance(block, List):
            lines = "".join(f"<li>{html.escape(line)}</li>" for line in block.lines)
            parts.append(f"<ul>{lines}</ul>")
        elif isinstance(block, PageBreak):
            parts.append('<div class="break"></div>')
        elif isinstance(block, Table):
            parts.append(_table(block))
        else:
            parts.append(_image(block))
    title = next(b.text for b in blocks if isinstance(b, Heading))
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>{html.escape(title)}</title><style>{STYLE}</style></head>\n<body><main>\n"
        + "\n".join(parts)
        + "\n</main></body></html>\n"
    )
