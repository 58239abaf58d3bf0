"""One table of results as a page of the report, with its text and the CSV to download."""

import base64
from pathlib import Path

from rocking.report_pages import is_study, page, result_table
from rocking.runtime.script import run
from rocking.tables import read_frame


def main(job):
    source = Path(job.input.table)
    table = read_frame(source)
    data = base64.b64encode(source.read_bytes()).decode()
    link = (
        f'<p><a download="{source.name}" href="data:text/csv;base64,{data}">{source.name}</a></p>'
    )
    title, text = job.params.title, job.params.text
    if any(is_study(name) for name in table.columns):
        text += " The study's own values are shaded."
    Path(job.output[0]).write_text(
        page(title[:1].upper() + title[1:], text, result_table(table) + link, job.input.style),
        encoding="utf-8",
    )


run(main, globals())
