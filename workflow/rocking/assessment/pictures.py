"""Pictures of the assessment report, readable without colour; each draws into a (sub)figure."""

import numpy as np
from matplotlib.patches import FancyArrowPatch, Polygon, Rectangle

from rocking.assessment.battery import CHECKS
from yade_scripts.model.ties import rod

LINES = {"W1": ("-", "0.0"), "W2": ("--", "0.35"), "W2m": ("-.", "0.5")}


def _dimension(axis, start, end, words, offset=(0.0, 0.0), **style):
    arrow = FancyArrowPatch(start, end, arrowstyle="<->", mutation_scale=7, lw=0.7, color="0.2")
    axis.add_patch(arrow)
    middle = 0.5 * (np.add(start, end)) + np.array(offset)
    axis.text(*middle, words, size=7.5, ha="center", va="center", **style)


def sketch(facade, wall, chain, own, mechanism):
    """Section of the façade at rest and turned, return wall and masses behind; drawn to scale."""

    def draw(figure):
        axis = figure.subplots()
        h, b = facade["height_m"], facade["thickness_m"]
        depth = 0.28 * h
        n = chain["n_dof"]
        for j in range(n):
            low = j * h / n
            axis.add_patch(
                Rectangle((-depth, low), depth, h / n, fc="0.93", ec="0.5", lw=0.7, hatch="//")
            )
            axis.text(
                -0.5 * depth,
                low + 0.5 * h / n,
                f"return wall,\nfloor {j + 1}",
                size=6.5,
                ha="center",
                va="center",
                bbox={"fc": "white", "ec": "none", "pad": 1.0},
            )
        axis.add_patch(Rectangle((0.0, 0.0), b, h, fc="0.75", ec="0.0", lw=1.1))
        theta = 0.5 * mechanism.ultimate()[0]
        hinge = np.array([b - own["hinge_inset_m"], 0.0])
        cos, sin = np.cos(theta), np.sin(theta)
        corners = np.array([[0.0, 0.0], [b, 0.0], [b, h], [0.0, h]]) - hinge
        turned = corners @ np.array([[cos, -sin], [sin, cos]]) + hinge
        axis.add_patch(Polygon(turned, fc="none", ec="0.0", lw=0.9, ls="--"))
        axis.plot(*hinge, "o", ms=4, color="0.0")
        axis.annotate("hinge", hinge, (hinge[0] + 0.06 * h, 0.07 * h), size=7.5)
        axis.plot([-1.2 * depth, b + 0.4 * h], [0.0, 0.0], color="0.0", lw=1.2)
        _dimension(
            axis, (b + 0.3 * h, 0.0), (b + 0.3 * h, h), f"h = {h:g} m", (0.09 * h, 0.0), rotation=90
        )
        _dimension(axis, (0.0, -0.05 * h), (b, -0.05 * h), f"b = {b:g} m", (0.0, -0.05 * h))
        if own["roof_load_kn"] > 0.0:
            arm = 0.5 * b if own["roof_arm_m"] is None else own["roof_arm_m"]
            axis.annotate(
                f"{own['roof_load_kn']:g} kN",
                (arm, h),
                (arm, 1.13 * h),
                size=7.5,
                ha="center",
                arrowprops={"arrowstyle": "->"},
            )
        for row in facade["ties"]:
            z = row["height_m"]
            axis.plot([-depth, b], [z, z], color="0.0", lw=1.4)
            axis.text(b + 0.03 * h, z, f"{1e-3 * rod(row)[1]:.3g} kN", size=7.5, va="center")
        place = own["height_ratio"] * h
        axis.annotate(
            f"floor spectrum\nat {place:.3g} m",
            (-depth, place),
            (-1.75 * depth, place),
            size=7,
            ha="center",
            va="center",
            arrowprops={"arrowstyle": "->", "lw": 0.7},
        )
        axis.set(xlim=(-2.3 * depth, b + 0.5 * h), ylim=(-0.15 * h, 1.2 * h), aspect="equal")
        axis.set_axis_off()
        words = f"w = {facade['width_m']:g} m along the wall, "
        words += f"{wall['count']} return walls of {wall['thickness_m']:g} m"
        axis.set_title(words, size=7.5)

    return draw


def capacity(curve, steps):
    """Capacity curve with the displacements of the limit states."""

    def draw(figure):
        axis = figure.subplots()
        axis.plot(curve["d_m"], curve["multiplier"], color="0.0")
        d0 = float(curve["d_m"].iloc[-1])
        for share, name, mark in ((0.4, "SLV, 0.4 d0", "s"), (0.6, "SLC, 0.6 d0", "D")):
            y = np.interp(share * d0, curve["d_m"], curve["multiplier"])
            axis.plot(share * d0, y, mark, color="0.0", mfc="white", ms=5)
            axis.annotate(name, (share * d0, y), (4, 5), textcoords="offset points", size=7.5)
        axis.set(xlabel="displacement of the control point [m]", ylabel="multiplier α [-]")
        axis.set(xlim=(0.0, None), ylim=(0.0, None))

    return draw


def spectra(table, height_m):
    """Demand on the ground and on the floor, formula beside the exact chain."""

    def draw(figure):
        axis = figure.subplots()
        t = table["period_s"]
        axis.fill_between(
            t,
            table["floor_chain_p16_g"],
            table["floor_chain_p84_g"],
            color="0.88",
            lw=0,
            label="chain under the suite, 16 to 84 %",
        )
        axis.plot(t, table["floor_chain_p50_g"], "-.", color="0.45", label="its median")
        axis.plot(
            t, table["floor_formula_g"], "--", color="0.0", label=f"formula, {height_m:.3g} m"
        )
        axis.plot(t, table["ground_g"], "-", color="0.0", lw=1.6, label="ground, demand")
        axis.plot(t, table["ground_suite_p50_g"], ":", color="0.3", label="ground, suite's median")
        axis.set(
            xscale="log", yscale="log", xlabel="period [s]", ylabel="spectral acceleration [g]"
        )
        axis.set_xticks([0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 4.0], list("1234567"))
        axis.set_xticklabels(["0.05", "0.1", "0.2", "0.5", "1", "2", "4"])
        axis.minorticks_off()
        axis.legend(loc="lower left", fontsize=6.5)

    return draw


def fragility(curves, dynamic, checks):
    """Probability of collapse of each model with its band; PGA of the demand and of the checks."""

    def draw(figure):
        axis = figure.subplots()
        for model, part in curves.groupby("model", sort=False):
            line, shade = LINES[model]
            axis.fill_between(
                part["pga_g"], part["band_low"], part["band_high"], color=shade, alpha=0.15, lw=0
            )
            axis.plot(part["pga_g"], part["probability"], line, color=shade, label=model)
        demand = dynamic["pga_demand_g"].iloc[0]
        axis.axvline(demand, color="0.0", lw=0.8)
        axis.text(demand, 1.02, "demand", size=7, ha="center", transform=axis.get_xaxis_transform())
        shown = ("linear_ground", "slv_ground", "slv_height")
        for key, mark in zip(shown, "osD", strict=True):
            x = checks.set_index("check").loc[key, "pga_fails_g"]
            axis.plot([x], [0.5], mark, color="0.0", mfc="white", ms=5, label=CHECKS[key], ls="")
        axis.set(xscale="log", xlabel="PGA [g]", ylabel="probability of collapse [-]", ylim=(0, 1))
        low = 0.5 * min(curves["pga_g"].quantile(0.2), demand)
        axis.set_xlim(low, 1.5 * max(curves["pga_g"].quantile(0.8), demand))
        ticks = [v for v in (0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0) if v > low]
        axis.set_xticks(ticks, [f"{v:g}" for v in ticks])
        axis.minorticks_off()
        axis.set_xlim(low, 1.5 * max(curves["pga_g"].quantile(0.8), demand))
        axis.legend(loc="upper left", fontsize=6.5, bbox_to_anchor=(1.0, 1.0))

    return draw


def tornado(table, base, label):
    """Bars of what a key does down and up, the factors at their ends.

    Parameters
    ----------
    table : DataFrame
        key, factor, value.
    base : float
        Value as stated.
    """

    def draw(figure):
        axis = figure.subplots()
        spread = table.groupby("key", sort=False)["value"].agg(lambda v: v.max() - v.min())
        keys = list(spread[spread > 1e-9].index)  # without those that do nothing
        for y, key in enumerate(keys[::-1]):
            part = table[table["key"] == key].sort_values("factor")
            axis.barh(
                y,
                part["value"].max() - part["value"].min(),
                left=part["value"].min(),
                height=0.5,
                fc="0.85",
                ec="0.3",
                lw=0.6,
            )
            for _, row in part.iterrows():
                right = row["value"] > base
                axis.annotate(
                    f"×{row['factor']:g}",
                    (row["value"], y),
                    (4 if right else -4, 0),
                    textcoords="offset points",
                    ha="left" if right else "right",
                    va="center",
                    size=6.5,
                )
        axis.axvline(base, color="0.0", lw=0.8)
        axis.set_yticks(range(len(keys)), [key.split(".")[-1] for key in keys[::-1]])
        axis.use_sticky_edges = False
        axis.margins(x=0.25)
        axis.set_xlabel(label)

    return draw
