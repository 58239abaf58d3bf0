"""Rods of a row of ties that is recommended."""

import math

ROD_KEYS = ("count", "length_m", "yield_mpa", "elongation", "slack_mm")


def row_of_rods(settings, height_m, force_kn):
    """Entry of facade.ties that yields at a force, by section strengthening: φ = 2 √(F/(nπf_y))."""
    area_mm2 = 1e3 * force_kn / (settings["count"] * settings["yield_mpa"])
    return {
        "height_m": float(height_m),
        "diameter_mm": 2.0 * math.sqrt(area_mm2 / math.pi),
        "e_mpa": 2e5,
        "anchor_kn": None,
        **{key: settings[key] for key in ROD_KEYS},
    }
