"""The answer of a run on one page: façade, records, Figure 9, collapse table, what to trust.

Written twice: as a page of the report, and as reStructuredText that the report begins with. How far
each record was scaled goes into `tables/scale_factors.csv`; factors above LARGE_FACTOR are warned
of.
"""

import base64
import html
import sys
from pathlib import Path

import pandas as pd
from report_table import page, rows
from rocking.runtime.script import run
from rocking.tables import read_tables, write_table

LARGE_FACTOR = 5.0  # beyond it a scaled record is hardly a stronger earthquake's motion
SHOWN = ("model", "record", "direction", "pga_safe_g", "safe_bound", "pga_collapse_g")
SHOWN += ("collapse_fell", "collapse_realisations")
BANDS = ("pga_median_g", "pga_p10_g", "pga_p90_g")
BEHIND = ("runs_yade", "runs_planar")  # runs that stand behind a row


def scale_factors(records, runs, collapse):
    """Largest intensity of every record's runs over its own peak.

    Of a record that YADE does not confirm: from where its scans collapse throughout, or to where
    they went.
    """
    table = records[["record", "pga_g"]]
    largest = runs.groupby("record")["pga_g"].max()
    scanned = collapse["pga_all_g"].fillna(collapse["pga_max_g"]).groupby(collapse["record"]).max()
    found = table["record"].map(largest).fillna(table["record"].map(scanned))
    return table.assign(pga_largest_g=found, scale_factor=found / table["pga_g"])


def cautions(records, runs, collapse, factors):
    """What to bear in mind, a sentence each."""
    said = []
    surrogates = int((records["source"] == "surrogate").sum())
    if surrogates:
        said.append(
            f"{surrogates} of {len(records)} records are surrogates: they have the peaks of the "
            "motion that they are called after, not its pulses, which decide one-sided rocking."
        )
    far = factors[factors["scale_factor"] > LARGE_FACTOR]
    if len(far):
        names = ", ".join(f"{row.record} ({row.scale_factor:.1f})" for row in far.itertuples())
        said.append(f"Scaled to more than {LARGE_FACTOR:g} times their own peak: {names}.")
    failed = int((runs["status"] == "failed").sum())
    if failed:
        said.append(f"{failed} of {len(runs)} runs failed numerically and count for nothing.")
    never = int(collapse["pga_collapse_g"].isna().sum())
    if never:
        said.append(f"{never} of {len(collapse)} curves never collapsed: blank, not strong.")
    if "collapse_fell" in collapse:
        alone = collapse["collapse_fell"] == 1
        if alone.any():
            said.append(
                f"The lowest collapse of {int(alone.sum())} of {len(collapse)} curves is that of "
                "one history alone; see there the PGA at which a tenth falls."
            )
        hidden = collapse["safe_bound"].max()
        if hidden > 0.0:
            said.append(
                f"Where a curve is called safe, up to {100.0 * hidden:.0f} % may still collapse "
                "within 1 % of some amplitude (95 % confidence)."
            )
    if "disagreements" in collapse and (odd := int(collapse["disagreements"].sum())):
        said.append(f"At {odd} intensities YADE and the planar solver disagree on the collapse.")
    if set(BANDS[1:]) <= set(collapse):
        wide = collapse["pga_p90_g"] > 1.1 * collapse["pga_p10_g"]
        if wide.any():
            said.append(
                f"{int(wide.sum())} of {len(collapse)} curves have no single collapse intensity: "
                "slightly different histories fall or stand over more than a tenth; use the band."
            )
    said.append(
        "The band is numerical scatter of one façade under one motion, not that of earthquakes "
        "or materials; stand and fall of single runs near it mean little."
    )
    return said


def content(p, records, runs, collapse, factors, figure):
    """Body of the page."""
    # in short lines, which reStructuredText asks for and a browser joins again
    data = base64.encodebytes(Path(figure).read_bytes()).decode()
    columns = [name for name in (*SHOWN, *BANDS, *BEHIND) if name in collapse]
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
        f"<h2>At what shaking it falls</h2>\n{rows(collapse[columns].dropna(axis=1, how='all'))}\n"
        f"<h2>What to trust</h2>\n<ul>{points}</ul>\n"
    )


def main(job):
    p = job.params
    records, collapse = pd.read_csv(job.input.records), pd.read_csv(job.input.collapse)
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
    Path(job.output.page).write_text(page(title, "", body, job.input.style))
    inside = f"<h1>{html.escape(title)}</h1>\n{body}"
    lines = "\n".join(f"   {line}" for line in inside.splitlines())
    Path(job.output.first).write_text(f".. raw:: html\n\n{lines}\n\n")


run(main, globals())
