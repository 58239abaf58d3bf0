"""Absolute floor accelerations of the substitute chain (smdof/{record}_{n}dof.csv)."""

import json

import numpy as np
from rocking.records import read_csv
from rocking.runtime.script import run

from smdof.chain import floor_motions


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
    columns = np.column_stack([motion.time_s, motion.ground_m_s2, motion.floors_m_s2.T])
    names = ["time_s", "ground_m_s2"] + [f"floor{j}_m_s2" for j in range(1, n + 1)]
    np.savetxt(
        job.output[0], columns, fmt="%.9g", delimiter=",", header=",".join(names), comments=""
    )


run(main, globals())
