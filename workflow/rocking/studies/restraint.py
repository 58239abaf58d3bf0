"""What a roof's load and friction are worth: collapse intensities by the planar solver."""

from functools import partial

import pandas as pd

from rocking.collapse import probability
from rocking.collapse.case import Variant
from rocking.collapse.varied import collapses, intensities
from rocking.runtime.drawing import drawing

BELOW, ABOVE = 0.95, 1.05  # of the 10 and 90 % intensities: where few and most should fall
INTENSITIES = tuple(f"pga_{name}_g" for name in ("collapse", "p10", "median", "p90", "max"))
COLUMNS = [*probability.KEY, "load_kn", "friction", "capacity_kn", *INTENSITIES]
SCANNED = partial(intensities, power=0.0)  # nothing is called safe here
AHEAD = {"height_m": ".6g", "force_kn": ".6g"}  # columns of YADE's table


def roof(height_m, load_kn, friction):
    """Variant of a façade with one more floor on its top; none without load."""
    row = {"height_m": height_m, "load_kn": load_kn, "friction": friction}
    about = {"load_kn": load_kn, "friction": friction, "capacity_kn": load_kn * friction}
    return Variant("roof", added={"facade.floors": [row] if load_kn else []}, about=about)


def variants(height_m, settings):
    """The façade as it is, then every load with every friction."""
    pairs = [(p, mu) for p in settings["loads_kn"] for mu in settings["frictions"]]
    return [roof(height_m, load, friction) for load, friction in [(0.0, 0.0), *pairs]]


def collapse(case, motion, direction, settings):
    """Collapse intensities by load and friction of section restraint, those without a load first.

    COLUMNS; capacity_kn is μ P.
    """
    roofs = variants(case["facade"]["height_m"], settings)
    return pd.DataFrame(collapses([case], motion, [direction], SCANNED, roofs), columns=COLUMNS)


def to_confirm(case, motion, table, settings):
    """For YADE's command `runs`: the largest load with least and most friction.

    Below and above collapse, realisations of an ensemble each; none beyond what was scanned.
    """
    most = table[table["load_kn"] == table["load_kn"].max()]
    height = case["facade"]["height_m"]
    cases = [
        {
            "about": {"height_m": height, "force_kn": round(row.capacity_kn, 6)},
            "pga_g": [round(pga_g, 4)],
            "changes": {
                "facade": case.varied(roof(height, row.load_kn, row.friction))["facade"],
            },
            "realisations": True,
        }
        for row in most.iloc[[0, -1]].itertuples()
        for pga_g in (BELOW * row.pga_p10_g, ABOVE * row.pga_p90_g)
        if pga_g <= row.pga_max_g
    ]
    return {"ahead": AHEAD, "cases": cases}


@drawing
def _draw_panel(axis, found, yade):
    """Draw the curves of one model."""
    from rocking.figures import style
    from rocking.figures.panels import band

    bare, loaded = found[found["load_kn"] == 0.0].iloc[0], found[found["load_kn"] > 0.0]
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
    axis.set_title(found["model"].iloc[0], loc="left")
    axis.set_xlabel("friction of the roof μ [-]")


@drawing
def draw(tables, yade, record):
    """Draw collapse PGA against the friction of a loaded roof, a panel a model, and YADE's runs."""
    from rocking.figures import style
    from rocking.figures.panels import panels

    figure, axes = panels(len(tables), len(tables), (3.1, 3.4), around=(1.6, 0.0), sharey=True)
    for axis, found, runs in zip(axes[0], tables, yade, strict=True):
        _draw_panel(axis, found, runs)
    axes[0, 0].set(ylabel="collapse PGA [g]", ylim=(0.0, None))
    for fill, label in (("k", "all"), ("none", "none, or a share,")):
        axes[0, -1].plot([], [], "k*", ms=6, mfc=fill, label=f"YADE: {label} fell")
    axes[0, -1].legend(loc="center left", bbox_to_anchor=(1.02, 0.5), fontsize=7)
    sign = style.SIGNS[tables[0]["direction"].iloc[0]]
    figure.suptitle(f"{style.provenance(record)} {sign}", fontsize=9)
    return figure
