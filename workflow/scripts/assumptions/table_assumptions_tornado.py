"""What each assumption of a model is worth: collapse with it over collapse as configured."""

from rocking.runtime.script import run
from rocking.studies import assumptions
from rocking.tables import read_tables, write_table

KEY = ["record", "direction"]
WHAT = ["model", *KEY, "assumption", "level"]
MEASURES = ("collapse", "median")
RUNS = "runs"


def main(job):
    table = read_tables(job.input.curves)
    table = table.rename(columns={"runs_planar": RUNS})
    base = table[table["assumption"] == assumptions.BASE].set_index(KEY)
    table = table.set_index(KEY)
    for name in MEASURES:
        column = f"pga_{name}_g"
        table[f"ratio_{name}"] = table[column] / base[column].reindex(table.index)
    middle = base["pga_median_g"].reindex(table.index)
    table["ratio_p10"] = table["pga_p10_g"] / middle
    table["ratio_p90"] = table["pga_p90_g"] / middle
    columns = [
        *WHAT,
        *assumptions.CAPACITY,
        *(f"ratio_{m}" for m in (*MEASURES, "p10", "p90")),
        RUNS,
    ]
    write_table(table.reset_index()[columns], job.output[0], digits="%.4f")


run(main, globals())
