"""A search for collapse that leaves nothing between its steps: what the others are judged by."""

import numpy as np
from rocking.collapse.probability import probability
from rocking.collapse.search import climb


def dense(start_g, settings, block=16):
    """Ask for a `climb`, then for steps of `fine_step` up to where everything falls.

    The steps begin below the lowest fall of the climb, and end where all that was run within
    ± `amplitude_spread` of some amplitude fell.

    Parameters
    ----------
    start_g, settings, block
        As of `climb`; settings has fine_step and amplitude_spread too.
    """
    seen = yield from climb(start_g, settings, block)
    if not seen.fell.any():
        return
    last, ratio = settings["max_pga_g"], 1.0 + settings["level_ratio"]
    spread, step = settings["amplitude_spread"], 1.0 + settings["fine_step"]
    at = seen.pga_g[seen.fell].min() * (1.0 - spread) ** 2 / ratio
    while at < last:
        more = at * step ** np.arange(block)
        yield from seen.ask(more[more <= last], realisations=True)
        at *= step**block
        order = np.argsort(seen.pga_g, kind="stable")
        pga_g = seen.pga_g[order]
        within = pga_g[pga_g < at * (1.0 - spread)]  # counted in full
        share, _ = probability(pga_g, seen.fell[order], within, spread)
        if share.max() == 1.0:
            break
