"""From a record to the accelerations that drive a scene."""

import numpy as np

from smdof.chain import floor_motions, shear_chain
from yade_scripts.model.floor_motions import GROUND, VERTICAL


def chain_motions(record, chain):
    """`smdof.chain.FloorMotions` of a chain of masses under a record; `chain` is section smdof."""
    return floor_motions(
        record.acceleration_m_s2,
        record.dt_s,
        shear_chain(chain["n_dof"], chain["period_s"]),
        chain["damping_ratio"],
        chain["damping_model"],
        tail_s=chain["tail_s"],
    )


def floor_columns(record, chain):
    """Times, and accelerations of ground and floors by column, as `floor_motions.read` gives them.

    `chain` is section smdof. A vertical motion of the record is the ground's and every floor's.
    """
    motion = chain_motions(record, chain)
    columns = {GROUND: motion.ground_m_s2}
    columns |= {f"floor{j}": row for j, row in enumerate(motion.floors_m_s2, 1)}
    up = vertical_at(record, motion.time_s)
    return motion.time_s, columns if up is None else {**columns, VERTICAL: up}


def vertical_at(record, time_s):
    """Vertical acceleration of a record at some times [m/s²]; None where it has none.

    After its last sample it drops to zero over one step, as the ground's does.
    """
    if record.vertical_m_s2 is None:
        return None
    up = np.append(record.vertical_m_s2, 0.0)
    return np.interp(time_s, record.dt_s * np.arange(up.size), up)
