"""How often the code's kinematic and dynamic check of one façade disagree, and which way.

And, of façades whose first mechanism by hand is a part of them: how often the whole alone would
have been safe.
"""

import json

from rocking.runtime.script import run
from rocking.tables import read_frame, read_tables, together, write_table
from studies.assess.comparison import disagreements, parts_against_whole


def main(job):
    facts, parts, collapse = json.loads(job.params.runs), [], []
    for name, about in facts.items():  # in another order than the rule's inputs
        known = {key: about[key] for key in ("height_m", "slenderness", "period_s")}
        parts.append(read_frame(about["levels"]).assign(run=name, **known))
        for files in (about["collapse"], about["parts"]):
            collapse.append(read_tables(files).assign(run=name))
    levels = together(parts)
    write_table(levels, job.output.levels)
    partly = set(levels.loc[levels["part"] != "whole", "run"])
    write_table(disagreements(levels[~levels["run"].isin(partly)]), job.output.table)
    write_table(parts_against_whole(levels, together(collapse)), job.output.parts)


run(main, globals())
