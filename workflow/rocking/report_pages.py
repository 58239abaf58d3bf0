"""Pages of Snakemake's report: tables in readable form that need no other file."""

import html
import re
from pathlib import Path

import pandas as pd

from rocking.configuration.words import heading
from rocking.records.intensity_measures import MEASURES


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


def table_of(heads, kinds, rows):
    """Head and body of a table: words of the head, classes of its columns, escaped cells by row."""
    head = "".join(f'<th class="{k}">{h}</th>' for k, h in zip(kinds, heads, strict=True))
    body = "\n".join(
        "<tr>"
        + "".join(f'<td class="{k}">{c}</td>' for k, c in zip(kinds, row, strict=True))
        + "</tr>"
        for row in rows
    )
    return f"<table>\n<thead><tr>{head}</tr></thead>\n<tbody>\n{body}\n</tbody>\n</table>"


def result_table(table):
    """A table of results, its columns in words with their units."""
    kinds = [kind(name, table[name]) for name in table.columns]
    rows = ([cell(row[name]) for name in table.columns] for row in table.to_dict("records"))
    return table_of([html.escape(heading(name)) for name in table.columns], kinds, rows)


def page(title, text, content, style):
    """A whole page that needs no other file."""
    words = f"<p>{html.escape(text, quote=False)}</p>\n" if text else ""
    return (
        f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{html.escape(title)}'
        f"</title><style>\n{Path(style).read_text(encoding='utf-8')}</style></head>\n<body>\n"
        f"<h1>{html.escape(title)}</h1>\n{words}{content}\n"
        "</body></html>\n"
    )
