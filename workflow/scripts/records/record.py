"""Read or generate one accelerogram and write it in the workflow's own form."""

from rocking.records import load, write_csv
from rocking.runtime.script import run


def main(job):
    p = job.params
    record = load(job.wildcards.record, p.table, **p.how)
    write_csv(record, job.output.record)


run(main, globals())
