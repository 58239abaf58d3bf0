"""Where the mechanisms of a façade collapse under each motion, no further than it tells.

A motion fells the façade where it fells one of its mechanisms. So once one has fallen, another is
followed under that motion only up to there, and a little further.
"""

import numpy as np

from rocking.collapse.quick import crossings_of

FURTHER = 1.15  # beyond the first collapse of a motion: no step of a climb is longer


def by_part(parts, turns, most_g, known_g=None):
    """Short climbs of some mechanisms, in their order: by part a list of rows, one a turn.

    Parameters
    ----------
    parts : mapping of str to Case
    turns : sequence of (Motion, direction)
    most_g : float
        PGA up to which all are followed.
    known_g : sequence of float, optional
        Half collapse that is known already by turn, NaN where nothing fell: where it is given,
        parts are followed no further than `FURTHER` times the least.

    Returns
    -------
    dict of str to list of dict
        As of `quick.crossings_of`, with pga_max_g.
    """
    found, least = {}, np.full(len(turns), np.inf)
    if known_g is not None:
        least = np.fmin(least, np.asarray(known_g, float))
    for part, case in parts.items():
        ends = np.full(len(turns), most_g)
        if known_g is not None:
            ends = np.minimum(most_g, FURTHER * least)
        rows = crossings_of(case, turns, [{"max_pga_g": float(end)} for end in ends])
        least = np.fmin(least, np.array([row["pga_median_g"] for row in rows], float))
        both = zip(rows, ends, strict=True)
        found[part] = [{**row, "pga_max_g": float(end)} for row, end in both]
    return found
