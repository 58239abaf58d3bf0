"""Do histories that end early have the peaks of whole motions? Every scanned model, bit by bit.

    .venv/bin/python tests/trials/early_ends.py --output ends.csv --seed 6 --curves 60

A curve is a drawn façade (`OPTIONS`: rigid block, courses, hinges, friction, vertical motion, a
tie, a floor, a building that yields), a recorded motion and a direction: `--each` amplitudes from
0.3 to 1.3 of the lowest collapse that a climb finds, once as a scan runs them (`solver.runs.Brief`)
and once to the end of their motions. A line says how many outcomes and peaks differ, how far what
later swings could come to (`collapse.hidden`) does, and the processor time of both. W3 and W3m,
without a climb, have a tenth of the amplitudes. 60 curves of W1, W2 and W2m take two minutes.
"""

import argparse
import time
from pathlib import Path

import numpy as np
import pandas as pd
from rocking import Case, Motion
from rocking.collapse import hidden, search
from rocking.collapse.curve import run_by
from rocking.collapse.scan import marched
from rocking.configuration.schema import ConfigError
from rocking.configuration.study import as_in_the_study
from rocking.tables import write_table

from yade_scripts.model import registry

SUITE = Path(__file__).resolve().parents[2] / "config/suites/recorded_suite.tsv"
COURSES = {"facade.courses": 4, "facade.courses_growth": 1.5}
OPTIONS = (
    {"facade.courses": 0},
    {"facade.courses": 0, "facade.hinges_m": [4.0]},
    {"facade.courses": 0, "smdof.base_shear_ratio": 0.15},
    COURSES,
    COURSES | {"facade.friction_deg": 12.0},
    COURSES | {"smdof.base_shear_ratio": 0.2},
    COURSES | {"vertical_motion": "on"},
    COURSES | {"facade.ties": [{"height_m": 6.0, "diameter_mm": 20}]},
    COURSES | {"facade.floors": [{"height_m": 3.0, "load_kn": 40, "friction": 0.4}]},
)
BRICKS_G = 0.35  # beside which W3's amplitudes lie
CLIMB = {"level_ratio": 0.05, "beyond": 1.0, "max_pga_g": 3.0}
SHARES = (0.3, 1.3)  # of the lowest collapse
COLUMNS = [
    "number",
    "model",
    "record",
    "direction",
    "options",
    "histories",
    "fell",
    "other_outcome",
]
COLUMNS += ["other_peak", "reach_apart", "early_s", "whole_s"]


def drawn(number, seed, models):
    """Case, motion, direction and what was drawn of a curve; None where no façade has it all."""
    draw = np.random.default_rng([seed, number])
    options = dict(OPTIONS[int(draw.integers(len(OPTIONS)))])
    vertical = options.pop("vertical_motion", "off")
    options["facade.thickness_m"] = float(f"{draw.uniform(0.3, 0.9):.3g}")
    options["return_wall.building_mass_kg"] = float(f"{draw.uniform(4e4, 1.2e5):.3g}")
    name, direction = str(draw.choice(sorted(_names()))), str(draw.choice(["pos", "neg"]))
    try:
        case = Case.configured(models[number % len(models)], as_in_the_study(options))
    except ConfigError:
        return None
    motion = Motion.named(name, SUITE, vertical_motion=vertical)
    return case, motion, direction, options | {"vertical_motion": vertical}


def _names():
    return pd.read_csv(SUITE, sep="\t", comment="#")["record"]


def _both(screen, pga_g):
    """Outcomes, swings and processor time [s] of a screen as it is, and of whole motions."""
    for early in (True, False):
        for one in filter(None, (screen, screen.carrying)) if not early else ():
            one.numerics = {**one.numerics, "brief": None}
        began = time.process_time()
        ((table, swings),) = marched([(screen, pga_g, False)])
        yield table, swings, time.process_time() - began


def compared(case, motion, direction, each):
    """What differs between histories that end early and whole ones."""
    screen = run_by("planar", case, motion, direction)
    low, count = BRICKS_G, each // 10
    if registry.model(case.model).single_block:
        levels, _ = screen.seen(search.climb(0.5 * screen.static_g, CLIMB))
        fell, count = levels.loc[levels["collapsed"] == 1, "pga_g"], each
        low = fell.min() if len(fell) else CLIMB["max_pga_g"]
    pga_g = low * np.geomspace(*SHARES, count)
    (early, swings, early_s), (whole, later, whole_s) = _both(screen, pga_g)
    stood = (whole["status"] == "ok").to_numpy()
    reach = [hidden.reach(pga_g[stood], rows[stood], pga_g.min()) for rows in (swings, later)]
    return {
        "histories": count,
        "fell": int((whole["status"] == "overturned").sum()),
        "other_outcome": int((early["status"] != whole["status"]).sum()),
        "other_peak": int((early["d_over_b"][stood] != whole["d_over_b"][stood]).sum()),
        "reach_apart": float(np.nan_to_num(np.abs(np.subtract(*reach))).max(initial=0.0)),
        **{"early_s": early_s, "whole_s": whole_s},
    }


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--output", type=Path, required=True)
    parser.add_argument("--seed", type=int, default=6)
    parser.add_argument("--curves", type=int, default=60)
    parser.add_argument("--each", type=int, default=64)
    parser.add_argument("--models", nargs="+", default=["W1", "W2", "W2m"])
    args = parser.parse_args()
    rows = []
    for number in range(args.curves):
        if (curve := drawn(number, args.seed, args.models)) is None:
            continue
        case, motion, direction, options = curve
        row = {"number": number, "model": case.model, "record": motion.name, "direction": direction}
        said = " ".join(f"{key}={value}" for key, value in options.items())
        rows.append({**row, "options": said, **compared(case, motion, direction, args.each)})
        write_table(rows, args.output, COLUMNS)
    table = pd.DataFrame(rows, columns=COLUMNS)
    print(table.groupby("model")[COLUMNS[5:]].sum().to_string())
    print(f"largest reach_apart {table['reach_apart'].max():.3g}")


if __name__ == "__main__":
    main()
