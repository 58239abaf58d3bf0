"""What a building's strength does to half collapse: façades of the atlas, drawn, fitted, checked.

    .venv/bin/python tests/trials/yielding/formula.py draw --output fit.csv --seed 71 --count 12
    .venv/bin/python tests/trials/yielding/formula.py draw --output check.csv --seed 72 --count 10
    .venv/bin/python tests/trials/yielding/formula.py fit fit.csv check.csv --law law.json

Façades are those of the ranges of the atlas (`studies.atlas.study.design`), each before an elastic
building and buildings of V/W 0.10, 0.18 and 0.32, under six recorded components that are drawn for
it, in turns of direction, by short climbs. `--courses` takes the wall in four courses, `--ratios`
other V/W, `--records` the motions of a table, both ways, in place of those drawn. Curves that
`--output` holds are not run again, and none begins after `--minutes`. The fit
(`rocking.formula.yielding`) is of the mean over the motions of the logarithm of yielding over
elastic; s and a by model, and with `--suite` to the default façade under the whole suite too.
Tables that follow the first check it; the standard error written to the file is the root of the
mean square of the first of them.
"""

import argparse
import json
import math
import time
from pathlib import Path

import numpy as np
import pandas as pd
from rocking import Case, Motion
from rocking.collapse.quick import crossings
from rocking.formula import groups, law
from rocking.records import read_table
from rocking.tables import write_table
from scipy.optimize import least_squares
from studies.atlas import study as atlas

SUITE = "config/suites/recorded_suite.tsv"
RATIOS, MODELS, MOTIONS, MOST_G = (0.10, 0.18, 0.32), ("W2", "W2m"), 6, 4.0
OWN = {"damping.law": "value", "smdof.base_shear_ratio": None}
FOUR = {"facade.courses": 4, "facade.courses_growth": 1.5}
KEY = ["facade", "model", "record", "direction"]


def shaken(number, args):
    """Records and directions of one façade: six of the suite, or all of a table both ways."""
    if args.records:
        return [(name, way) for name in read_table(args.records) for way in ("pos", "neg")]
    drawn = np.random.default_rng([args.seed, number]).choice(
        list(read_table(SUITE)), MOTIONS, False
    )
    return [(str(name), "pos" if (number + k) % 2 else "neg") for k, name in enumerate(drawn)]


def curve_rows(case, key, design, args):
    """Half collapse of one façade under one motion by strength."""
    motion, rows = Motion.named(key["record"], args.records or SUITE), []
    for ratio in (None, *args.ratios):
        one = case.varied({"smdof.base_shear_ratio": ratio})
        found = crossings(one, motion, key["direction"], {"max_pga_g": MOST_G})
        about = {"courses": int(args.courses), "ratio": ratio, "half_g": found["pga_median_g"]}
        rows.append(key | about | {name: design[name] for name in atlas.DIMENSIONS})
    return rows


def draw(args):
    """Write the curves of some drawn façades, both models of a motion after each other."""
    until = time.monotonic() + 60.0 * args.minutes
    settings = {"seed": args.seed, "facades": args.count, "ranges": law.read()["made_of"]["ranges"]}
    rows = pd.read_csv(args.output).to_dict("records") if args.output.exists() else []
    known = {tuple(row[name] for name in KEY) for row in rows}
    walls = FOUR if args.courses else {"facade.courses": 0}
    own = {model: Case.configured(model, walls | OWN) for model in MODELS}
    for number, design in enumerate(atlas.design(settings).to_dict("records")):
        for name, way in shaken(number, args):
            for model in MODELS:
                key = dict(zip(KEY, (number, model, name, way), strict=True))
                if tuple(key.values()) in known or time.monotonic() > until:
                    continue
                rows += curve_rows(atlas.facade(own[model], design), key, design, args)
                write_table(rows, args.output, digits="%.8g")


def ratios(path):
    """A row a façade, model and strength: PGA of the elastic one, and ln of what yielding does.

    `lost` is what the walls' motion costs by the formula, ln of W1 over the model; façades that it
    does not describe are left out.
    """
    table, rows = pd.read_csv(path), []
    lost = {key: _lost(key[1], part.iloc[0]) for key, part in table.groupby(KEY[:2])}
    elastic = table[table["ratio"].isna()].set_index(KEY)["half_g"]
    for (number, model, ratio), own in table.dropna(subset="ratio").groupby(KEY[:2] + ["ratio"]):
        first = elastic.loc[number, model].reindex(pd.MultiIndex.from_frame(own[KEY[2:]]))
        first = first.to_numpy()
        both = np.isfinite(first) & np.isfinite(own["half_g"].to_numpy())
        first, second = np.log(first[both]), np.log(own["half_g"].to_numpy()[both])
        row = {"facade": number, "model": model, "ratio": ratio, "curves": int(both.sum())}
        row |= {"lost": lost[number, model]}
        row |= {"pga_g": float(np.exp(first.mean()))}
        rows.append(row | {"ln_ratio": float((second - first).mean())})
    return pd.DataFrame(rows).dropna(subset="lost")


def _lost(model, design):
    """ln of half collapse of W1 over that of a model, elastic, by the formula of a block on E/h."""
    wall = design.get("courses", 0)
    own = Case.configured(model, {**(FOUR if wall else {"facade.courses": 0}), **OWN})
    row = groups.dimensions(atlas.facade(own, design[list(atlas.DIMENSIONS)].to_dict()))
    base = "courses" if wall else "study"
    try:
        ground, moved = (law.said(row, name, "pga_g", base)[0] for name in ("W1", model))
    except groups.OutsideError:
        return math.nan
    return math.log(ground / moved)


def of_the_suite(path):
    """The same of the default façade in courses, of a `yielding_summary.csv` of the whole suite."""
    table, rows = pd.read_csv(path), []
    keys = {**FOUR, **OWN, "return_wall.building_mass_kg": 64e3}
    for one in table[table["loops"] == "bilinear"].itertuples():
        row = groups.dimensions(Case.configured(one.model, keys))
        ground, own = (law.said(row, name, "pga_g", "courses")[0] for name in ("W1", one.model))
        about = {"facade": -1, "model": one.model, "ratio": one.base_shear_ratio}
        about |= {"curves": one.curves, "pga_g": own, "lost": math.log(ground / own)}
        rows.append(about | {"ln_ratio": math.log(one.over_elastic)})
    return pd.DataFrame(rows)


def predicted(given, table):
    """ln r of s and a."""
    s, a = given
    x = np.log(table["pga_g"] / table["ratio"]) + a
    return s * np.maximum(0.0, table["lost"]) * np.maximum(0.0, x)


def fitted(table):
    """s and a by least squares, each row by its number of curves; the best of some beginnings."""
    weight = np.sqrt(table["curves"])
    found = [
        least_squares(lambda p: weight * (predicted(p, table) - table["ln_ratio"]), (s, a))
        for s in (0.4, 0.8)
        for a in (0.0, 0.5, 1.0)
    ]
    return min(found, key=lambda one: one.cost).x


def fit(args):
    """Fit to the first table, check by the others, write the law."""
    first, *others = [(path, ratios(path)) for path in args.tables]
    suite = [(args.suite, of_the_suite(args.suite))] if args.suite else []
    models, known = {}, pd.concat([first[1], *(table for _, table in suite)])
    for model in MODELS:
        given = fitted(known[known["model"] == model])
        errors = []
        for path, table in (first, *others, *suite):
            part = table[table["model"] == model]
            off = predicted(given, part) - part["ln_ratio"]
            errors.append(float(np.sqrt(np.mean(off**2))))
            print(
                f"{model} {path}: {len(part)} of {part['facade'].nunique()} façades, rms "
                f"{errors[-1]:.3f} of {np.sqrt(np.mean(part['ln_ratio'] ** 2)):.3f}, mean "
                f"{off.mean():+.3f}, largest {off.abs().max():.3f}"
            )
        models[model] = dict(zip("sa", (round(float(v), 4) for v in given), strict=True))
        models[model]["error"] = round(errors[1] if others else errors[0], 4)
        print(model, models[model])
    made = {"facades": int(known["facade"].nunique()), "motions": MOTIONS, "loops": "bilinear"}
    text = {"lowest": min(RATIOS), "made_of": made, "models": models}
    if args.law:
        args.law.write_text(json.dumps(text, indent=1) + "\n", encoding="utf-8")


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    verbs = parser.add_subparsers(required=True)
    one = verbs.add_parser("draw")
    one.add_argument("--output", type=Path, required=True)
    one.add_argument("--seed", type=int, required=True)
    one.add_argument("--count", type=int, default=8)
    one.add_argument("--courses", action="store_true", help="the wall in four courses")
    one.add_argument("--ratios", type=float, nargs="+", default=RATIOS, help="V/W")
    one.add_argument("--records", help="table of motions in place of those drawn")
    one.add_argument("--minutes", type=float, default=math.inf, help="begin no curve after")
    one.set_defaults(does=draw)
    two = verbs.add_parser("fit")
    two.add_argument("tables", type=Path, nargs="+")
    two.add_argument("--suite", type=Path, help="yielding_summary.csv that is fitted to as well")
    two.add_argument("--law", type=Path, help="file to write")
    two.set_defaults(does=fit)
    args = parser.parse_args()
    args.does(args)


if __name__ == "__main__":
    main()
