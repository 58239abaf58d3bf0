"""Dense scan of one curve of the complete building, by its reduction to few coordinates."""

import json

from rocking.accuracy.fidelity import choose, read_fidelity
from rocking.building.complete import run_numerics, scene_of
from rocking.building.reduced import ReducedScan
from rocking.collapse import search
from rocking.runtime.script import run
from rocking.tables import headed, write_table

from yade_scripts.model import floor_motions
from yade_scripts.studies.perturb import NODE_CHOICES


def main(job):
    config, w = json.loads(job.params.config), job.wildcards
    own = config["complete"]
    config["numerics"], _ = choose(config, "W2", read_fidelity(job.input.fidelity))
    layouts = [scene_of(config, job, w.complete, extra_nodes=n)[0] for n in range(NODE_CHOICES)]
    time_s, columns = floor_motions.read(job.input.motion)
    screen = ReducedScan(
        layouts, own["modes"], run_numerics(config), time_s, columns["ground"], w.direction
    )
    settings = {**job.params.settings, **own["scan"]}
    table, _ = screen.seen(search.scan(0.5 * screen.static_g, settings))
    named = headed(table, model=w.complete, record=w.record, direction=w.direction)
    write_table(named, job.output[0])


run(main, globals())
