"""Node counts of a scene file."""


def with_nodes(job, nodes):
    """Copy of a scene file with n nodes a return wall, 2n − 1 at the base; None: its own."""
    if nodes is None:
        return job
    numerics = {
        **job["numerics"],
        "nodes_thickness": 2 * nodes - 1,
        "nodes_height": nodes,
        "nodes_per_block": nodes,
    }
    return {**job, "numerics": numerics}
