"""A figure of a study, as its module draws it from tables.

`params.study` names the module of `rocking.studies`, `params.draw` its function, which takes the
tables under the names that they have in the rule's input.
"""

from importlib import import_module

import pandas as pd
from rocking.figures import style
from rocking.runtime.script import run

NO_TABLES = ("facts", "modules")


def main(job):
    study = import_module(f"rocking.studies.{job.params.study}")
    paths = {name: path for name, path in job.input.items() if name not in NO_TABLES}
    draw = getattr(study, job.params.get("draw", "draw"))
    figure = draw(**{name: pd.read_csv(path) for name, path in paths.items()})
    style.save(figure, job.output, job.input.facts)


run(main, globals())
