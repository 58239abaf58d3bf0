"""What else a façade's block may have: cornices, and a wedge of its return walls.

Cornices are boxes before the outer face (`cornices`): mass that leans out, without a contact.

A wedge of the return walls (`wedge_deg`, `wedge_thickness_m` of all together) goes along with the
façade: between its back face and a crack that leaves it at the base and climbs at that angle from
the vertical, up to what the return walls hold. About x, the axis that it turns about, its moments
are exact; along x it counts as one in the middle.
"""

import numpy as np

SLIVER_M = 1e-9


def cornices_of(facade, storeys):
    """(z0, z1, y0, y1) of cornices, cut where the outer face steps; all below the eaves."""
    cornices, h = [], facade.height_m
    for number, row in enumerate(facade.cornices, 1):
        low, high = row.z_m, row.z_m + row.height_m
        if high > h + SLIVER_M:
            raise ValueError(
                f"facade.cornices[{number}].height_m = {row.height_m:g}: expected a top, z_m + "
                f"height_m, of at most facade.height_m = {h:g} (m)"
            )
        for z0, z1, _, y in storeys:
            a, b = max(z0, low), min(z1, high)
            if b - a > SLIVER_M:
                cornices.append((a, b, y, y + row.projection_m))
    return tuple(cornices)


def wedge_parts(facade, storeys):
    """Parts of the return walls' wedge, one before each storey of thickness."""
    slope, thick, h = facade.wedge_slope, facade.wedge_thickness_m, facade.height_m
    if not thick:
        raise ValueError(
            "facade.wedge_thickness_m: expected the thickness of all return walls together (m) "
            f"with facade.wedge_deg = {facade.wedge_deg:g}"
        )
    parts = []
    for z0, z1, y, _ in storeys:
        if z0 < h - SLIVER_M:
            outline = [(y - slope * z0, z0), (y, z0), (y, z1), (y - slope * z1, z1)]
            parts.append(_sheet(facade.density_kg_m3, thick, np.array(outline)))
    return parts


def _sheet(density, thick_m, outline):
    """Mass, centroid, moments and size of a polygon (y, z), counter-clockwise, on a width.

    By Green's theorem, as sums over its edges.
    """
    first = outline[0]  # sums are of places from there
    (y0, z0), (y1, z1) = (outline - first).T, (np.roll(outline, -1, axis=0) - first).T
    cross = y0 * z1 - y1 * z0
    area = 0.5 * cross.sum()
    cy, cz = ((a + b) @ cross / (6.0 * area) for a, b in ((y0, y1), (z0, z1)))
    yy, zz = ((a * a + a * b + b * b) @ cross / 12.0 for a, b in ((y0, y1), (z0, z1)))
    yy, zz = yy / area - cy**2, zz / area - cz**2
    mass, xx = density * thick_m * area, thick_m**2 / 12.0
    centre = np.array([0.0, first[0] + cy, first[1] + cz])
    size = (thick_m, *np.ptp(outline, axis=0).tolist())
    return mass, centre, np.diag([mass * (yy + zz), mass * (xx + zz), mass * (xx + yy)]), size
