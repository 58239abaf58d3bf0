"""Figures of the study `restraint`."""

from rocking.figures import style
from rocking.figures.panels import band, panels


def _draw_panel(axis, table, yade):
    """Draw the curves of one model."""
    bare, loaded = table[table["load_kn"] == 0.0].iloc[0], table[table["load_kn"] > 0.0]
    axis.axhline(bare["pga_median_g"], color="0.4", lw=1.0, ls=(0, (1, 1)), label="no roof")
    for (load, part), look in zip(loaded.groupby("load_kn"), style.LOOKS, strict=False):
        colour, line, marker = look
        low, high = part["pga_p10_g"], part["pga_p90_g"].fillna(part["pga_max_g"])
        form = {"ls": line, "marker": marker, "ms": 3.5, "label": f"load of {load:g} kN"}
        band(axis, part["friction"], part["pga_median_g"], low, high, colour, **form)
    valid = yade[yade["status"] != "failed"]
    for (force, pga), part in valid.groupby(["force_kn", "pga_g"]):
        at, share = (force / loaded["load_kn"].max(), pga), part["collapsed"].mean()
        axis.plot(*at, "k*", ms=6, mfc="k" if share == 1.0 else "none", zorder=3)
        if 0.0 < share < 1.0:
            axis.annotate(f"{share:.0%}", at, (6, -3), textcoords="offset points", fontsize=7)
    axis.set_title(table["model"].iloc[0], loc="left")
    axis.set_xlabel("friction of the roof μ [-]")


def draw(tables, yade, record):
    """Draw collapse PGA against the friction of a loaded roof, a panel a model, and YADE's runs."""
    figure, axes = panels(len(tables), len(tables), (3.1, 3.4), around=(1.6, 0.0), sharey=True)
    for axis, table, runs in zip(axes[0], tables, yade, strict=True):
        _draw_panel(axis, table, runs)
    axes[0, 0].set(ylabel="collapse PGA [g]", ylim=(0.0, None))
    for fill, label in (("k", "all"), ("none", "none, or a share,")):
        axes[0, -1].plot([], [], "k*", ms=6, mfc=fill, label=f"YADE: {label} fell")
    axes[0, -1].legend(loc="center left", bbox_to_anchor=(1.02, 0.5), fontsize=7)
    sign = style.SIGNS[tables[0]["direction"].iloc[0]]
    figure.suptitle(f"{style.provenance(record)} {sign}", fontsize=9)
    return figure
