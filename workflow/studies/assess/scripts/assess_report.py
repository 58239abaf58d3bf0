"""The assessment of one façade: a page that opens offline, its PDF, and the evidence of both."""

import json
from importlib.metadata import version
from pathlib import Path

import yaml
from rocking.runtime.script import run
from rocking.tables import read_frame, read_tables, write_table
from rocking.version import code
from studies.assess import evidence, paper
from studies.assess.appendix import Data
from studies.assess.catalogue import catalogue
from studies.assess.report import context
from studies.assess.site import demand_said
from studies.assess.values import values


def main(job):
    p, config = job.params, json.loads(json.dumps(dict(job.params.config)))
    tables = {Path(str(path)).stem: read_frame(path) for path in job.input.tables}
    tables |= {"verdicts": read_tables(job.input.verdicts), "yade": read_tables(job.input.yade)}
    assessment = config["assessment"]
    write_table(values(config, list(p.given)), job.output.values, ["key", "value", "standing"])
    program = f"rocking-facades {version('rocking-facades')}"
    data = Data(
        config,
        list(p.given),
        tables,
        p.run,
        demand_said(assessment, job.input.site, catalogue(assessment["language"])),
        program,
        p.commit[:12] + "+" * p.commit.endswith("+"),
        f"results/{p.run}/assessment",
    )
    drawn = {name: version(name) for name in ("matplotlib", "numpy", "weasyprint")}
    facts = {"program": program, "commit": p.commit, "code_sha256": code(), "packages": drawn}
    texts = {
        "config.yaml": yaml.safe_dump(config, sort_keys=False, allow_unicode=True, width=100),
        "version.json": json.dumps(facts, indent=1) + "\n",
        evidence.MOTIONS: evidence.sums_of_paths(job.input.records),
    }
    given = [*job.input.site, job.input.table]
    made = [*job.input.tables, *job.input.verdicts, *job.input.yade, job.output.values]
    files = evidence.gathered([*given, *made, job.input.ties], texts)
    text = paper.page(context(data, evidence.digest_of(files)))
    Path(job.output.html).write_text(text, encoding="utf-8")
    paper.write_pdf(job.output.pdf, text)
    folder = Path(job.output.html).parent / "evidence"
    print(evidence.keep(folder, files, [job.output.html, job.output.pdf]))


run(main, globals())
