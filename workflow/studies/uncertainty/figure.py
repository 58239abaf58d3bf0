"""Figure of the study `uncertainty`."""

import matplotlib.pyplot as plt
import numpy as np
from rocking.figures import style
from rocking.figures.panels import intervals

from studies.shared.fragility import Fragility
from yade_scripts.model.registry import MODELS

WORDS = {
    "e_mpa": "E",
    "friction": "friction",
    "beta_s": "β",
    "density_kg_m3": "density",
    "thickness_m": "thickness",
    "period_s": "T1",
    "damping_ratio": "damping",
    "length_m": "length L",
    "base_shear_ratio": "V/W",
}
LINES = ("-", "--", "-.", ":")
ENDS = ("", "_low", "_high")
SPAN = {"lw": 0.9, "ms": 4}


def draw(parts, sensitivity, fragility):
    """Draw the parts of the scatter, what each parameter moves, and fragility with the parts."""
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(10.5, 3.8))
    shown = parts[parts["part"] != "total"][::-1]
    place = np.arange(len(shown))
    share, low, high = (100.0 * shown[f"share{end}"] for end in ENDS)
    intervals(left, place, share, low, high, along="x", marker="o", color="k", **SPAN)
    labels = [f"{p} ({b:.2f})" for p, b in zip(shown["part"], shown["beta"], strict=True)]
    left.set_yticks(place, [label.replace(" x ", " × ") for label in labels], fontsize=7)
    left.set(xlabel="share of the variance of ln PGA [%]", xlim=(0, None))
    left.set_title("parts (their dispersion)", loc="left", fontsize=8)

    by_model = sensitivity[sensitivity["model"] != "all"]
    names = list(dict.fromkeys(by_model["parameter"]))
    everything = sensitivity[sensitivity["model"] == "all"].set_index("parameter")["slope"].abs()
    names.sort(key=lambda name: everything[name])
    models = list(dict.fromkeys(by_model["model"]))
    for k, model in enumerate(models):
        part = by_model[by_model["model"] == model].set_index("parameter").loc[names]
        y = np.arange(len(names)) + 0.66 / len(models) * ((len(models) - 1) / 2.0 - k)
        kind, other = MODELS[model.split()[0]], " " in model  # on another base: open symbols
        look = {"marker": kind.marker, "color": kind.colour, "label": model}
        look |= {"mfc": "white"} if other else {}
        slope, low, high = (100.0 * np.expm1(part[f"slope{end}"]) for end in ENDS)
        intervals(middle, y, slope, low, high, along="x", **look, **SPAN)
    middle.axvline(0.0, color=style.GREY, lw=0.8, zorder=0)
    middle.set_yticks(np.arange(len(names)), [WORDS[name] for name in names])
    middle.set(xlabel="change of collapse PGA for one\nstandard deviation [%]")
    columns = min(len(models), 3)
    middle.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=columns, fontsize=7)

    median, widest = fragility["median_g"].iloc[0], fragility["dispersion"].max()
    x = median * np.exp(np.linspace(-2.5, 2.5, 121) * widest)
    for k, row in enumerate(fragility.itertuples()):
        label = f"{row.curve} ({row.dispersion:.2f})"
        curve = Fragility(row.median_g, row.dispersion).probability(x)
        right.plot(x, curve, ls=LINES[k], color=("0.6", "#0072B2", "k", "#D55E00")[k], label=label)
    right.set(xlabel="PGA [g]", ylabel="probability of collapse [-]", ylim=(0, 1), xlim=(0, x[-1]))
    right.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2, fontsize=7)
    first = parts.iloc[0]
    figure.suptitle(
        f"{first['n_motions']:.0f} motions, {first['n_samples']:.0f} points of the sample, "
        f"{first['n_models']:.0f} forms of the model"
    )
    return figure
