"""Scene file of a full scene under two components."""

import json
from pathlib import Path

from rocking.runtime.script import run
from rocking.studies.two_components import full


def main(job):
    scene = full(json.loads(Path(job.input.scene).read_text()), job.params.settings)
    Path(job.output[0]).write_text(json.dumps(scene, indent=1, sort_keys=True) + "\n")


run(main, globals())
