"""A figure of a study, as its `figure.py` draws it from tables.

`params.study` names the folder of the study. Its function `draw` takes what the rule's inputs hold,
under their names: a table (CSV) or values (JSON), of several files a list.
"""

from importlib import import_module

from rocking.figures import style
from rocking.runtime.script import run
from rocking.tables import read_frame, read_json

NOT_DRAWN = ("facts", "modules")


def read(given):
    if not isinstance(given, str):
        return [read(path) for path in given]
    return read_json(given) if given.endswith(".json") else read_frame(given)


def main(job):
    study = import_module(f"studies.{job.params.study}.figure")
    inputs = {name: read(given) for name, given in job.input.items() if name not in NOT_DRAWN}
    style.save(study.draw(**inputs), job.output, job.input.facts)


run(main, globals())
