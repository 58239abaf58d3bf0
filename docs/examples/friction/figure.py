"""Figure of the study `friction`."""

from rocking.figures.panels import panels

from yade_scripts.model.registry import MODELS


def draw(table):
    """Draw the ratio against the friction angle, a panel a model."""
    models = list(dict.fromkeys(table["model"]))
    figure, axes = panels(len(models), len(models), (2.2, 2.8), around=(0.8, 0.0), sharey=True)
    for axis, model in zip(axes.flat, models, strict=True):
        part, kind = table[table["model"] == model], MODELS[model]
        for _, curve in part.groupby(["record", "direction"]):
            axis.plot(curve["friction_deg"], curve["ratio"], marker=kind.marker, color=kind.colour)
        axis.set_title(model, loc="left")
        axis.set_xlabel("friction angle [°]")
    axes[0, 0].set(ylabel="collapse PGA over that of the first [-]", ylim=(0.0, None))
    return figure
