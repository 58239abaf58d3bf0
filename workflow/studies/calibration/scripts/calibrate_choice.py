"""What the law of β changes in an IDA: curves and collapse intensities."""

import matplotlib.pyplot as plt
from rocking.collapse import probability
from rocking.collapse.ida import branches, read_curve
from rocking.figures import style
from rocking.runtime.script import run
from rocking.tables import read_frame, read_json, write_table

COLOURS = {"eq5": "#0072B2", "fitted": "#D55E00"}
NAMES = {"eq5": "eq. 5", "fitted": "fitted law"}
COLUMNS = ("model", "record", "direction", "law", "beta_s")
CAPACITY = ("pga_safe_g", "pga_collapse_g", "pga_median_g")


def main(job):
    rows, curves = [], {}
    record = style.provenance(read_json(job.input.facts))
    inputs = zip(job.input.cases, job.input.ida, job.input.scans, strict=True)
    for scene_path, path, scan_path in inputs:
        scene = read_json(scene_path)
        curve = read_curve(path)
        stood, fell = branches(curve)
        # YADE runs few levels once they confirm the scan: where it falls, both say
        found = probability.summary(read_frame(scan_path), curve, curve.iloc[:0], job.params.spread)
        collapse = found["pga_collapse_g"]
        key = scene["model"], curve["direction"].iloc[0]
        law = scene["damping"]["law"]
        rows.append(
            {
                "model": key[0],
                "record": curve["record"].iloc[0],
                "direction": key[1],
                "law": law,
                "beta_s": f"{scene['beta_s']:.6g}",
                **{name: found[name] for name in CAPACITY},
            }
        )
        curves.setdefault(key, []).append((law, scene["beta_s"], stood, fell, collapse))
    write_table(rows, job.output.table, [*COLUMNS, *CAPACITY], digits="%.4f")
    models = list(dict.fromkeys(m for m, _ in curves))
    directions = list(dict.fromkeys(d for _, d in curves))
    figure, axes = plt.subplots(
        len(models), len(directions), figsize=(7.0, 2.5 * len(models)), squeeze=False
    )
    for i, model in enumerate(models):
        for j, direction in enumerate(directions):
            axis = axes[i, j]
            for law, beta, stood, fell, collapse in curves[model, direction]:
                below = stood[~(stood["pga_g"] >= collapse)].sort_values("pga_g")
                colour = COLOURS[law]
                wide = {"lw": 3.0, "ms": 6.0, "alpha": 0.5} if law == "eq5" else {}
                axis.plot(
                    [0, *below["d_over_b"]],
                    [0, *below["pga_g"]],
                    "o-",
                    c=colour,
                    **wide,
                    label=f"{NAMES[law]}, β = {1e3 * beta:.2f} ms",
                )
                above = stood[stood["pga_g"] >= collapse]
                axis.plot(above["d_over_b"], above["pga_g"], "o", c=colour)
                axis.plot(
                    fell["d_over_b"], fell["pga_g"], "o", c=colour, mfc="white", clip_on=False
                )
            axis.set_title(f"{model}, {record} {style.SIGNS[direction]}", loc="left")
            axis.set(xlabel="d/b [-]", ylabel="PGA [g]", xlim=(0, 1.02), ylim=(0, None))
    axes[0, 0].legend()
    style.save(figure, job.output, job.input.facts)


run(main, globals())
