"""Nested dissection: an elimination order for the stiffness of a building of blocks.

The blocks are split at the median of one coordinate; those of one half that touch
the other separate the two and are eliminated after both, and so on within each
half (George, 1973). For walls this leaves less fill than minimum degree, and the
factorisation of the full building takes less than half the time.
"""

import numpy as np
from scipy import sparse

LEAF = 40  # blocks that are not divided further
MANY_NEIGHBOURS = 20  # beams and panels tie distant blocks together: they come last


def block_order(scene):
    """Return the blocks in the order of their elimination, shape (n_blocks,)."""
    nodes, count = scene.nodes, len(scene.blocks)
    free = np.array([bool(block.free) for block in scene.blocks])
    inner = free[nodes.a] & free[nodes.b]
    graph = sparse.coo_array(
        (np.ones(inner.sum()), (nodes.a[inner], nodes.b[inner])), shape=(count, count)
    ).tocsr()
    graph = ((graph + graph.T) > 0).astype(float).tocsr()
    centres = np.array([block.centre_m for block in scene.blocks], float)
    busy = graph.sum(axis=1) > MANY_NEIGHBOURS
    return np.concatenate(
        [
            _dissect(np.flatnonzero(free & ~busy), graph, centres),
            np.flatnonzero(free & busy),
            np.flatnonzero(~free),
        ]
    )


def _dissect(blocks, graph, centres):
    """Return `blocks` in elimination order; recursion halves them."""
    if len(blocks) <= LEAF:
        return blocks
    best = None
    for axis in range(3):
        place = centres[blocks, axis]
        low = place < np.median(place) - 1e-9
        if not low.any():
            continue
        other = np.zeros(len(centres))
        other[blocks[~low]] = 1.0
        touching = graph[blocks[low]] @ other > 0.0
        uneven = abs(len(blocks) - 2 * low.sum()) / len(blocks)
        cost = touching.sum() * (1.0 + 2.0 * uneven)
        if best is None or cost < best[0]:
            best = (cost, blocks[low], blocks[~low], touching)
    if best is None:  # all at one place
        return blocks
    _, low, high, touching = best
    parts = (_dissect(low[~touching], graph, centres), _dissect(high, graph, centres))
    return np.concatenate([*parts, low[touching]])


def equation_order(scene, dof):
    """Return the equations in elimination order, those of one block together.

    `dof`, shape (n, 2), has block and DOF number of each.
    """
    place = np.empty(len(scene.blocks), int)
    place[block_order(scene)] = np.arange(len(scene.blocks))
    return np.lexsort((dof[:, 1], place[dof[:, 0]]))
