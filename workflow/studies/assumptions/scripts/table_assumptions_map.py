"""Error of one-way coupling before many buildings: ratios to two-way coupling, all records."""

from rocking.runtime.script import run
from rocking.tables import read_tables, write_table
from studies.assumptions.study import spread_of

KEY = ["record", "direction", "period_s", "damping_ratio"]
MEASURES = {
    f"pga_{name}_g": f"ratio_{name}" for name in ("collapse", "median", "equivalent", "all")
}


def main(job):
    table = read_tables(job.input.curves)
    one_way = table[table["mass_ratio"] == 0.0].set_index(KEY)[[*MEASURES]]
    two_way = table[table["mass_ratio"] > 0.0].join(one_way, on=KEY, rsuffix="_one_way")
    for column, name in MEASURES.items():
        two_way[name] = two_way[f"{column}_one_way"] / two_way[column]
    by = ["damping_ratio", "period_s", "mass_ratio"]
    found = spread_of(two_way.sort_values(by), [*MEASURES.values()], by)
    write_table(found, job.output[0], digits="%.4f")


run(main, globals())
