"""Collapse of a model under one record, one assumption after the other at another level."""

from rocking import Case, Motion
from rocking.records import read_csv
from rocking.records.table import read_table
from rocking.runtime.script import run
from rocking.tables import read_json, write_table
from studies.assumptions.study import CAPACITY, collapse

COLUMNS = ["model", "record", "direction", "assumption", "level", *CAPACITY, "runs_planar"]


def main(job):
    p, record = job.params, read_csv(job.input.record)
    stage = read_json(str(job.input.stage)) if job.input.stage else None
    row = read_table(p.surrogates_table).get(record.name)
    known = record.source != "surrogate" and row is not None and row.path is None
    surrogate = {"table": p.surrogates_table, "seed": p.seed} if known else None
    given = Case.read(job.input.case), Motion(record), p.directions, stage
    table = collapse(*given, job.input.law, surrogate, p.hazard_slope)
    write_table(table, job.output[0], COLUMNS)


run(main, globals())
