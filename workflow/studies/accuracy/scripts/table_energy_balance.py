"""Where the energy of each run went, and what is missing (tables/energy_balance.csv)."""

from rocking.runtime.script import run
from rocking.tables import read_frame, write_table

TERMS = (
    "input_j",
    "kinetic_j",
    "potential_j",
    "elastic_j",
    "dashpots_j",
    "friction_j",
    "fracture_j",
)


def main(job):
    rows = []
    for path in job.input.histories:
        history = read_frame(path)
        facts = history.iloc[0][["model", "record", "direction", "pga_g", "status", "dt_s"]]
        worst = history["residual_j"].abs().max()
        rows.append(
            {
                **facts,
                **history.iloc[-1][list(TERMS)],
                "largest_residual_j": worst,
                "residual_over_input": worst / history["input_j"].abs().max(),
                "residual_over_overturning": worst / history["overturning_j"].iloc[0],
            }
        )
    write_table(rows, job.output[0])


run(main, globals())
