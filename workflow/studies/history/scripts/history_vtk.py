"""One history as VTK files for ParaView."""

import json

from rocking.runtime.script import run
from rocking.tables import read_json
from studies.history import paraview


def main(job):
    frames = read_json(job.input.frames)
    config = json.loads(job.params.config)
    paraview.write(job.output.collection, frames, config["return_wall"]["count"], config)


run(main, globals())
