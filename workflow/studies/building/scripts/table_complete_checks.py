"""The complete building below uplift against its modes: periods with and without façade, answer.

The bonded form is linear until a bond breaks. Its period is that of the top floor's ringing after a
push, from the zero crossings; the modal one that of the largest effective mass along y.
"""

from pathlib import Path

import numpy as np
from rocking.runtime.script import run
from rocking.tables import read_frame, read_json, write_table
from studies.building.complete import linear_history
from studies.building.explicit import ringing_period
from studies.building.modes import Solver
from studies.building.yade.complete import apart

from yade_scripts.model import floor_motions
from yade_scripts.model.motion import amplitude
from yade_scripts.model.scene import from_dict

MODES = 12


def main(job):
    rows = []

    def add(check, coarsening, explicit, modal, unit):
        rows.append((check, coarsening, explicit, modal, unit, abs(explicit / modal - 1.0)))

    scenes = [from_dict(read_json(p)["scene"]) for p in job.input.scene]
    for scene in scenes:
        for name, solved in (("with façade", scene), ("without façade", apart(scene))):
            modes = Solver(solved).modes(MODES)
            period = float(modes.period_s[modes.largest("y")])
            rows.append((f"period {name}", scene.notes["coarsening"], np.nan, period, "s", np.nan))
    coarsest = Path(job.input.linear[0]).name.split("_")[1]
    scene = next(s for s in scenes if f"{s.notes['coarsening']:g}" == coarsest)
    size = scene.notes["coarsening"]
    for name, path in (
        ("with façade", job.input.ring[0]),
        ("without façade", job.input.apart[0]),
    ):
        table = read_frame(path)
        got = ringing_period(table["time_s"].to_numpy(), table["top_m"].to_numpy())
        place = next(i for i, r in enumerate(rows) if r[:2] == (f"period {name}", size))
        modal = rows[place][3]
        rows[place] = (f"period {name}", size, got, modal, "s", abs(got / modal - 1.0))
    table = read_frame(job.input.linear[0])
    time_s, columns = floor_motions.read(job.input.motion)
    factor = amplitude(columns["ground"], job.params.direction, job.params.pga_g)
    kept = time_s <= table["time_s"].iloc[-1] + 0.05
    points = [scene.index(scene.notes["top"]), scene.index(scene.monitor)]
    t, moved = linear_history(scene, points, time_s[kept], factor * columns["ground"][kept])
    for name, column, modal in zip(
        ("top floor", "façade"), ("top_m", "facade_m"), moved, strict=True
    ):
        explicit = table[column].to_numpy()
        expected = np.interp(table["time_s"], t, modal)
        add(f"peak of {name}", size, np.abs(explicit).max(), np.abs(expected).max(), "m")
        error = np.abs(explicit - expected).max() / np.abs(expected).max()
        rows.append(
            (f"largest difference of {name} over its peak", size, np.nan, np.nan, "-", error)
        )
    rows.append(("bonds broken", size, float(table["broken"].iloc[-1]), 0.0, "-", np.nan))
    columns = ["check", "coarsening", "explicit", "modal", "unit", "error"]
    write_table(rows, job.output[0], columns)


run(main, globals())
