"""Timber floors: evenly spaced rigid beams with a rigid panel on top of them."""

from dataclasses import dataclass

import numpy as np


@dataclass
class FloorBoxes:
    """Beams and panel of one floor as boxes: a row a beam and, last, the panel's."""

    names: list
    low_m: np.ndarray
    high_m: np.ndarray
    mass_kg: np.ndarray


def floor_boxes(plan, floor, timber_density_kg_m3):
    """Place the beams and the panel of a floor.

    Beams span between the two walls and reach `bearing_m` into the recess of each; they stand
    evenly, at most about `beam_spacing_m` apart, half a spacing inside the ends of `extent_m`, so
    that they touch no wall but the two. The panel covers the clear span, touches the beams alone
    and carries `load_kg_m2` times its area.
    """
    near, far = sorted((plan.wall(n) for n in floor.walls), key=lambda w: w.offset_m)
    along = near.axis
    inner = (near.offset_m + near.thickness_m / 2.0, far.offset_m - far.thickness_m / 2.0)
    seats = (inner[0] - floor.bearing_m, inner[1] + floor.bearing_m)
    start, end = floor.extent_m
    count = max(2, int(np.floor((end - start) / floor.beam_spacing_m + 0.5)))
    centre = start + (end - start) * (np.arange(count) + 0.5) / count
    first = centre - floor.beam_width_m / 2.0
    low = np.empty((count + 1, 3))
    high = np.empty((count + 1, 3))
    low[:-1, along], high[:-1, along] = first, first + floor.beam_width_m
    low[:-1, 1 - along], high[:-1, 1 - along] = seats
    low[:-1, 2], high[:-1, 2] = floor.level_m, floor.level_m + floor.beam_height_m
    low[-1, along], high[-1, along] = start, end
    low[-1, 1 - along], high[-1, 1 - along] = inner
    low[-1, 2] = floor.level_m + floor.beam_height_m
    high[-1, 2] = low[-1, 2] + floor.panel_thickness_m
    mass = timber_density_kg_m3 * np.prod(high - low, axis=1)
    mass[-1] += floor.load_kg_m2 * (end - start) * (inner[1] - inner[0])
    names = [*(f"{floor.name}/beam{i + 1}" for i in range(count)), f"{floor.name}/panel"]
    return FloorBoxes(names, low, high, mass)
