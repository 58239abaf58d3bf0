"""Figure 1: geometry of the building and its brick models CBDEM and SBDEM."""

import matplotlib.pyplot as plt
from rocking.figures import style
from rocking.runtime.script import run
from studies.building import drawing
from studies.building.case import build_model, read_plan


def main(job):
    settings = dict(job.params.building)
    plan = read_plan(job.input.plan)
    walls = [w for w in plan.walls if not w.facade][:2]
    figure = plt.figure(figsize=(7.0, 7.4))
    top, bottom = figure.subfigures(2, 1, height_ratios=(1.0, 1.7))
    axes = top.subplots(1, 1 + len(walls))
    drawing.plan_view(axes[0], plan, f"(a) plan of '{plan.name}' [m]")
    for ax, wall in zip(axes[1:], walls, strict=True):
        drawing.elevation(ax, wall, f"wall '{wall.name}' [m]")
    axes = bottom.subplots(1, 2)
    for ax, model, letter in zip(axes, ("CBDEM", "SBDEM"), "bc", strict=True):
        building = build_model(settings, plan, model, 0.0)
        lifted = [building.scene.monitor] if model == "SBDEM" and plan.floors else []
        drawing.draw(ax, building, without=lifted)
        ax.set_title(
            f"({letter}) {model}: {len(building.bricks)} bricks, about"
            f" {building.brick.length_m:.2f} × {building.brick.height_m:.2f}"
            f" × {building.brick.width_m:.2f} m"
            + ("\n(one floor panel lifted off to show its beams)" if lifted else "")
        )
    style.save(figure, job.output)


run(main, globals())
