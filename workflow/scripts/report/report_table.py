"""One table of results as a page of the report, with its text and the CSV to download."""

import base64
import html
import re
from pathlib import Path

import pandas as pd
from rocking.configuration.words import heading
from rocking.records.intensity_measures import MEASURES
from rocking.runtime.script import run


def is_study(column):
    """Tell whether a column holds the study's own values."""
    return bool(re.search(r"(^|_)(paper|eq5)(_|$)", column))


def cell(value):
    """Text of a cell; blank where there is no value."""
    if pd.isna(value):
        return ""
    if value in MEASURES:
        return html.escape(MEASURES[value].label)
    if isinstance(value, float):
        return f"{value:.4g}" if abs(value) < 1e5 else f"{value:.3e}"
    return html.escape(str(value))


def kind(name, column):
    """Classes of a column's cells, for the style sheet."""
    if pd.api.types.is_numeric_dtype(column):
        words = "number"
    else:
        words = "words" if column.astype(str).str.len().max() > 40 else "short"
    return f"{words} study" if is_study(name) else words


def rows(table):
    """Head and body of a table."""
    kinds = {name: kind(name, table[name]) for name in table.columns}
    head = "".join(f'<th class="{kinds[n]}">{html.escape(heading(n))}</th>' for n in table.columns)
    body = "\n".join(
        "<tr>"
        + "".join(f'<td class="{kinds[n]}">{cell(row[n])}</td>' for n in table.columns)
        + "</tr>"
        for row in table.to_dict("records")
    )
    return f"<table>\n<thead><tr>{head}</tr></thead>\n<tbody>\n{body}\n</tbody>\n</table>"


def page(title, text, content, style):
    """A whole page that needs no other file."""
    words = f"<p>{html.escape(text, quote=False)}</p>\n" if text else ""
    return (
        f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{html.escape(title)}'
        f"</title><style>\n{Path(style).read_text()}</style></head>\n<body>\n"
        f"<h1>{html.escape(title)}</h1>\n{words}{content}\n"
        "</body></html>\n"
    )


def main(job):
    source = Path(job.input.table)
    table = pd.read_csv(source)
    data = base64.b64encode(source.read_bytes()).decode()
    link = (
        f'<p><a download="{source.name}" href="data:text/csv;base64,{data}">{source.name}</a></p>'
    )
    title, text = job.params.title, job.params.text
    if any(is_study(name) for name in table.columns):
        text += " The study's own values are shaded."
    Path(job.output[0]).write_text(
        page(title[:1].upper() + title[1:], text, rows(table) + link, job.input.style)
    )


if __name__ == "__main__" or "snakemake" in globals():
    run(main, globals())
