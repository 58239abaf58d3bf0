"""Annual rate of collapse of every model at a site, its probability in time, and by intensity.

Of a building that yields also its own rate. Writes tables/risk.csv and risk/deaggregation.csv.
"""

from rocking.runtime.script import run
from rocking.tables import read_frame, write_table
from studies.risk.collapse import BUILDING, COLUMNS, PARTS, beside_building, risk_of
from studies.risk.fragility_tables import SHARE, building_shares, shares
from studies.shared.hazard import read_hazard


def main(job):
    risk, settings = job.params.risk, job.params.fragility
    hazard = read_hazard(str(job.input.hazard), job.params.period_s, risk["site"])
    brackets, factors, collapse, dense = (
        read_frame(job.input[name]) for name in ("brackets", "factors", "collapse", "probability")
    )
    brackets = brackets[(brackets["im"] == hazard.measure) & (brackets["reading"] == SHARE)]
    known = factors[factors["im"] == hazard.measure].set_index("record")
    rows, parts = [], []
    for model, of_model in collapse.groupby("model", sort=False):
        curves = shares(of_model, dense, known["per_pga"])
        mine = brackets[brackets["model"] == model]
        row, bins = risk_of(model, curves, known["station"], mine, hazard, risk, settings)
        built = building_shares(of_model, dense, known["per_pga"])
        rows.append(row | beside_building(built, known["station"], hazard, risk, settings))
        parts += bins
    write_table(rows, job.output.table, [*COLUMNS, *BUILDING])
    write_table(parts, job.output.deaggregation, PARTS)


run(main, globals())
