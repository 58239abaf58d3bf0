"""Dense scan of one curve of the complete building by its reduction, and where YADE is to look."""

import json

from rocking.collapse import search
from rocking.configuration.files import read_yaml
from rocking.fidelity import choose
from rocking.runtime.script import run
from rocking.tables import headed, read_frame, write_json, write_table
from studies.building.complete import plan_of, run_numerics, scene_of
from studies.building.reduced import ReducedScan

from yade_scripts.commands.perturb import NODE_CHOICES
from yade_scripts.model import floor_motions


def main(job):
    config, w = json.loads(job.params.config), job.wildcards
    section = config["complete"]
    config["numerics"], _ = choose(config, "W2", read_yaml(job.input.fidelity))
    layouts = [scene_of(config, job, w.complete, extra_nodes=n)[0] for n in range(NODE_CHOICES)]
    time_s, columns = floor_motions.read(job.input.motion)
    screen = ReducedScan(
        layouts, section["modes"], run_numerics(config), time_s, columns["ground"], w.direction
    )
    settings = {**job.params.settings, **section["scan"]}
    table, _ = screen.seen(search.scan(0.5 * screen.static_g, settings))
    named = headed(table, model=w.complete, record=w.record, direction=w.direction)
    write_table(named, job.output.scan)
    kept = read_frame(job.output.scan)  # as every reader has it
    plan = plan_of(
        kept, job.params.settings["amplitude_spread"], section["level_ratio"], job.params.most
    )
    write_json(job.output.plan, plan, indent=None, sort_keys=True)


run(main, globals())
