"""Draws of how a block stands and which way the table shakes it, from what a model states."""

import math
from typing import NamedTuple

import numpy as np
from scipy.spatial import ConvexHull

from studies.overturning import blocks, geometry, table

SOLE_M = 0.15  # above the lowest point: what another ground may move
TRIES = 200


class Draw(NamedTuple):
    """One draw: a block at rest, its points turned so that y is the direction of shaking."""

    points_m: np.ndarray  # (n, 3) from the centre of mass
    standing: blocks.Standing  # in the plane
    inertia_m2: np.ndarray  # (3, 3) over mass, in the axes of `points_m`
    width: float = 1.0  # of what it rocks about along y, over that of the points


def solids(stated, folder):
    """`Solid` and mass [kg] of each specimen that a model states."""
    with table.archive(folder, table.SPECIMENS) as scans:
        shapes = {
            number: geometry.solid(
                scans[f"surface_specimen{number}"], scans[f"hull_specimen{number}"]
            )
            for number in stated["specimens"]
        }
    masses = {}
    for number, facts in stated["specimens"].items():
        like = facts.get("density_of", number)
        weighed = stated["specimens"][like]["mass_kg"]
        masses[number] = weighed * shapes[number].volume_m3 / shapes[like].volume_m3
    return {number: (shapes[number], masses[number]) for number in shapes}


def weakest(solid):
    """Direction in which the energy that overturns the block as scanned is least [rad]."""
    hull = ConvexHull(solid.points_m @ geometry.at_rest(solid.points_m).T)
    angles = np.radians(np.arange(0.0, 360.0, 3.0))
    least = [geometry.barrier(geometry.profile(hull, angle), 1)[0] for angle in angles]
    return float(angles[int(np.argmin(least))])


def draw(stated, solid, mass_kg, weakest_rad, number, specimen):
    """`Draw` of a number; the same for the same seed, specimen and number."""
    rng = np.random.default_rng([stated["seed"], specimen, number])
    about, rough = stated["direction"], stated["contact"]
    direction = rng.uniform(0.0, 2.0 * math.pi)
    near = weakest_rad + math.radians(about["deviation_deg"]) * rng.normal()
    if rng.uniform() < about["weakest_share"]:
        direction = near
    direction += math.pi * (number % 2)
    facts = stated["specimens"][specimen]
    if "direction_deg" in facts:
        direction = math.radians(facts["direction_deg"])
    off = 1e-3 * stated["centre_of_mass_deviation_mm"] * np.append(rng.normal(size=2), 0.0)
    friction = math.radians(rng.uniform(*stated["friction_deg"]))
    contact = stated["contact_n_m"] * math.exp(stated["contact_log_deviation"] * rng.normal())
    damping = rng.uniform(*stated["damping"])
    points = _standing_on(rng, solid.points_m - off, rough)
    c, s = math.cos(direction), math.sin(direction)
    turn = np.array([[s, -c, 0.0], [c, s, 0.0], [0.0, 0.0, 1.0]])  # the direction becomes y
    points, inertia = points @ turn.T, turn @ solid.inertia_m2 @ turn.T
    scale = facts.get("width", 1.0)
    chain = geometry.profile(points, 0.5 * math.pi) * np.array([scale, 1.0])
    standing = blocks.Standing(
        chain,
        mass_kg,
        tuple(mass_kg * np.diag(inertia)),
        friction,
        contact,
        blocks.beta(mass_kg, contact, damping),
        blocks.fallen_tilt(chain),
    )
    return Draw(points, standing, inertia, scale)


def _standing_on(rng, points, rough):
    """Points of a block at rest on rough ground that it does not lean on by more than stated."""
    level = points @ geometry.at_rest(points).T
    low = level[:, 2] < level[:, 2].min() + SOLE_M
    limit = math.radians(rough["leans_at_most_deg"])
    for _ in range(TRIES):
        size = rough["roughness_mm"] * math.exp(rough["roughness_log_deviation"] * rng.normal())
        moved = level.copy()
        moved[low, 2] += geometry.field(
            rng, moved[low, :2], 1e-3 * size, 1e-3 * rough["correlation_mm"]
        )
        rest = geometry.at_rest(moved)
        if math.acos(min(1.0, rest[2, 2])) < limit:
            return moved @ rest.T
    raise ValueError(f"contact: no draw of {TRIES} leans less than {math.degrees(limit):g}°")
