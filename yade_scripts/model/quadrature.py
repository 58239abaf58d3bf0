"""Where the nodes of a joint stand, and what part of its area each of them has."""

import math

import numpy as np
from numpy.polynomial import legendre

GAUSS = 0.5 / math.sqrt(3.0)  # of two Gauss points from the middle of a length of 1
MIDDLE = np.array([0.0]), np.array([1.0])  # the column of nodes of a planar scene


def gauss_lobatto(count):
    """Points and weights of the Gauss–Lobatto rule on [0, 1], each of shape (count,).

    Points ascend and weights sum to 1. The end points belong to the rule, so a joint's outermost
    nodes are its edges and the pivot of a rocking block is exact. With `count` points polynomials
    up to degree 2·count − 3 are integrated exactly; 3 points therefore give the rotational
    stiffness ∫y² dy = 1/12 without error. ValueError if `count` is below 2.

    Abramowitz and Stegun (1964), eq. 25.4.32: interior points are the zeros of P'_{n−1}, weights
    2/(n(n−1)P_{n−1}(x)²).
    """
    if count < 2:
        raise ValueError(f"a joint needs at least 2 contact nodes along an edge, not {count}")
    last = legendre.Legendre.basis(count - 1)
    interior = np.sort(np.real(last.deriv().roots()))
    points = np.concatenate(([-1.0], interior, [1.0]))
    weights = 2.0 / (count * (count - 1) * last(points) ** 2)
    return (points + 1.0) / 2.0, weights / 2.0


def over_columns(line_m, areas_m2, columns):
    """Repeat a line of nodes over columns along the façade: positions (c·n, 3), areas (c·n,).

    The line is (n, 3), at x = 0, with the areas (n,) of all columns together; columns are their
    places in x [m], and weights whose sum is 1, each (c,).
    """
    places, weights = columns
    positions = np.concatenate([line_m + np.array([x, 0.0, 0.0]) for x in places])
    return positions, np.concatenate([areas_m2 * share for share in weights])
