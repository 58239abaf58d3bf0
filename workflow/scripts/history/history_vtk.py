"""One history as VTK files for ParaView."""

import json
from pathlib import Path

from rocking.figures import paraview
from rocking.runtime.script import run


def main(job):
    frames = json.loads(Path(job.input.frames).read_text())
    config = json.loads(job.params.config)
    paraview.write(job.output.collection, frames, config["return_wall"]["count"], config)


run(main, globals())
