"""Entry point: one cell of a design, a scene under a motion at stated amplitudes.

python3 yade_scripts cells --cells uncertainty/cells.json --cell cell3 --output cell3.csv
"""

import numpy as np

from yade_scripts.engine import adapter
from yade_scripts.files import read_json, write_atomic
from yade_scripts.model import models
from yade_scripts.studies import command
from yade_scripts.studies.ida import COLUMNS
from yade_scripts.studies.shaking import run_at
from yade_scripts.studies.tables import to_csv


def main(arguments=None):
    """Parse the command line, run the cell, write the table; return the exit status."""
    texts = {"cells": "cells by name (JSON)", "cell": "name", "output": "table to write (CSV)"}
    args = command.parser(__doc__, **texts).parse_args(arguments)
    cells = read_json(args.cells)
    if args.cell not in cells:
        raise ValueError(f"{args.cells}: no {args.cell}; expected one of {', '.join(cells)}")
    cell = cells[args.cell]
    job, time_s = cell["scene"], np.array(cell["time_s"])
    columns = {name: np.array(values) for name, values in cell["columns"].items()}
    adapter.load_yade()
    scene, numerics = models.build_scene(job), models.numerics(job)
    names = job["model"], cell["record"], cell["direction"]
    rows = [run_at(scene, numerics, time_s, columns, names, g)[0] for g in cell["pga_g"]]
    write_atomic(args.output, to_csv(rows, COLUMNS))
    return 0
