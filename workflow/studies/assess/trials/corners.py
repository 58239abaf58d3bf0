"""Corners shaken by YADE in three dimensions, beside the hand calculation of the same corner.

A corner of an upper storey, one rigid block on the two stepped cracks of its walls
(`tests/cases/corner_cases.py`), moves with the building under both horizontal components of a
station: the building is a chain of two masses (0.25 s, 5 %) in either direction, taken at the
height at which the hand calculation takes its floor spectrum. Stations are the eight of the suite
with two components and the shortest records. The PGA is that of the component along the bisector.
By hand: the SLV check on the floor with FC = 1 and that component's own spectrum, and the onset
α0 g/e* over the floor's largest acceleration.

    .venv/bin/python workflow/studies/assess/trials/corners.py --geometries 0 1 --stations 0 1 2 3

A line a curve: geometry, station, PGA that stood, PGA that felled it, both by hand [g], largest
twist at what stood, seconds. Factors climb by √2 from half of the hand's, then two are tried
between.
"""

import argparse
import math
import sys
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[4]
sys.path[:0] = [str(ROOT), str(ROOT / "workflow"), str(ROOT / "tests" / "cases")]
TABLE = ROOT / "config" / "suites" / "recorded_suite.tsv"
GEOMETRIES = (  # height of the corner, thickness of both walls [m], cracks from the vertical [°]
    (3.0, 0.5, 30.0),
    (5.0, 0.5, 30.0),
    (3.0, 0.4, 20.0),
    (6.0, 0.6, 25.0),
)
BELOW_M, CHAIN = 3.0, {"n_dof": 2, "period_s": 0.25, "damping_ratio": 0.05}
STATIONS, CLIMB, MOST = 8, math.sqrt(2.0), 8.0
HARDLY = 1e-6  # a hinge inset that makes FC the stated one
QUIET = 0.01  # of the Arias intensity, left out at either end


def pairs():
    """Names of both components of the stations with the shortest records."""
    by: dict[str, list] = {}
    for name, row in read_table(TABLE).items():
        by.setdefault(row.station, []).append(name)
    by_length = []
    for names in by.values():
        if len(names) == 2:
            first = load(names[0], TABLE)
            by_length.append((first.acceleration_m_s2.size * first.dt_s, tuple(names)))
    return [names for _, names in sorted(by_length)[:STATIONS]]


def floor_of(acceleration, dt_s, share):
    """Times and acceleration at a share of the height of the building [m/s²]."""
    record = Record("ground", acceleration, dt_s, "corner")
    motion = chain_motions(record, {**SMDOF, **CHAIN})
    levels = np.vstack([motion.ground_m_s2, motion.floors_m_s2])
    n = CHAIN["n_dof"]
    j = min(int(share * n), n - 1)
    part = share * n - j
    return motion.time_s, (1.0 - part) * levels[j] + part * levels[j + 1]


def by_hand(geometry, demand):
    """`Candidate` of the corner, and the PGAs at which SLV and onset are reached [g]."""
    h, t, deg = geometry
    settings = config.resolve(
        {
            "facade": {"height_m": h, "thickness_m": t, "width_m": 12.0, "base_height_m": BELOW_M},
            "return_wall": {"thickness_m": t},
            "smdof": CHAIN,
            "assessment": {
                "corner_crack_deg": deg,
                "confidence_factor": 1.0,
                "hinge_inset_m": HARDLY,
            },
        }
    )
    candidate, slv = Family(settings).corner(1, 0.0), Slv(settings, demand)
    (floor, _) = slv.places(candidate)["height"]
    return candidate, slv(candidate), checks.onset(candidate.mechanism, floor, 1.0)[1]


def shaken(geometry, motion, factors):
    """Outcomes of one corner under some factors."""
    h, t, deg = geometry
    corner = {
        "height_m": h,
        "thickness_m": t,
        "crack_deg": deg,
        "density_kg_m3": SMDOF_DENSITY,
        "e_pa": 1.8e9,
        "friction_deg": 30.0,
        "beta_s": 0.001,
    }
    time_s, out, beside = motion
    given = {"floor": out.tolist(), "beside": beside.tolist(), "factors": factors}
    return in_yade("corner_cases", "corners", corner=corner, time_s=time_s.tolist(), **given)[
        "runs"
    ]


def curve(geometry, names):
    """One corner under one station: what stood, what felled it, by hand, twist."""
    record, other = (load(name, TABLE) for name in names)
    count = min(record.acceleration_m_s2.size, other.acceleration_m_s2.size)
    a, b = (r.acceleration_m_s2[:count] for r in (record, other))
    energy = np.cumsum(a**2 + b**2)
    first, last = np.searchsorted(energy / energy[-1], [QUIET, 1.0 - QUIET])
    along, across = (math.sqrt(0.5) * (a + s * b)[first : last + 1] for s in (1.0, -1.0))
    demand = RecordDemand(along, record.dt_s)
    known, slv_g, onset_g = by_hand(geometry, demand)
    time_s, out = floor_of(along, record.dt_s, known.place)
    beside = floor_of(across, record.dt_s, known.place)[1]
    stood, fell, twist, factor = 0.0, math.inf, 0.0, 0.5 * slv_g / demand.pga_g
    tries = 0
    while factor * demand.pga_g < MOST * slv_g and tries < 12:
        (run,) = shaken(geometry, (time_s, out, beside), [factor])
        tries += 1
        if run["status"] == "ok":
            stood, twist = factor, run["twist_rad"]
        else:
            fell = factor
        if math.isfinite(fell) and (stood == 0.0 or fell / stood < 1.1):
            break
        factor = CLIMB * stood if math.isinf(fell) else math.sqrt(fell * (stood or 0.5 * fell))
    return stood * demand.pga_g, fell * demand.pga_g, slv_g, onset_g, twist


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--geometries", type=int, nargs="*", default=[0, 1, 2, 3])
    parser.add_argument("--stations", type=int, nargs="*", default=list(range(STATIONS)))
    given = parser.parse_args()
    every = pairs()
    for k in given.geometries:
        for s in given.stations:
            began = time.perf_counter()
            values = curve(GEOMETRIES[k], every[s])
            seconds = time.perf_counter() - began
            print(k, *every[s], *(f"{v:.4f}" for v in values), f"{seconds:.0f}", flush=True)


if __name__ == "__main__":
    from record_files.record import Record
    from rocking.configuration import config
    from rocking.records import load
    from rocking.records.floors import chain_motions
    from rocking.records.table import read_table
    from studies.assess import checks
    from studies.assess.demand import RecordDemand
    from studies.assess.family import Family
    from studies.assess.slv import Slv
    from yade_process import in_yade

    SMDOF = config.resolve({})["smdof"]
    SMDOF_DENSITY = config.resolve({})["facade"]["density_kg_m3"]
    main()
