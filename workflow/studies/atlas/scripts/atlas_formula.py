"""The formula that is fitted to an atlas, as its file, and the façades of the design.

Writes formula.json, which `rocking.estimate` and the page read, and tables/atlas_facades.csv.
"""

from rocking import Case
from rocking.records import read_csv
from rocking.runtime.script import run
from rocking.tables import read_frame, write_json, write_table
from studies.atlas import fit
from studies.atlas.measures import factors
from studies.atlas.study import described, design


def main(job):
    settings, table = job.params.settings, read_frame(job.input.table)
    facades = described(Case.read(job.input.case), design(settings), job.input.law)
    table = table[table["facade"].isin(facades.index)]
    records = [read_csv(path) for path in job.input.records]
    made_of = {
        "base": job.params.base,
        "seed": settings["seed"],
        "ranges": settings["ranges"],
        "others": settings["others"],
        "records": [record.name for record in records],
        "directions": job.params.directions,
        "damping_ratio": job.params.damping_ratio,
    }
    given = factors(records, facades, job.params.damping_ratio)
    formula = fit.law(table, facades, given, job.params.stations, made_of)
    write_json(job.output.formula, formula)
    write_table(facades.reset_index(), job.output.facades)


run(main, globals())
