"""Motions of a façade somewhere up a building: its base's as "ground", then the floors it spans.

Writes the motion file in the form that the dynamic analysis reads, and beside it the peak
acceleration of the ground and of the façade's base, to express intensities in PGA.
"""

import math

import numpy as np
from rocking.records import G_M_S2, read_csv
from rocking.records.floors import chain_motions, vertical_at
from rocking.runtime.script import run
from rocking.tables import write_json

from yade_scripts.model.floor_motions import write


def main(job):
    chain = dict(job.params.smdof)
    period_s, below = float(job.wildcards.t1), int(job.wildcards.below)
    record = read_csv(job.input.record)
    n = chain["n_dof"]
    damping_ratio = chain["damping_ratio"]
    # floors that still move when the motion ends would leave the façade's supports on the way
    # apart: free vibration until a ten-thousandth is left, for which a long period needs more time
    if damping_ratio > 0.0:
        free_s = math.log(1e4) * period_s / (2.0 * math.pi * damping_ratio)
        chain["tail_s"] = max(chain["tail_s"], free_s)
    motion = chain_motions(record, {**chain, "n_dof": below + n, "period_s": period_s})
    levels = np.vstack([motion.ground_m_s2, motion.floors_m_s2])[below:]
    up = vertical_at(record, motion.time_s)
    write(job.output.motion, motion.time_s, levels[0], levels[1:], up)
    facts = {
        "record": record.name,
        "t1_s": period_s,
        "masses_below": below,
        "base_height_ratio": below / (below + n),
        "pga_g": float(np.abs(motion.ground_m_s2).max()) / G_M_S2,
        "base_peak_g": float(np.abs(levels[0]).max()) / G_M_S2,
    }
    write_json(job.output.facts, facts, sort_keys=True)


run(main, globals())
