"""Floor motions of another program: what a case can have of them."""

import warnings
from collections.abc import Mapping

import numpy as np

from rocking.collapse.search import MARGIN
from yade_scripts.model import yielding
from yade_scripts.model.chain import yields
from yade_scripts.model.gravity import STANDARD_GRAVITY_M_S2


def check_floors(floors):
    """Refuse what is no (time_s, columns) with the ground among them."""
    good = isinstance(floors, tuple) and len(floors) == 2 and isinstance(floors[1], Mapping)
    if not good or "ground" not in floors[1]:
        raise ValueError(
            "floors: expected (time_s, columns) with columns 'ground', 'floor1', …, as "
            "Motion.read_floors gives them"
        )
    count = np.shape(floors[0])
    for name, values in floors[1].items():
        if np.shape(values) != count or len(count) != 1:
            raise ValueError(
                f"floors: column {name} of shape {np.shape(values)}; expected {count} as the times"
            )


def fit(motion, case):
    """Refuse floor motions of others that a case would ignore, or has not; warn of scaling."""
    floors = [name for name in (motion.floors or ((), ()))[1] if name.startswith("floor")]
    if motion.of_chain or not floors:
        return
    if case.kind.chain and yields(case["smdof"]):
        raise ValueError(
            f"{motion.file or motion.name}: smdof.base_shear_ratio = "
            f"{case['smdof']['base_shear_ratio']:g}: expected null, since these floors are "
            "another program's and are not computed again"
        )
    if case.kind.two_way:
        raise ValueError(
            f"{motion.file or motion.name}: model {case.model} computes its floors itself and "
            "would ignore these; expected a record, or a model that is driven by floors, as W2"
        )
    if case.kind.chain and len(floors) != case["smdof"]["n_dof"]:
        raise ValueError(
            f"{motion.file or motion.name}: {len(floors)} floors, but smdof.n_dof = "
            f"{case['smdof']['n_dof']}; expected as many"
        )
    tabled = isinstance(motion.floors[1], yielding.ByAmplitude)
    if case.kind.chain and not tabled and not motion._kept.get("said"):
        motion._kept["said"] = True
        warnings.warn(
            f"{motion.file or motion.name}: the floors scale with the ground's peak; those of a "
            "building that yields hold at the intensity that they were computed for alone",
            UserWarning,
            stacklevel=5,
        )


def searched(highest):
    """How high a search may go for its realisations to stay within a highest intensity."""
    return highest / (1.0 + 2.0 * MARGIN)


def within_table(motion, columns, settings):
    """Refuse a search that may go beyond the highest intensity of tabulated floor motions."""
    if isinstance(columns, yielding.TabulatedFloors) and "pga_g" not in settings:
        highest = searched(columns.highest_m_s2 / STANDARD_GRAVITY_M_S2)
        if settings["max_pga_g"] > highest:
            raise ValueError(
                f"{motion.file or motion.name}: ida.max_pga_g = {settings['max_pga_g']:g}: "
                f"expected at most {highest:.4g} (g), so that realisations stay within the table"
            )
