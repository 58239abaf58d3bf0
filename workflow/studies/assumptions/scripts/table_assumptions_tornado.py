"""What each assumption of a model is worth: collapse with it over collapse as configured."""

from rocking.runtime.script import run
from rocking.tables import read_tables, write_table
from studies.assumptions import study as assumptions

WHAT = ["model", *assumptions.KEY, "assumption", "level"]
RATIOS = {  # of which intensity, over which of the base
    "ratio_equivalent": ("pga_equivalent_g", "pga_equivalent_g"),
    "ratio_collapse": ("pga_collapse_g", "pga_collapse_g"),
    "ratio_median": ("pga_median_g", "pga_median_g"),
    "ratio_p10": ("pga_p10_g", "pga_median_g"),
    "ratio_p90": ("pga_p90_g", "pga_median_g"),
}


def main(job):
    table = read_tables(job.input.curves)
    table = table.rename(columns={"runs_planar": "runs"})
    base = table[table["assumption"] == assumptions.BASE].set_index(assumptions.KEY)
    base = table[assumptions.KEY].join(base[assumptions.CAPACITY], on=assumptions.KEY)
    for name, (own, other) in RATIOS.items():
        table[name] = table[own] / base[other]
    columns = [*WHAT, *assumptions.CAPACITY, *RATIOS, "runs"]
    write_table(table, job.output[0], columns, digits="%.4f")


run(main, globals())
