"""Absolute floor accelerations of the substitute chain (smdof/{record}_{n}dof.csv)."""

import json

from rocking.records import read_csv
from rocking.runtime.script import run

from smdof.chain import floor_motions
from yade_scripts.model.floor_motions import write


def main(job):
    chain = json.loads(job.params.smdof)["smdof"]
    record = read_csv(job.input.record)
    n = int(job.wildcards.n)
    motion = floor_motions(
        record.acceleration_m_s2,
        record.dt_s,
        n,
        chain["period_s"],
        chain["damping_ratio"],
        chain["damping_model"],
        tail_s=chain["tail_s"],
    )
    write(job.output[0], motion.time_s, motion.ground_m_s2, motion.floors_m_s2)


run(main, globals())
