"""Façades drawn at random as a configuration of `assess`: ties, floors, openings, steps, gables."""

import numpy as np

SITES = ("A", "B", "C")


def drawn(rng):
    """One façade with its building and site, as a mapping by section."""
    height, thickness = rng.uniform(3.5, 12.0), rng.uniform(0.28, 0.8)
    width = rng.uniform(4.0, 10.0)
    storeys = max(1, round(height / 3.4))
    levels = [round(height * (k + 1) / storeys, 2) for k in range(storeys)]
    facade = {
        "height_m": levels[-1],
        "thickness_m": round(thickness, 2),
        "width_m": round(width, 1),
        "density_kg_m3": float(rng.choice([1700.0, 1900.0, 2100.0])),
        "e_mpa": float(rng.choice([900.0, 1500.0, 2400.0])),
        "flush_face": str(rng.choice(["outer", "inner"])),
        "floors": _floors(rng, levels),
        "ties": _ties(rng, levels),
        "openings": _openings(rng, width, levels),
    }
    if rng.random() < 0.5 and storeys > 1:
        z = levels[rng.integers(0, storeys - 1)]
        up = round(max(0.2, thickness * rng.uniform(0.6, 0.9)), 2)
        facade["thickness_steps"] = [{"z_m": z, "thickness_m": up}]
    top = rng.random()
    if top < 0.3:
        facade["gable_height_m"] = round(rng.uniform(0.8, 2.5), 2)
    elif top < 0.5:
        facade["parapet_height_m"] = round(rng.uniform(0.5, 1.3), 2)
        facade["parapet_thickness_m"] = 0.25
    if rng.random() < 0.2:
        facade["base_height_m"] = round(rng.uniform(2.8, 4.0), 2)
    high = facade["height_m"] + facade.get("base_height_m", 0.0)
    mass = 1000.0 * round(rng.uniform(18.0, 40.0) * high)
    wall = {"thickness_m": facade["thickness_m"], "building_mass_kg": mass}
    chain = {"n_dof": max(1, round(high / 3.4)), "period_s": round(0.06 * high**0.75, 3)}
    site = {
        "confidence_factor": 1.35,
        "soil": str(rng.choice(SITES)),
        "ag_g": round(rng.uniform(0.06, 0.26), 3),
        "f0": 2.45,
        "tc_star_s": 0.31,
    }
    return {"facade": facade, "return_wall": wall, "smdof": chain, "assessment": site}


def several(count, seed):
    """So many façades of one seed; a longer list begins with the shorter one."""
    return [drawn(np.random.default_rng([seed, k])) for k in range(count)]


def _floors(rng, levels):
    rows = []
    for z in levels:
        if rng.random() < 0.7:
            row = {"height_m": z, "load_kn": round(rng.uniform(10.0, 80.0), 0)}
            if rng.random() < 0.3:
                row["anchor_kn"] = round(rng.uniform(5.0, 40.0), 0)
            rows.append(row | {"arm_m": 0.1})
    return rows


def _ties(rng, levels):
    rows = []
    for z in levels:
        if rng.random() < 0.4:
            row = {"height_m": z, "count": 2, "length_m": 6.0, "yield_mpa": 235.0}
            row["diameter_mm"] = float(rng.choice([12.0, 18.0, 24.0]))
            if rng.random() < 0.5:
                row["anchor_kn"] = float(rng.choice([15.0, 40.0, 90.0]))
            rows.append(row)
    return rows


def _openings(rng, width, levels):
    rows, below = [], 0.0
    for k, z in enumerate(levels):
        if rng.random() < 0.7 and z - below > 2.8:
            sill = 0.0 if k == 0 and rng.random() < 0.5 else below + 0.9
            high = min(rng.uniform(1.2, 2.2), z - 0.4 - sill)
            places = (0.0,) if width < 6.0 else (-0.27 * width, 0.27 * width)
            size = {"z_m": round(sill, 2), "width_m": 1.0, "height_m": round(high, 2)}
            rows += [{"x_m": round(x, 2), **size} for x in places]
        below = z
    return rows
