"""What the building behind a façade takes of its capacity: W2 over W1, by T1 and its place.

A façade up the building is shaken by the floors it stands on, and its analysis scales by the peak
at its own base. Held against W1 both are in peak ground acceleration.
"""

from pathlib import Path

import numpy as np
import pandas as pd
from rocking.collapse import probability
from rocking.collapse.equivalent import SLOPE
from rocking.collapse.ida import curve_key, read_curve
from rocking.tables import read_frame, read_json

COLUMNS = ["record", "source", "direction", "t1_s", "base_height_ratio"]
COLUMNS += ["pga_w1_g", "pga_w2_g", "ratio", "ratio_equivalent", "censored"]


def capacity(curve, scan, spread, slope=SLOPE):
    """PGA at which half collapse, or the highest intensity that stood; whether it is that.

    Last the equivalent PGA, NaN where nothing fell.
    """
    row = probability.summary(scan, curve, (), spread, slope)
    censored = np.isnan(row["pga_median_g"])
    half = row["pga_safe_g"] if censored else row["pga_median_g"]
    return half, bool(censored), row["pga_equivalent_g"]


def capacities(curves, scans, confirmed, spread, slope=SLOPE):
    """Yield name of the curve's file, its key and its capacity, of every curve.

    `curves` are paths of YADE's runs of a curve, of those that are `confirmed`, `scans` of its
    dense scan.
    """
    known = set(map(str, confirmed))
    for path, at in zip(curves, scans, strict=True):
        scan, path = read_frame(at), str(path)
        yade = read_curve(path) if path in known else ()
        yield Path(path), curve_key(scan), capacity(yade, scan, spread, slope)


def ratios(alone, behind, facts, sources):
    """Capacity behind buildings (W2) over that without one (W1), both of `capacities`: COLUMNS.

    `facts` are paths of what is known of every motion, beside the curves of its building under the
    record's name: t1_s, base_height_ratio, peaks of the ground (pga_g) and the façade's base
    (base_peak_g). Intensities are in PGA, ratio is of half collapse. Curves whose every run failed
    are left out; censored where one of the two never collapsed.
    """
    first = {key[1:]: intensities for _, key, intensities in alone}
    motions = {str(path): read_json(path) for path in facts}
    rows = []
    for path, (_, record, direction), (of_base, open_2, equivalent_2) in behind:
        motion = motions[str(path.with_name(f"{record}.json"))]
        w1, open_1, equivalent_1 = first[record, direction]
        if np.isnan(of_base) or np.isnan(w1):
            continue
        factor = motion["pga_g"] / motion["base_peak_g"]
        w2, equivalent = of_base * factor, equivalent_2 * factor / equivalent_1
        place = motion["t1_s"], motion["base_height_ratio"]
        values = w1, w2, w2 / w1, equivalent, int(open_1 or open_2)
        rows.append((record, sources[record], direction, *place, *values))
    return pd.DataFrame(rows, columns=COLUMNS)
