"""WME of equal chains n = 1 … 5 against SBDEM, and the chain they choose.

That also as a configuration file, which gives the chain to the façade stage.
"""

import pandas as pd
from rocking.records import read_csv
from rocking.runtime.script import run
from rocking.tables import write_table
from studies.building.case import translation_mode
from studies.building.comparison import PAPER_WME, QUANTITIES, against_chains, choose_n
from studies.building.modes import Modes


def main(job):
    settings = dict(job.params.building)
    modes = Modes.load(job.input.modes)
    mode = translation_mode(modes)
    period = float(modes.period_s[mode])
    rows = []
    files = zip(job.params.records, job.input.histories, job.input.records, strict=True)
    for name, history, motion in files:
        _, chains = against_chains(history, read_csv(motion), period, settings)
        for n, (_, errors) in chains.items():
            for quantity in QUANTITIES:
                paper = PAPER_WME.get((quantity, name))
                known = paper[n - 1] if paper and job.params.paper else None
                rows.append((name, n, quantity, errors[quantity], known))
    table = pd.DataFrame(rows, columns=["record", "n_dof", "quantity", "wme", "wme_paper"])
    write_table(table, job.output.wme)
    chosen = choose_n(zip(table["n_dof"], table["wme"], strict=True), settings["wme_gain"])
    chain = pd.DataFrame(
        [(period, mode + 1, modes.effective_ratio[mode, 1], chosen, settings["wme_gain"])],
        columns=["t1_s", "mode", "effective_mass_ratio", "n_dof", "wme_gain"],
    )
    write_table(chain, job.output.chain)
    with open(job.output.config, "w", encoding="utf-8") as handle:
        handle.write(
            "# Chain equivalent to this building; give it to the façade stage with --configfile.\n"
            f"smdof:\n  n_dof: {chosen}\n  period_s: {period:.6g}\n"
        )


run(main, globals())
