"""The assessment of one façade as a page that opens offline and as a PDF."""

import json
from importlib.metadata import version
from pathlib import Path

import pandas as pd
from rocking.assessment import pages
from rocking.assessment.appendix import Data, provenance
from rocking.assessment.content import blocks
from rocking.assessment.document import page
from rocking.assessment.site import demand_said
from rocking.assessment.values import values
from rocking.runtime.script import run
from rocking.tables import read_tables, write_table


def main(job):
    p, config = job.params, json.loads(json.dumps(dict(job.params.config)))
    tables = {Path(str(path)).stem: pd.read_csv(path) for path in job.input.tables}
    tables |= {"verdicts": read_tables(job.input.verdicts), "yade": read_tables(job.input.yade)}
    given = [*job.input.site, job.input.table]
    made = [*job.input.tables, *job.input.verdicts, *job.input.yade]
    data = Data(
        config,
        list(p.given),
        tables,
        demand_said(config["assessment"], job.input.site),
        f"rocking-facades {version('rocking-facades')}",
        p.commit[:12],
        provenance(given, made, p.stations, p.table, p.run, config["seed"], tables["dynamic"]),
    )
    body = blocks(data, f"results/{p.run}/assessment")
    Path(job.output.html).write_text(page(body), encoding="utf-8")
    pages.write(job.output.pdf, body, config["assessment"]["title"] or p.run)
    write_table(values(config, data.given), job.output.values, ["key", "value", "standing"])


run(main, globals())
