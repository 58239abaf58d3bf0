"""Which falls first, façade or building: the drift of the building's storeys at every amplitude.

The storeys of the chain under the ground motion alone, as if no façade pushed them. A building that
stays elastic is never said to fall.
"""

import numpy as np
import pandas as pd

from rocking.collapse.crossing import first_crossing
from rocking.collapse.probability import probability
from rocking.solver.storeys import march
from yade_scripts.model import yielding
from yade_scripts.model.chain import yields
from yade_scripts.model.motion import GROUND, amplitude

DRIFT, FELL = "storey_drift", "building_fell"
LOWEST_G, RATIO, AT_ONCE = 0.02, 1.02, 32  # amplitudes at which a building alone is tried


def with_building(table, case, motion, direction):
    """A curve's table with `DRIFT`, the largest drift of a storey over its height, and `FELL`.

    `FELL` is 1 where the drift comes to smdof.fallen_drift_ratio. Of a case whose building does not
    yield, or that has none, the table as it is.

    Parameters
    ----------
    table : DataFrame
        With pga_g.
    case : Case
    motion : Motion
    direction : str
    """
    if not (case.kind.chain and yields(case["smdof"])):
        return table
    chain = _alone(case, motion, direction)
    factors = amplitude(chain[GROUND], direction, table["pga_g"].to_numpy(float))
    drift = chain.drift_ratios(factors) if len(table) else np.zeros(0)
    fell = (drift >= case["smdof"]["fallen_drift_ratio"]).astype(int)
    return table.assign(**{DRIFT: drift, FELL: fell})


def falls_at(case, motion, direction, highest_g):
    """Lowest PGA at which a storey of a building that yields comes to its drift [g], alone.

    Of amplitudes `RATIO` apart, up to the highest; NaN where it stands at all of them, stays
    elastic, or the model has no building.
    """
    if not (case.kind.chain and yields(case["smdof"])):
        return np.nan
    chain, drift = _alone(case, motion, direction), case["smdof"]["fallen_drift_ratio"]
    levels = np.geomspace(
        LOWEST_G, highest_g, 2 + int(np.log(highest_g / LOWEST_G) / np.log(RATIO))
    )
    for some in np.array_split(levels, 1 + levels.size // AT_ONCE):
        fell = chain.drift_ratios(amplitude(chain[GROUND], direction, some)) >= drift
        if fell.any():
            return float(some[fell.argmax()])
    return np.nan


def _alone(case, motion, direction):
    """Chain of a case under its motion, without a façade before it, after a first shock if any."""
    time_s, columns = motion.columns(case)
    chain = yielding.YieldingFloors(time_s, columns, case.sections, march)
    if motion.before(case, direction) is None:
        return chain
    first_s, first = motion.first.columns(case)
    first = yielding.YieldingFloors(first_s, first, case.sections, march)
    factor = amplitude(first[GROUND], direction, motion.first_pga_g)
    return chain.following(first.at(factor))


def building_share(scan, at_g, spread):
    """Share of a scan's amplitudes within ± spread of each at which the building has fallen.

    NaN of a scan without `FELL`.
    """
    if scan is None or FELL not in scan:
        return np.full(len(at_g), np.nan)
    known = scan.sort_values("pga_g")
    return probability(known["pga_g"], known[FELL], at_g, spread)[0]


def told(scan, facade, spread):
    """What a curve's summary says of its building, by name.

    pga_building_g, where half of the amplitudes nearby first bring it down [g], NaN where it never
    falls up to the largest that was run or a scan does not say; building_first, 1 where that is
    below the façade's half collapse (its lowest, where it has none), 0 where not, NaN: not known.

    Parameters
    ----------
    scan : DataFrame or None
    facade : dict
        Of `probability.summary`.
    spread : float
    """
    if scan is None or FELL not in scan:
        return {"pga_building_g": np.nan, "building_first": np.nan}
    at_g = np.sort(scan["pga_g"].to_numpy(float))
    building = first_crossing(at_g, building_share(scan, at_g, spread), 0.5)
    half, lowest = facade["pga_median_g"], facade["pga_collapse_g"]
    facade_g = half if np.isfinite(half) else lowest
    first = float(not facade_g <= building) if np.isfinite(building) else 0.0
    return {"pga_building_g": building, "building_first": first}


def joined(table, scan, spread):
    """A table of collapse probabilities with the building's beside it, `probability_building`."""
    share = building_share(scan, table["pga_g"].to_numpy(float), spread)
    return table.assign(probability_building=pd.Series(share, table.index, dtype=float))
