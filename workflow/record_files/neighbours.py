"""Whether numbers go on along the lines or down the columns."""

import numpy as np

ALIKE = 0.8  # ratio of mean differences that counts as the same
CLOSER = 1.3  # ratio of neighbours' differences across to down, or down to across, that decides


def closer(table):
    """2 where neighbours down the columns are closer, -1 along the lines; 1 and 0: it is open.

    Down: closer than along the line, at which all distances are alike: a motion of the period of a
    line is close down the columns too, and closer to its neighbours than half a line away. Along:
    each number is as close to the next, over the end of a line too; channels that move alike are
    close along the line, but not over its end, which makes a 1.
    """
    rows, width = table.shape
    if rows < 8:
        return 0
    flat = table.ravel()
    down = np.abs(table[1:] - table[:-1]).mean()
    steps = np.abs(np.diff(flat))
    across = steps.mean()
    if not down > 0.0 or not across > 0.0:
        return 0
    by_place = np.nanmean(np.append(steps, np.nan).reshape(rows, width), axis=0)
    even = by_place.max() < (1.0 + 4.0 / np.sqrt(rows)) * by_place.min()
    if down * CLOSER < across:
        apart = [np.abs(flat[lag:] - flat[:-lag]).mean() for lag in range(2, width)]
        return 2 if across > ALIKE * max(apart, default=0.0) else 1
    if across * CLOSER < down and even:
        return -1
    return 1 if not even else 0
