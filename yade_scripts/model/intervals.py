"""Stretches of a line, such as a wall's length, and what is cut out of them."""


def without(stretches, holes, least_m):
    """What is left of stretches without holes, in order.

    Parameters
    ----------
    stretches, holes : iterable of (low, high)
        [m]
    least_m : float
        What is not longer is left out.

    Returns
    -------
    list of (low, high)
    """
    left = list(stretches)
    for low, high in holes:
        parts = [part for a, b in left for part in ((a, min(b, low)), (max(a, high), b))]
        left = [(a, b) for a, b in parts if b - a > least_m]
    return left
