"""Gauss–Lobatto points: contact nodes whose end points sit on the edges."""

import numpy as np
from numpy.polynomial import legendre


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
