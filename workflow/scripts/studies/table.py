"""All curves of a study in one table, and what its module makes of them.

`params.study` names the folder of the study, `params.digits` the form of numbers. An output beside
`table` is named like the function of the module that makes it, such as `summary`: of the table, or
without one of nothing.
"""

from importlib import import_module

from rocking.runtime.script import run
from rocking.tables import read_tables, write_table


def main(job):
    study = import_module(f"studies.{job.params.study}.study")
    given = [read_tables(tables)] if (tables := job.input.get("tables")) else []
    for name, path in job.output.items():
        made = given[0] if name == "table" else getattr(study, name)(*given)
        write_table(made, path, digits=job.params.digits)


run(main, globals())
