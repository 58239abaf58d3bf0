"""A search for the lowest level that falls, from a guess: for histories that take minutes."""

from yade_scripts.commands.search import Ask


def neighbour(level, max_pga_g, guess=0, block=1):
    """Find the lowest level that falls, from a guess up, or down if that falls.

    Parameters
    ----------
    level : callable
        PGA of level k [g], ascending.
    max_pga_g : float
    guess : int
    block : int
        Levels asked for at once on the way up.

    Returns
    -------
    int or None
    """

    def falling(levels):
        status = yield Ask([level(k) for k in levels])
        return [k for k, outcome in zip(levels, status, strict=True) if outcome == "overturned"]

    k = guess
    if (yield from falling([k])):
        while k > 0 and (yield from falling([k - 1])):
            k -= 1
        return k
    while level(k) < max_pga_g:
        more = [j for j in range(k + 1, k + 1 + block) if level(j - 1) < max_pga_g]
        if fell := (yield from falling(more)):
            return fell[0]
        k = more[-1]
    return None
