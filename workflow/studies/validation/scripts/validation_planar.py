"""Every variant and run of a shake-table experiment by the planar solver, amplitudes in a band."""

import json
import math

from rocking.runtime.script import run
from rocking.solver import Motions, history, peaks, to_plane
from rocking.tables import read_json, write_table
from studies.validation.specimens import planar_step
from studies.validation.study import ALONE, SEQUENCE, factors, peaks_of_spans

from yade_scripts.model.floor_motions import read
from yade_scripts.model.models import build_scene

SAMPLE_S = 0.001  # of the sequence


def main(job):
    about = read_json(job.input.cases)
    settings = json.loads(job.params.settings)
    runs = about["runs"]
    several = settings["validation"]["members"], settings["validation"]["band"]
    drawn = factors(settings["seed"], len(runs), *several)
    motions = [Motions(*table) for table in (ground(r["motion"]) for r in runs)]
    whole, rows = Motions(*ground(about["sequence"])), []
    for number, (variant, case) in enumerate(about["variants"].items()):
        count = None if number < settings["validation"]["main_variants"] else 2
        plane, numerics = to_plane(build_scene(case)), case["numerics"]
        mm, step = 1e3 * plane.thickness_m, planar_step(plane, numerics)
        for r, motion, members in zip(runs, motions, drawn[:, :count], strict=True):
            outcome = peaks(plane, motion, numerics, members, step_s=step)
            for factor, d, fell, failed in zip(
                members, outcome.d_over_b, outcome.overturned, outcome.failed, strict=True
            ):
                status = "failed" if failed else "overturned" if fell else "ok"
                peak = mm * d if status == "ok" else math.nan
                rows.append((variant, r["run"], ALONE, factor, peak, status))
        still = {**numerics, "quiet_ratio": 0.0}
        d = history(plane, whole, still, step_s=step, sample_s=SAMPLE_S)
        peaks_m = peaks_of_spans(d.time_s, d.d_m, about["spans"], d.status)
        for r, peak in zip(runs, peaks_m, strict=True):
            status = "ok" if math.isfinite(peak) else d.status
            rows.append((variant, r["run"], SEQUENCE, 1.0, 1e3 * peak, status))
    names = ["variant", "run", "how", "factor", "peak_mm", "status"]
    write_table(rows, job.output[0], names, "%.9g")


def ground(path):
    time_s, columns = read(path)
    return time_s, columns["ground"]


run(main, globals())
