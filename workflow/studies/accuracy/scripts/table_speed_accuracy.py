"""Error and speed of every run, their spread by method, nodes and step, and the fidelity."""

import pandas as pd
import yaml
from rocking.fidelity import fidelity_table
from rocking.runtime.script import run
from rocking.tables import read_frame, read_json, write_table
from studies.accuracy.errors import TABLE_COLUMNS, chosen_pair, errors, summary
from studies.accuracy.histories import CHOOSING

HEADER = (
    "# Error in d/b that {share:.3g} % of the repeating histories keep, by nodes and step,\n"
    "# cheapest first (rocking/fidelity.py: fidelity_table). Written by\n"
    "# `snakemake accuracy` to accuracy/fidelity.yaml of its run.\n"
)


def main(job):
    settings = job.params.accuracy
    plan = read_json(job.input.plan)
    scenes = {m: read_json(path) for m, path in plan["scenes"].items()}
    histories = read_frame(job.input.histories)
    adaptive = read_frame(job.input.reference)
    histories["d_over_b_compiled"] = histories["d_over_b"]
    exact = adaptive.set_index("case")["d_over_b"]
    histories["d_over_b"] = histories["case"].map(exact).fillna(histories["d_over_b"])
    runs = pd.concat([*(read_frame(path) for path in job.input.runs), adaptive], ignore_index=True)
    defaults = {model: chosen_pair(scene) for model, scene in scenes.items()}
    table = errors(runs, histories, defaults)
    table = table.sort_values(["scene", "method", "nodes", "dt_over_dt_crit"])
    choosing = table[(table["half"] == CHOOSING) & (table["repeats"] == 1)]
    fidelity = fidelity_table(choosing, settings["fidelity_share"], settings["fewest_nodes"])
    for name, content in (("table", table[list(TABLE_COLUMNS)]), ("summary", summary(table))):
        write_table(content, job.output[name])
    with open(job.output.fidelity, "w", encoding="utf-8") as handle:
        handle.write(HEADER.format(share=100 * settings["fidelity_share"]))
        yaml.safe_dump(fidelity, handle, sort_keys=True, default_flow_style=None)


run(main, globals())
