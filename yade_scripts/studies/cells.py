"""Entry point: one cell of a design, a scene under a motion at stated amplitudes.

python3 yade_scripts cells --cells uncertainty/cells.json --cell cell3 --output cell3.csv
"""

import argparse

import numpy as np

from yade_scripts.engine import adapter
from yade_scripts.files import read_json, write_atomic
from yade_scripts.model import models
from yade_scripts.model.motion import amplitude
from yade_scripts.studies import shaking
from yade_scripts.studies.ida import COLUMNS
from yade_scripts.studies.tables import run_row, to_csv


def main(arguments=None):
    """Parse the command line, run the cell, write the table; return the exit status."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cells", required=True, help="cells by name (JSON)")
    parser.add_argument("--cell", required=True)
    parser.add_argument("--output", required=True, help="table to write (CSV)")
    args = parser.parse_args(arguments)
    cells = read_json(args.cells)
    if args.cell not in cells:
        raise ValueError(f"{args.cells}: no {args.cell}; expected one of {', '.join(cells)}")
    cell = cells[args.cell]
    job, time_s = cell["scene"], np.array(cell["time_s"])
    columns = {name: np.array(values) for name, values in cell["columns"].items()}
    adapter.load_yade()
    scene, numerics = models.build_scene(job), models.numerics(job)
    rows = []
    for pga_g in cell["pga_g"]:
        factor = amplitude(columns["ground"], cell["direction"], pga_g)
        history = shaking.prepare(scene, numerics, time_s, columns, factor).retried()
        rows.append(run_row(job["model"], cell["record"], cell["direction"], pga_g, history))
    write_atomic(args.output, to_csv(rows, COLUMNS))
    return 0
