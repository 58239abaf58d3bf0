"""Scene file of W3 with one premise at another level, and the climb of its short analysis."""

import json
from pathlib import Path

from rocking.calibration.beta import beta_for
from rocking.curves.premises import BASE, Variant, variants, varied
from rocking.runtime.script import run


def main(job):
    scene = json.loads(Path(job.input.scene).read_text())
    stage = json.loads(Path(job.input.stage).read_text())
    known = {"base": Variant("base", BASE, ""), **variants(scene["model"])}
    case = varied(scene, known[job.wildcards.variant], stage)
    case["beta_s"] = beta_for(case, job.input.law)
    # up to the first collapse and back to its bracket: one run at half of it seeks islands
    case["ida"] |= {"growth": job.params.growth, "search_ratio": 0.5, "beyond_collapse": 0}
    with open(job.output[0], "w") as handle:
        json.dump(case, handle, indent=1, sort_keys=True)
        handle.write("\n")


run(main, globals())
