"""Where every record of a run comes from: a file and its checksum, or a surrogate's parameters."""

import html
from pathlib import Path

from rocking.report_pages import page, table_of
from rocking.runtime.script import run
from rocking.tables import read_json

HEADS = ("record", "source", "stands for", "step [s]", "units read", "baseline", "details")
KINDS = ("short", "short", "words", "number", "short", "words", "words")


def listed(values):
    """Names and values, a line each."""
    lines = []
    for name, value in sorted(values.items()):
        shown = f"{value:.6g}" if isinstance(value, float) else str(value)
        lines.append(f"{html.escape(str(name))}: {html.escape(shown)}")
    return "<br>".join(lines)


def main(job):
    rows = []
    for path in job.input.facts:
        facts = read_json(path)
        about = facts["details"].pop("about", {})
        event = ", ".join(str(about[k]) for k in ("event", "station") if k in about)
        if "mw" in about:
            event += f", Mw {about['mw']:g}"
        cells = [
            html.escape(facts["name"]),
            facts["source"],
            html.escape(event),
            f"{facts['dt_s']:g}",
            html.escape(facts["units_read"]),
            html.escape(facts["baseline"]),
            listed(facts["details"]),
        ]
        rows.append(cells)
    text = (
        f"Records table: {job.params.table}. A surrogate has the peaks and duration of the motion"
        " it stands for and is not that motion; its details are the solved parameters and the seed."
    )
    whole = page("Provenance of every record", text, table_of(HEADS, KINDS, rows), job.input.style)
    Path(job.output[0]).write_text(whole, encoding="utf-8")


run(main, globals())
