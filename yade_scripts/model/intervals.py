"""Stretches of a line, such as a wall's length, and what is cut out of them."""


def without(stretches, holes, least_m):
    """What is left of stretches (low, high) without holes, in order, if longer than `least_m`."""
    left = list(stretches)
    for low, high in holes:
        parts = [part for a, b in left for part in ((a, min(b, low)), (max(a, high), b))]
        left = [(a, b) for a, b in parts if b - a > least_m]
    return left
