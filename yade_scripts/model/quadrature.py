"""Where the nodes of a joint stand, and what part of its area each of them has."""

import math

import numpy as np
from numpy.polynomial import legendre

GAUSS = 0.5 / math.sqrt(3.0)  # of two Gauss points from the middle of a length of 1
MIDDLE = np.array([0.0]), np.array([1.0])  # the column of nodes of a planar scene


def gauss_lobatto(count):
    """Points and weights of the Gauss–Lobatto rule on [0, 1].

    The end points belong to the rule, so a joint's outermost nodes are its
    edges and the pivot of a rocking block is exact. With `count` points
    polynomials up to degree 2·count − 3 are integrated exactly; 3 points
    therefore give the rotational stiffness ∫y² dy = 1/12 without error.

    Parameters
    ----------
    count : int
        Number of points, at least 2.

    Returns
    -------
    points, weights : ndarray, shape (count,)
        Ascending points in [0, 1]; weights that sum to 1.

    Raises
    ------
    ValueError
        If `count` is below 2.

    References
    ----------
    Abramowitz and Stegun (1964), eq. 25.4.32: interior points are the zeros
    of P'_{n−1}, weights 2/(n(n−1)P_{n−1}(x)²).
    """
    if count < 2:
        raise ValueError(f"a joint needs at least 2 contact nodes along an edge, not {count}")
    last = legendre.Legendre.basis(count - 1)
    interior = np.sort(np.real(last.deriv().roots()))
    points = np.concatenate(([-1.0], interior, [1.0]))
    weights = 2.0 / (count * (count - 1) * last(points) ** 2)
    return (points + 1.0) / 2.0, weights / 2.0


def over_columns(line_m, areas_m2, columns, gap_m=0.0):
    """Repeat a line of nodes over columns along the façade.

    Parameters
    ----------
    line_m : ndarray, shape (n, 3)
        At x = 0.
    areas_m2 : ndarray, shape (n,)
        Of all columns together.
    columns : (ndarray, ndarray), shape (c,)
        Places in x [m], and weights whose sum is 1.
    gap_m : float or ndarray, shape (n,)

    Returns
    -------
    positions_m : ndarray, shape (c·n, 3)
    areas_m2, gaps_m : ndarray, shape (c·n,)
    """
    places, weights = columns
    gaps = np.broadcast_to(gap_m, areas_m2.shape)
    positions = np.concatenate([line_m + np.array([x, 0.0, 0.0]) for x in places])
    return (
        positions,
        np.concatenate([areas_m2 * share for share in weights]),
        np.concatenate([gaps for _ in places]),
    )
