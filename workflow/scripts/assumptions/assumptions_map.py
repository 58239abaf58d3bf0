"""Collapse of W2, one-way and two-way, under one record and before many buildings."""

from rocking import Case, Motion, collapse_curve
from rocking.records import read_csv
from rocking.runtime.script import run
from rocking.studies.assumptions import buildings
from rocking.tables import write_table

COLUMNS = ["record", "direction", "mass_ratio", "period_s", "damping_ratio"]
COLUMNS += [*(f"pga_{name}_g" for name in ("collapse", "median", "all", "max")), "runs_planar"]
MEMBERS = 5  # amplitudes behind a probability


def main(job):
    case, settings = Case.read(job.input.scene), job.params.assumptions
    motion, ratio, rows = Motion(read_csv(job.input.record)), settings["level_ratio"], []
    how = {"level_ratio": ratio, "amplitude_spread": 0.5 * (MEMBERS - 1) * ratio}
    every = buildings(case, settings)
    chains = dict.fromkeys((v.about["period_s"], v.about["damping_ratio"]) for v in every)
    for chain in chains:
        mine = [v for v in every if (v.about["period_s"], v.about["damping_ratio"]) == chain]
        for direction in job.params.directions:
            for variant in mine:
                given = case.varied(variant), motion, direction
                curve = collapse_curve(*given, search="climb", settings=how)
                key = {"record": motion.name, "direction": direction}
                rows.append({**key, **variant.about, **curve.summary()})
    write_table(rows, job.output[0], COLUMNS)


run(main, globals())
