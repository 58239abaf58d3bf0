"""Static capacities by model, and of W3 by variant, beside the closed forms."""

from pathlib import Path

from rocking.pushover import complete_curve, friction_moment_ratio, joint_forces, summary
from rocking.runtime.script import run
from rocking.tables import read_frame, read_json, write_table

from yade_scripts.model import registry


def main(job):
    rows = []
    for path in job.input.curves:
        model = Path(path).stem
        rows.append(
            {"case": model, **summary(read_frame(path), bonded=registry.model(model).bonded)}
        )
    for scene, raw, forces in zip(job.input.cases, job.input.raw, job.input.forces, strict=True):
        config = read_json(scene)
        row = summary(complete_curve(read_frame(raw), config, "W3"))
        ratio = friction_moment_ratio(joint_forces(read_frame(forces), config))
        part = ratio[(ratio.index > 0.02) & (ratio.index < 0.1)]
        rows.append({"case": f"W3 {Path(scene).stem}", **row, "friction_moment_ratio": part.mean()})
    write_table(rows, job.output[0])


run(main, globals())
