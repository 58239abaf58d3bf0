"""What the assessment report says: blocks made of the tables that stand behind it."""

import pandas as pd

from rocking.assessment import pictures
from rocking.assessment.battery import CHECKS, mechanism_of
from rocking.assessment.document import Heading, Paragraph, Picture, Table
from yade_scripts.model.floors import capacity_n
from yade_scripts.model.registry import MODELS
from yade_scripts.model.ties import rod

CIRCOLARE = "Circolare 7/2019, as transcribed in the literature; official text not checked"
UNCHECKED = (
    "Formulas of the Circolare 7/2019 and of NZS 1170.5 are used as secondary transcriptions give "
    "them; neither official text could be read. Whoever signs compares them with the text in "
    "force. The displacement check of New Zealand's guidelines for rocking walls, and the "
    "Circolare's formula for interlocking, are not applied."
)


def g3(value):
    """Three figures, or a dash."""
    return f"{value:.3g}" if pd.notna(value) else "–"


def with_unit(value, unit):
    """Three figures with their unit, where there is one."""
    return g3(value) if unit == "-" else f"{g3(value)} {unit}"


def _answer(checks, dynamic):
    demand = g3(checks["pga_demand_g"].iloc[0])
    by = checks.set_index("check")
    lines = [f"Demand: a PGA of {demand} g. Capacity over demand:"]
    for key in ("linear_ground", "linear_height", "slv_ground", "slv_height"):
        row = by.loc[key]
        verdict = "passes" if row["ratio"] >= 1.0 else "fails"
        lines.append(f"{CHECKS[key]}: {g3(row['ratio'])}, {verdict}.")
    lines.append("Shaken by the suite's motions at that PGA (95 % interval):")
    for _, row in dynamic.iterrows():
        lines.append(
            f"{row['model']}: collapse in {100 * row['probability']:.0f} % "
            f"({100 * row['probability_low']:.0f} to {100 * row['probability_high']:.0f} %); "
            f"half collapse at {g3(row['median_pga_g'])} g."
        )
    return "\n".join(lines)


def _ties_said(rows):
    """Rows of ties in words."""
    said = [
        f"{1e-3 * rod(row)[1]:.3g} kN at {row['height_m']:g} m ({row['count']} of "
        f"{row['diameter_mm']:g} mm)"
        for row in rows
    ]
    return "; ".join(said) or "none"


def _floors_said(rows):
    """Floors and roof in words."""
    said = [
        f"{row['load_kn']:g} kN at {row['height_m']:g} m, "
        f"held up to {1e-3 * capacity_n(row):.3g} kN"
        for row in rows
    ]
    return "; ".join(said) or "none"


def _assumptions(settings, beta):
    """Rows: what is assumed, its value, where it comes from."""
    f, w, c, a = (settings[k] for k in ("facade", "return_wall", "smdof", "assessment"))
    arm = "b/2" if a["roof_arm_m"] is None else f"{a['roof_arm_m']:g} m"
    mass = w["building_mass_kg"]
    return [
        ("façade", "one rigid block, homogeneous, no openings", "stated by the user"),
        (
            "height, thickness, width",
            f"{f['height_m']:g}, {f['thickness_m']:g}, {f['width_m']:g} m",
            "facade, stated by the user",
        ),
        ("density", f"{f['density_kg_m3']:g} kg/m³", "facade.density_kg_m3"),
        ("modulus of the joints", f"{f['e_mpa']:g} MPa", "facade.e_mpa; base E/h, walls E/L"),
        ("damping at contacts", f"β = {beta:.3g} s", f"damping.law = {settings['damping']['law']}"),
        ("friction", f"{f['friction_deg']:g}°", "facade.friction_deg"),
        (
            "building",
            f"{c['n_dof']} equal masses, T1 = {c['period_s']:g} s, {100 * c['damping_ratio']:g} %",
            "smdof",
        ),
        (
            "building's mass (W2m)",
            f"{mass:g} kg" if mass else "of the brick model",
            "return_wall.building_mass_kg",
        ),
        ("roof load", f"{a['roof_load_kn']:g} kN at {arm}", "assessment; code's mechanisms only"),
        ("floors", _floors_said(f["floors"]), "facade.floors; in the dynamic models only"),
        (
            "ties",
            _ties_said(f["ties"]),
            "facade.ties; in the mechanisms as constant pulls up to their elongation",
        ),
        (
            "hinge",
            f"{1000 * a['hinge_inset_m']:g} mm inside the outer face",
            "assessment; the dynamic models crush elastically",
        ),
        ("confidence factor", f"{a['confidence_factor']:g}", CIRCOLARE),
        ("behaviour factor", f"{a['behaviour_factor']:g}", CIRCOLARE),
        (
            "place of the floor spectrum",
            f"{a['height_ratio']:g} of the height",
            "assessment.height_ratio: middle of the line that holds the façade",
        ),
    ]


def _checks(checks, steps, folder):
    """Summary of the checks, and every number between."""
    rows = [
        (
            CHECKS[r.check],
            with_unit(r.capacity, r.unit),
            with_unit(r.demand, r.unit),
            g3(r.ratio),
            "passes" if r.ratio >= 1.0 else "fails",
            g3(r.pga_fails_g),
        )
        for r in checks.itertuples()
    ]
    blocks = [
        Table(
            "Checks: capacity, demand, and the PGA at which each just fails, the demand scaled.",
            ("check", "capacity", "demand", "ratio", "", "fails at [g]"),
            rows,
            (0.34, 0.16, 0.16, 0.1, 0.1, 0.14),
            f"{folder}/code_checks.csv",
        ),
        Paragraph(UNCHECKED),
        *_floor_below_ground(steps),
        Heading("Every number of the checks", 3),
    ]
    for key, part in steps.groupby("check", sort=False):
        source = checks.set_index("check").loc[key, "source"]
        blocks.append(
            Table(
                f"{CHECKS[key]}. {source}.",
                ("symbol", "meaning", "value", "unit"),
                [(r.symbol, r.meaning, f"{r.value:.4g}", r.unit) for r in part.itertuples()],
                (0.18, 0.52, 0.18, 0.12),
                f"{folder}/code_steps.csv",
            )
        )
    return blocks


def _floor_below_ground(steps):
    """A warning where the floor spectrum asks for less than the ground's."""
    own = steps[steps["symbol"] == "S_De(T)"].set_index("check")["value"]
    if own["slv_height"] >= own["slv_ground"] and own["slc_height"] >= own["slc_ground"]:
        return []
    return [
        Paragraph(
            "Caution: at the long period of the turned façade the floor spectrum's formula asks "
            "for less than the ground's spectrum, since it holds the building's amplified modes "
            "alone. Compare the exact chain below. The larger demand governs."
        )
    ]


def _dynamic(dynamic, folder):
    rows = []
    for r in dynamic.itertuples():
        line = [
            f"{r.model}: {MODELS[r.model].meaning}",
            f"{g3(r.median_pga_g)} ({g3(r.ci_low_g)} to {g3(r.ci_high_g)})",
            g3(r.dispersion),
            f"{100 * r.probability:.0f} % ({100 * r.probability_low:.0f} to "
            f"{100 * r.probability_high:.0f})",
            f"{r.curves} ({r.never_collapsed})",
        ]
        if "annual_rate" in dynamic:
            line.append(f"{r.annual_rate:.2g} ({r.rate_low:.2g} to {r.rate_high:.2g})")
        rows.append(tuple(line))
    columns = [
        "model",
        "median PGA [g]",
        "dispersion",
        "collapse at the demand",
        "curves (never fell)",
    ]
    widths = [0.3, 0.22, 0.12, 0.22, 0.14]
    if "annual_rate" in dynamic:
        columns.append("a year")
        widths.append(0.2)
    return Table(
        "Dynamic answer: PGA of half collapse over the suite, and collapse at the demand's PGA. "
        "In brackets 95 % intervals, stations drawn with replacement.",
        tuple(columns),
        rows,
        tuple(widths),
        f"{folder}/dynamic.csv",
    )


def _ties(mechanisms, folder):
    rows = [
        (
            r.mechanism,
            g3(r.tie_kn),
            g3(r.multiplier),
            g3(r.d0_m),
            g3(r.linear_ground),
            g3(r.linear_height),
            g3(r.slv_ground),
            g3(r.slv_height),
        )
        for r in mechanisms.itertuples()
    ]
    return Table(
        "What would help: the mechanism with ties at their height, and held at the top. Ratios are "
        "capacity over demand of the Circolare's checks, on the ground and at the floor.",
        (
            "mechanism",
            "ties [kN]",
            "α0",
            "d0 [m]",
            "linear, ground",
            "floor",
            "0.4 d0, ground",
            "floor",
        ),
        rows,
        (0.28, 0.1, 0.09, 0.09, 0.12, 0.1, 0.13, 0.1),
        f"{folder}/mechanisms.csv",
    )


def _sensitivity(code, dynamic, checks, folder):
    by = checks.set_index("check")["ratio"]
    blocks: list = []
    for key, words in (("linear_ground", "linear"), ("slv_height", "non-linear 0.4 d0, floor")):
        part = code[code["check"] == key].rename(columns={"ratio": "value"})
        blocks.append(
            Picture(
                pictures.tornado(part, by[key], "capacity over demand [-]"),
                55.0,
                f"Sensitivity of the code's answer, {words}; line: as stated.",
                "Bars, one a parameter: "
                + "; ".join(
                    f"{r.key} ×{r.factor:g} gives {g3(r.value)}" for r in part.itertuples()
                ),
                f"{folder}/code_sensitivity.csv",
            )
        )
    own = dynamic.dropna(subset=["ratio"])
    middle = own.groupby(["key", "factor"], sort=False)["ratio"].median()
    spread = own.groupby(["key", "factor"], sort=False)["ratio"].agg(["min", "max", "size"])
    rows = [
        (
            k.split(".")[-1],
            f"×{f:g}",
            g3(middle[k, f]),
            f"{g3(s['min'])} to {g3(s['max'])}",
            f"{s['size']:.0f}",
        )
        for (k, f), s in spread.iterrows()
    ]
    blocks.append(
        Table(
            f"Sensitivity of the dynamic answer ({dynamic['model'].iloc[0]}): PGA of half collapse "
            "over that of the façade as stated, for some of the suite's motions.",
            ("parameter", "factor", "median ratio", "range over motions", "motions"),
            rows,
            (0.3, 0.14, 0.18, 0.24, 0.14),
            f"{folder}/dynamic_sensitivity.csv",
        )
    )
    return blocks


def blocks(settings, tables, beta, provenance, folder):
    """All blocks of the report.

    Parameters
    ----------
    settings : dict
        Sections of the resolved configuration.
    tables : dict of str to DataFrame
        checks, steps, curve, sensitivity, mechanisms, spectra, dynamic, curves,
        dynamic_sensitivity.
    beta : float
        Damping of the contacts [s].
    provenance : list of (what, value)
    folder : str
        Where the tables are, for the sources.
    """
    t, own = tables, settings["assessment"]
    facade, chain = settings["facade"], settings["smdof"]
    mechanism = mechanism_of(facade, own)
    h = facade["height_m"]
    demand = t["checks"]["pga_demand_g"].iloc[0]
    title = own["title"] or "Façade"
    out = [
        Heading(f"{title}: out-of-plane assessment", 1),
        Paragraph(_answer(t["checks"], t["dynamic"]), strong=True),
        Paragraph(
            "The code's answer compares one mechanism with one spectrum. The dynamic answer shakes "
            "the façade against its return walls with motions scaled in PGA; its roof load is that "
            "of facade.floors, and it knows no material that crushes or falls apart."
        ),
        Heading("The façade as modelled"),
        Picture(
            pictures.sketch(facade, settings["return_wall"], chain, own, mechanism),
            88.0,
            "Section to scale; dashed: turned by half the rotation at which α vanishes.",
            f"Section of a façade {h:g} m high and {facade['thickness_m']:g} m thick on the "
            f"ground, return walls behind it in {chain['n_dof']} blocks, one a floor, and its "
            "turned position.",
            "config.yaml",
        ),
        Table(
            "Assumptions and where each comes from.",
            ("assumption", "value", "source"),
            _assumptions(settings, beta),
            (0.27, 0.33, 0.4),
            "config.yaml",
        ),
        Heading("The answer of the codes"),
        *_checks(t["checks"], t["steps"], folder),
        Picture(
            pictures.capacity(t["curve"], t["steps"]),
            55.0,
            "Capacity curve of the mechanism.",
            f"The multiplier falls from {g3(t['curve']['multiplier'].iloc[0])} at rest to zero at "
            f"{g3(t['curve']['d_m'].iloc[-1])} m.",
            f"{folder}/capacity_curve.csv",
        ),
        Heading("Spectra on ground and floor"),
        Picture(
            pictures.spectra(t["spectra"], own["height_ratio"] * h),
            70.0,
            f"Elastic spectra of 5 % at a PGA of {g3(demand)} g: the demand, the Circolare's floor "
            "spectrum, and the building's chain under the suite scaled to that PGA.",
            _spectra_words(t["spectra"]),
            f"{folder}/spectra.csv",
        ),
        Heading("The dynamic answer"),
        Picture(
            pictures.fragility(t["curves"], t["dynamic"], t["checks"]),
            65.0,
            "Probability of collapse over the suite's motions, with 95 % bands; marks: PGA at "
            "which checks just fail.",
            "; ".join(
                f"{r.model}: half collapse at {g3(r.median_pga_g)} g, {g3(r.probability)} at the "
                "demand"
                for r in t["dynamic"].itertuples()
            ),
            f"{folder}/dynamic_curves.csv",
        ),
        _dynamic(t["dynamic"], folder),
        Heading("Sensitivity"),
        *_sensitivity(t["sensitivity"], t["dynamic_sensitivity"], t["checks"], folder),
        Heading("What would help"),
        _ties(t["mechanisms"], folder),
        Paragraph(
            "Added ties are judged by the mechanism alone; under shaking the target "
            "strengthening searches for the least row that holds. A top that is held changes "
            "the mechanism to vertical bending; floors and ties must then carry its reaction."
        ),
        Heading("Provenance"),
        Table("What this report rests on.", ("what", "value"), provenance, (0.3, 0.7), ""),
    ]
    return out


def _spectra_words(table):
    at = (0.1, 0.3, 1.0, 2.0)
    rows = [table.iloc[(table["period_s"] - t).abs().argmin()] for t in at]
    return "; ".join(
        f"at {r['period_s']:.2g} s: ground {g3(r['ground_g'])} g, floor by formula "
        f"{g3(r['floor_formula_g'])} g, by chain {g3(r['floor_chain_p50_g'])} g"
        for r in rows
    )
