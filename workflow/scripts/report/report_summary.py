"""The answer of a run on one page: façade, records, Figure 9, collapse table, what to trust.

Written twice: as a page of the report, and as reStructuredText that the report begins with. How far
each record was scaled goes into `tables/scale_factors.csv`; factors above LARGE_FACTOR are warned
of.
"""

import base64
import html
import sys
from pathlib import Path

from rocking.collapse.cautions import BANDS, LARGE_FACTOR, cautions, scale_factors
from rocking.report_pages import page, result_table
from rocking.runtime.script import run
from rocking.tables import read_frame, read_tables, write_table

SHOWN = ("model", "record", "direction", "pga_safe_g", "safe_bound", "pga_collapse_g")
SHOWN += ("collapse_fell", "collapse_realisations")
BEHIND = ("runs_yade", "runs_planar")  # runs that stand behind a row


def content(p, records, runs, collapse, factors, figure):
    """Body of the page."""
    # in short lines, which reStructuredText asks for and a browser joins again
    data = base64.encodebytes(Path(figure).read_bytes()).decode()
    columns = [name for name in (*SHOWN, *BANDS, *BEHIND) if name in collapse]
    table = result_table(collapse[columns].dropna(axis=1, how="all"))
    motions = ", ".join(
        f"{row.record} ({row.source}, {row.pga_g:.2g} g)" for row in records.itertuples()
    )
    points = "".join(
        f"<li>{html.escape(text)}</li>" for text in cautions(records, runs, collapse, factors)
    )
    return (
        f"<p><b>Façade:</b> {html.escape(p.facade.words)}.<br>"
        f"<b>Return walls:</b> {html.escape('; '.join(p.models))}.<br>"
        f"<b>Records:</b> {html.escape(motions)}.</p>\n"
        f'<p><img alt="Figure 9" src="data:image/png;base64,{data}"></p>\n'
        f"<h2>At what shaking it falls</h2>\n{table}\n"
        f"<h2>What to trust</h2>\n<ul>{points}</ul>\n"
    )


def main(job):
    p = job.params
    records, collapse = read_frame(job.input.records), read_frame(job.input.collapse)
    runs = read_tables(job.input.ida)
    factors = scale_factors(records, runs, collapse)
    write_table(factors, job.output.factors, digits="%.4g")
    for row in factors[factors["scale_factor"] > LARGE_FACTOR].itertuples():
        print(
            f"warning: record {row.record} is scaled to {row.scale_factor:.1f} times its own peak,"
            f" above {LARGE_FACTOR:g}",
            file=sys.stderr,
        )
    body = content(p, records, runs, collapse, factors, job.input.figure)
    title = f"Run {job.wildcards.run}: at what shaking the façade falls"
    Path(job.output.page).write_text(page(title, "", body, job.input.style), encoding="utf-8")
    inside = f"<h1>{html.escape(title)}</h1>\n{body}"
    lines = "\n".join(f"   {line}" for line in inside.splitlines())
    Path(job.output.first).write_text(f".. raw:: html\n\n{lines}\n\n", encoding="utf-8")


run(main, globals())
