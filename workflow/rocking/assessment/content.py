"""What the assessment report says: its first page, the checks, the dynamic answers, an appendix."""

from rocking.assessment import appendix, drawings, pictures, verdict
from rocking.assessment.checks import LEAST_KNOWN, confidence
from rocking.assessment.code_checks import CHECKS
from rocking.assessment.document import Heading, List, PageBreak, Paragraph, Picture, Table
from rocking.assessment.shaken import WHOLE_PART, is_later
from rocking.assessment.verdict import g3, per_cent
from yade_scripts.model.registry import MODELS

SHOWN = (
    *("linear_ground", "linear_height", "slv_ground", "slv_height", "slc_ground", "slc_height"),
    *("en_sd_ground", "en_sd_height", "en_nc_ground", "en_nc_height"),
    *("parts_ground", "parts_height", "parts_slow", "housner"),
)


def with_unit(value, unit):
    """Three figures with their unit, where there is one."""
    return g3(value) if unit == "-" else f"{g3(value)} {unit}"


def first_page(data):
    """Title, who and what for, drawing, verdict, what it rests on, what is next."""
    own, t = data.config["assessment"], data.tables
    mechanisms, checks = t["mechanisms"], t["code_checks"]
    fit, shaken = data.fit, t["shaken"]
    sentences = [
        verdict.kinematic(checks, mechanisms),
        verdict.dynamic_check(t["verdicts"], fit, shaken),
        verdict.suite(t["dynamic"], shaken["shaken"].sum() > 1),
    ]
    weakest = data.weakest
    demand = checks["pga_demand_g"].iloc[0]
    worse = verdict.damage(t["code_sensitivity"], mechanisms, demand)
    known = ""
    if confidence(own["confidence_factor"], own["hinge_inset_m"]) != own["confidence_factor"]:
        known = (
            "Give assessment.hinge_inset_m, from the masonry's compressive strength, to be allowed "
            f"the stated confidence factor {own['confidence_factor']:g} instead of {LEAST_KNOWN}."
        )
    who = [
        ("client", own["client"] or "–", "engineer", own["engineer"] or "–"),
        ("place", own["place"] or "–", "date", own["date"] or "–"),
        ("program", data.program, "commit", data.commit),
    ]
    return [
        Heading(f"{own['title'] or 'Façade'}: out-of-plane assessment", 1),
        Table("", ("", "", "", ""), who, (0.12, 0.38, 0.12, 0.38), ""),
        Picture(
            drawings.facade(data.family, weakest),
            72.0,
            "To scale. Crosses: ties; dashed lines: floors; dashed outline: the weakest mechanism.",
            drawings.words(data.family, weakest),
            "config.yaml",
        ),
        Paragraph(_models_said(t["dynamic"]["model"])),
        Paragraph("\n".join(sentences), strong=True),
        Heading("What this rests on"),
        List(_rests_on(data)),
        Heading("What is recommended next"),
        List(verdict.next_steps(checks, mechanisms, t["verdicts"], worse, known, shaken=shaken)),
        PageBreak(),
    ]


def _models_said(names):
    """What the models are, before any of them is named in a verdict."""
    meanings = "; ".join(f"{name}: {MODELS[name].moved}" for name in names)
    return f"Models of how the return walls move behind the façade. {meanings}."


def _rests_on(data):
    """Lines: demand, models, and what is left out."""
    f, t = data.config["facade"], data.tables
    demand = t["code_checks"]["pga_demand_g"].iloc[0]
    return [
        f"The demand is {data.demand_said}, a PGA of {g3(demand)} g.",
        f"The façade is rigid blocks of {f['density_kg_m3']:g} kg/m³ on dry joints; it does not "
        "crush or fall apart, and the mechanisms know ties and anchors but no friction of floors.",
        "Every part turns over the whole width, but for the corners, which end at the eaves and "
        "take the return wall as one without openings.",
        "In the dynamic models each mechanism is a rigid part on the building, or two that bend, "
        "and leans on the return walls behind it" + _floors_said(f["floors"]),
        "The Circolare was read in a public transcription with page numbers, EN 1998-3 and NZS "
        "1170.5 at second hand (appendix B). Whoever signs compares them with the text in force.",
        "Every value is marked stated, derived or default in appendix C.",
    ]


def _floors_said(floors):
    """End of the sentence on the dynamic models: what their floors hold by."""
    rubbing = sorted({row["friction"] for row in floors if row["load_kn"] and row["friction"]})
    if not rubbing:
        return "."
    return f"; floors hold it by friction of {' and '.join(f'{mu:g}' for mu in rubbing)} too."


def _mechanisms(table, folder):
    rows = []
    for r in table.itertuples():
        letter = r.multiplier / r.e_star_letter
        start = r.multiplier / r.e_star
        both = g3(start) if abs(letter - start) < 1e-6 * start else f"{g3(start)} ({g3(letter)})"
        name = r.mechanism if r.kind == "as stated" else f"{r.mechanism}; {r.kind}"
        rows.append((name, g3(r.multiplier), both, g3(r.d0_m), f"{r.place:.2f}", g3(r.pga_fails_g)))
    return Table(
        "Mechanisms: the least first, then what one more row of ties would do to it, and the wall "
        "held at the eaves. Onset is "
        "α0/e* [g] without FC; where a held load does not move, in brackets what the code's letter "
        "gives, which counts that load in e* and is the less safe. Height: where the floor's "
        "shaking is taken, the middle of what holds the part, over the height of the eaves.",
        ("mechanism", "α0", "onset", "d0 [m]", "height", "SLV fails at [g]"),
        rows,
        (0.42, 0.1, 0.16, 0.1, 0.09, 0.13),
        f"{folder}/mechanisms.csv",
    )


def _shaken(tables, folder):
    """Mechanism by mechanism: by hand, by the code's dynamic check, half collapse by model."""
    shaken, own = tables["shaken"], tables["parts_dynamic"]
    verdicts, models = tables["verdicts"], list(tables["dynamic"]["model"])
    demand = tables["code_checks"]["pga_demand_g"].iloc[0]
    half = own.set_index(["part", "model"])["median_pga_g"]
    held = verdicts.set_index(["part", "model"])["slv"] if len(verdicts) else {}
    later, rows = is_later(shaken), []
    for r in shaken[~later].itertuples():
        name = r.mechanism if r.shaken else f"{r.mechanism}; not shaken: {r.why_not}"
        cells = []
        for model in models:
            check = held.get((r.part, model))
            said = "" if check is None else "fulfilled; " if check else "not fulfilled; "
            cells.append(f"{said}{g3(half[r.part, model])}" if r.shaken else "–")
        rows.append((name, f"{g3(r.pga_fails_g)} ({per_cent(r.pga_fails_g / demand)})", *cells))
    more = f" Not shaken: {later.sum()} that fail by hand far later." if later.any() else ""
    share = 0.44 / len(models)
    return Table(
        "Mechanism by mechanism: the PGA at which the SLV check by hand fails (over the demand's); "
        "the code's dynamic check under each model, and the median PGA of half collapse [g]. The "
        f"worst decides.{more}",
        ("mechanism", "by hand [g]", *models),
        rows,
        (0.41, 0.15, *[share] * len(models)),
        f"{folder}/parts_dynamic.csv",
    )


def _checks(checks, folder):
    blocks = []
    for name, part in checks.groupby("mechanism", sort=False):
        own = part.set_index("check")
        rows = []
        for key in SHOWN:
            if key not in own.index:
                continue
            r = own.loc[key]
            rows.append(
                (
                    CHECKS.get(key, key.replace("_", " ")),
                    with_unit(r["capacity"], r["unit"]),
                    with_unit(r["demand"], r["unit"]),
                    "passes" if r["ratio"] >= 1.0 else "fails",
                    g3(r["pga_fails_g"]),
                    g3(r["ratio"]),
                )
            )
        both = " What stands on the ground has two demands, ground and floor; the larger governs."
        blocks.append(
            Table(
                f"Checks of: {name}. A check just fails at the PGA in the fifth column; the last "
                "is that over the demand's PGA. Displacements are the equivalent oscillator's, not "
                f"the top's.{both if 'slv_ground' in own.index else ''}",
                ("check", "capacity", "demand", "", "fails at [g]", "over demand"),
                rows,
                (0.36, 0.15, 0.15, 0.1, 0.12, 0.12),
                f"{folder}/code_checks.csv",
            )
        )
    return blocks


def _dynamic_check(data, folder):
    verdicts, yade = data.tables["verdicts"], data.tables["yade"]
    if verdicts.empty:
        return [
            Paragraph(
                "Not made: it wants as many motions of different stations as assessment.motions "
                f"says ({data.config['assessment']['motions']})."
            )
        ]
    names = dict(
        zip(data.tables["shaken"]["part"], data.tables["shaken"]["mechanism"], strict=True)
    )
    rows = [
        (
            f"{r.model}, {names[r.part]}",
            f"{r.exceed_d0:.0f} of {r.motions:.0f}",
            f"{1e3 * r.mean_d_m:.0f} mm",
            f"{1e3 * r.d_slv_m:.0f}, {1e3 * r.d_slc_m:.0f} mm",
            *("fulfilled" if held else "not fulfilled" for held in (r.slv, r.slc)),
            per_cent(r.agree),
        )
        for r in verdicts.itertuples()
    ]
    verdict_table = Table(
        "The code's dynamic check (C8.7.1.2.1.9): fulfilled if no history exceeds d0 and "
        "the mean of the largest displacements of the top does not exceed d_SLV (d_SLC). Last "
        "column: share of draws with one perturbed history a motion that give the same verdict "
        "on SLV.",
        ("model, mechanism", "beyond d0", "mean", "d_SLV, d_SLC", "SLV", "SLC", "same verdict"),
        rows,
        (0.3, 0.1, 0.09, 0.16, 0.125, 0.125, 0.1),
        f"{folder}/dynamic_check_*.csv",
    )
    confirmed = [_in_yade(yade, folder)] if len(yade) else []
    return [*_motions(data, folder), verdict_table, *confirmed]


def _motions(data, folder):
    """The selected motions and how their mean fits the demand."""
    motions, (low, high, fits) = data.tables["selected_motions"], data.fit
    factors = motions["factor"]
    return [
        Paragraph(
            f"{len(motions)} recorded motions, one horizontal component a station, factors "
            f"{factors.min():.2f} to {factors.max():.2f}. Their mean spectrum lies "
            f"{per_cent(low)} to {per_cent(high)} from the demand's between "
            f"{data.range_s[0]:.2f} and {data.range_s[1]:.2f} s, "
            f"{'within' if fits else 'outside'} the code's −10 to +30 %. "
            "Directions: " + ", ".join(data.config["directions"]) + "."
        ),
        Picture(
            pictures.selected(data.tables["selected_spectra"]),
            55.0,
            "Spectra of 5 %: the demand, the motions' mean, and each motion.",
            f"The mean lies {per_cent(low)} to {per_cent(high)} from the demand.",
            f"{folder}/selected_spectra.csv",
        ),
    ]


def _in_yade(yade, folder):
    """Histories of the dynamic check that YADE ran again."""
    rows, names = [], {"worst": "the largest", "nearest": "nearest to d_SLV"}
    one = ["model", "part", "record", "direction", "pga_g", "d_m", "d_yade_m", "status_yade"]
    for own, part in yade.groupby(one, sort=False, dropna=False):
        model, piece, record, direction, _, d_m, d_yade_m, status = own
        which = " and ".join(names[w] for w in part["which"])
        lengths = f"{1e3 * d_m:.0f} mm", f"{1e3 * d_yade_m:.0f} mm, {status}"
        where = "" if piece == WHOLE_PART else f", {piece.replace('_', ' ')} m"
        rows.append((f"{model}{where}, {record} {direction}", which, *lengths))
    return Table(
        "Run again in YADE, the discrete element program: of the mechanism that decides under each "
        "model the history with the largest displacement, and the one nearest to d_SLV.",
        ("history", "", "planar solver", "YADE"),
        rows,
        (0.3, 0.34, 0.16, 0.2),
        f"{folder}/dynamic_check_*_yade.csv",
    )


def _suite(dynamic, folder):
    rows = []
    for r in dynamic.itertuples():
        middle, share = g3(r.median_pga_g), "–"
        if r.probability == r.probability:  # from enough stations
            middle += f" ({g3(r.ci_low_g)} to {g3(r.ci_high_g)})"
            share = "".join(verdict.collapses(r))
        line = [r.model, middle, g3(r.dispersion), share, f"{r.curves} ({r.never_collapsed})"]
        if "annual_rate" in dynamic:
            line.append(f"{r.annual_rate:.2g} ({r.rate_low:.2g} to {r.rate_high:.2g})")
        rows.append(tuple(line))
    columns = ["model", "median PGA [g]", "dispersion", "collapse at the demand", "curves (stood)"]
    widths = [0.1, 0.28, 0.14, 0.26, 0.22]
    if "annual_rate" in dynamic:
        columns.append("a year")
        widths.append(0.24)
    return Table(
        "Every motion of the run scaled until the façade falls: PGA of half collapse, and collapse "
        "at the demand's PGA. In brackets 95 % intervals, stations drawn with replacement; none "
        "from fewer than seven stations.",
        tuple(columns),
        rows,
        tuple(widths),
        f"{folder}/dynamic.csv",
    )


def _sensitivity(data, folder):
    code, dynamic = data.tables["code_sensitivity"], data.tables["dynamic_sensitivity"]
    own = data.tables["code_checks"]
    own = own[own["mechanism"] == data.weakest.name].set_index("check")["ratio"]
    blocks: list = []
    for key, words in (("slv_ground", "ground"), ("slv_height", "floor")):
        part = code[code["check"] == key].rename(columns={"ratio": "value"})
        if part.empty or key not in own:
            continue
        blocks.append(
            Picture(
                pictures.tornado(part, own[key], "PGA of failure over the demand's [-]"),
                45.0,
                f"Sensitivity of the non-linear SLV check, {words}; line: as stated. What changes "
                "nothing is left out.",
                "; ".join(f"{r.key} ×{r.factor:g} gives {g3(r.value)}" for r in part.itertuples()),
                f"{folder}/code_sensitivity.csv",
            )
        )
    found = dynamic.dropna(subset=["ratio"])
    if len(found):
        spread = found.groupby(["key", "factor"], sort=False)["ratio"].agg(
            ["median", "min", "max", "size"]
        )
        rows = []
        for key, part in spread.groupby(level="key", sort=False):
            ranges = [f"{g3(s.min)} to {g3(s.max)}" for s in part.itertuples(index=False)]
            rows.append(
                (
                    key,
                    ", ".join(f"×{f:g}" for f in part.index.get_level_values("factor")),
                    ", ".join(g3(m) for m in part["median"]),
                    ", ".join(ranges),
                    f"{part['size'].min():.0f}",
                )
            )
        blocks.append(
            Table(
                f"Sensitivity of the dynamic answer ({dynamic['model'].iloc[0]}): PGA of half "
                "collapse over that of the façade as stated, for some of the motions.",
                ("parameter", "factors", "median ratios", "ranges over motions", "motions"),
                rows,
                (0.28, 0.14, 0.18, 0.29, 0.11),
                f"{folder}/dynamic_sensitivity.csv",
            )
        )
    return blocks


def blocks(data, folder):
    """All blocks of the report.

    Parameters
    ----------
    data : rocking.assessment.appendix.Data
    folder : str
        Where the tables are, for the sources.
    """
    t, demand = data.tables, data.tables["code_checks"]["pga_demand_g"].iloc[0]
    out = [
        *first_page(data),
        Heading("Mechanism by mechanism"),
        _shaken(t, folder),
        Heading("The kinematic checks"),
        _mechanisms(t["mechanisms"], folder),
        *_checks(t["code_checks"], folder),
        Picture(
            pictures.capacity(t["capacity_curve"], t["mechanisms"]),
            50.0,
            "Capacity curve. d_SLV is the least of 0.4 d0 and of where a tie or an anchor gives "
            "way and takes more than half of the capacity.",
            "The multiplier falls to zero at d0.",
            f"{folder}/capacity_curve.csv",
        ),
        Picture(
            pictures.spectra(t["spectra"]),
            65.0,
            f"Elastic spectra of 5 % at a PGA of {g3(demand)} g: the demand, the Circolare's floor "
            "spectrum where the weakest mechanism is held, and the building's chain under the "
            "run's motions scaled to that PGA.",
            "Ground, floor by formula, floor by the chain.",
            f"{folder}/spectra.csv",
        ),
        Heading("The code's own dynamic check"),
        *_dynamic_check(data, folder),
        Heading("Collapse under all motions"),
    ]
    if len(t["dynamic_curves"]):
        out.append(
            Picture(
                pictures.fragility(t["dynamic_curves"], t["dynamic"], t["mechanisms"]),
                55.0,
                "Probability of collapse with 95 % bands; mark: PGA at which the SLV check fails.",
                "; ".join(
                    f"{r.model}: half collapse at {g3(r.median_pga_g)} g"
                    for r in t["dynamic"].itertuples()
                ),
                f"{folder}/dynamic_curves.csv",
            )
        )
    out += [
        _suite(t["dynamic"], folder),
        Heading("Sensitivity"),
        *_sensitivity(data, folder),
        PageBreak(),
        *appendix.blocks(data, folder),
    ]
    return out
