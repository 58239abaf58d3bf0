"""What every premise of a driven model is worth: collapse with it over collapse as configured."""

from pathlib import Path

import pandas as pd
from rocking.curves import collapse, premises
from rocking.curves.ida import curve_key, read_curve
from rocking.runtime.script import run

KEY = ["record", "direction"]
WHAT = ["model", *KEY, "premise", "level"]
MEASURES = ("collapse", "median")
RUNS = "runs"


def of_curves(paths, model, spread):
    """Rows of analyses in YADE; the variant is the folder."""
    known = premises.variants(model)
    for path in paths:
        curve = read_curve(path)
        variant = known.get(Path(path).parent.name)
        what = (premises.BASE, "") if variant is None else (variant.premise, variant.level)
        _, record, direction = curve_key(curve)
        found = collapse.summary(None, curve, (), spread)
        named = dict(zip(WHAT, (model, record, direction, *what), strict=True))
        yield {**named, **{k: found[k] for k in premises.CAPACITY}, RUNS: len(curve)}


def main(job):
    if job.params.planar:
        table = pd.concat([pd.read_csv(path) for path in job.input.curves])
        table = table.rename(columns={"runs_planar": RUNS})
    else:
        rows = of_curves(job.input.curves, job.wildcards.model, job.params.spread)
        table = pd.DataFrame(list(rows))
    base = table[table["premise"] == premises.BASE].set_index(KEY)
    table = table.set_index(KEY)
    for name in MEASURES:
        column = f"pga_{name}_g"
        table[f"ratio_{name}"] = table[column] / base[column].reindex(table.index)
    middle = base["pga_median_g"].reindex(table.index)
    table["ratio_p10"] = table["pga_p10_g"] / middle
    table["ratio_p90"] = table["pga_p90_g"] / middle
    columns = [*WHAT, *premises.CAPACITY, *(f"ratio_{m}" for m in (*MEASURES, "p10", "p90")), RUNS]
    table.reset_index()[columns].to_csv(
        job.output[0], index=False, float_format="%.4f", lineterminator="\n"
    )


run(main, globals())
