"""Node counts of a scene file."""


def with_nodes(case, nodes):
    """Copy of a scene file with n nodes a return wall, 2n − 1 at the base; None: its own."""
    if nodes is None:
        return case
    numerics = {
        **case["numerics"],
        "nodes_thickness": 2 * nodes - 1,
        "nodes_height": nodes,
        "nodes_per_block": nodes,
    }
    return {**case, "numerics": numerics}
