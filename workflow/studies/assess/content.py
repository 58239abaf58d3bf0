"""Tables and pictures of the assessment report's body: mechanisms, dynamic answers, rate."""

from functools import partial

import pandas as pd

from studies.assess import pictures, verdict
from studies.assess.code_checks import CHECKS
from studies.assess.paper import Picture, Table
from studies.assess.shaken import is_far
from studies.assess.sites import WHOLE_PART
from studies.assess.verdict import g3, per_cent, powered
from studies.assess.walls import named as wall_named

SHOWN = (
    *("linear_ground", "linear_height", "slv_ground", "slv_height", "slc_ground", "slc_height"),
    *("en_sd_ground", "en_sd_height", "en_nc_ground", "en_nc_height"),
    "housner",
)
APART = 0.1  # of two solvers' displacements, from which on it is said


def with_unit(value, unit):
    """Three figures with their unit, where there is one."""
    return g3(value) if unit == "-" else f"{g3(value)} {unit}"


def floors_said(floors, counts):
    """End of the sentence on the dynamic models: what their floors hold by, if friction counts."""
    rubbing = sorted({row["friction"] for row in floors if row["load_kn"] and row["friction"]})
    if not rubbing:
        return "."
    said = " and ".join(f"{mu:g}" for mu in rubbing)
    if counts:
        return f"; floors hold it by friction of {said} too (assessment.floor_friction)."
    return (
        f"; the friction of floors, {said}, does not hold it, since nobody has verified that it "
        "lasts until collapse (assessment.floor_friction)."
    )


def by_mechanism(data):
    """Mechanism by mechanism: by hand, by the code's dynamic check, half collapse by model."""
    tables = data.tables
    shaken, own = tables["shaken"], tables["parts_dynamic"]
    verdicts, models = tables["verdicts"], list(tables["dynamic"]["model"])
    stated = verdict.as_stated(tables["mechanisms"]).set_index("part")
    half = {(r.part, r.model): _half(r) for r in own.itertuples()}
    held = {}
    if len(verdicts):
        said = verdicts.assign(said=verdict.held_or_not(verdicts))
        held = said.set_index(["part", "model"])["said"].to_dict()
    rows = []
    for r in shaken.itertuples():
        name = r.mechanism if r.shaken else f"{r.mechanism}; not shaken: {r.why_words}"
        known = stated.loc[r.part]
        cells = ["–"] * len(models)
        for k, model in enumerate(models if r.shaken else ()):
            said = [held[r.part, model]] if (r.part, model) in held else []
            cells[k] = "; ".join([*said, half.get((r.part, model), "–")])
        by_hand = f"{g3(r.pga_fails_g)} ({per_cent(r.pga_fails_g / data.demand_g)})"
        rows.append((name, f"{known['multiplier']:.4f}", by_hand, *cells))
    within = data.config["assessment"]["shaken_within"]
    more = f" Shaken is what fails by hand below {within:g} times the demand's PGA"
    more += "." if is_far(shaken).any() else ": here every one that can be."
    share = 0.42 / len(models)
    governs = verdict.decided_by(verdicts)
    heads = [f"{model} (governs)" if model == governs else model for model in models]
    return Table(
        "Every mechanism, the weakest by hand first: α0; the PGA at which its SLV check by hand "
        "fails, over the demand's in brackets; and by model whether the code's dynamic check is "
        "held, with the median PGA of half collapse [g]; later: most motions felled another "
        f"mechanism before. The worst decides.{more}",
        ("mechanism", "α0", "by hand [g]", *heads),
        rows,
        (0.36, 0.08, 0.14, *[share] * len(models)),
        f"{data.folder}/parts_dynamic.csv",
        (0,),
    )


def _half(row):
    """Median PGA of half collapse; a word where most motions felled another mechanism before."""
    return "later" if row.never_collapsed > 0.5 * row.curves else g3(row.median_pga_g)


def checks(data):
    """Checks of the mechanism that fails first and of the whole façade, a table each."""
    tables = []
    for _, part in data.tables["code_checks"].groupby("part", sort=False):
        own, name = part.set_index("check"), part["mechanism"].iloc[0]
        rows = [
            (
                CHECKS[key],
                with_unit(r["capacity"], r["unit"]),
                with_unit(r["demand"], r["unit"]),
                "passes" if r["ratio"] >= 1.0 else "fails",
                g3(r["pga_fails_g"]),
                g3(r["ratio"]),
            )
            for key, r in own.loc[[key for key in SHOWN if key in own.index]].iterrows()
        ]
        both = " What stands on the ground has two demands, ground and floor; the larger governs."
        tables.append(
            Table(
                f"Checks of: {name}. A check just fails at the PGA in the fifth column; the last "
                "is that over the demand's PGA. Displacements are the equivalent oscillator's, not "
                f"the top's.{both if 'slv_ground' in own.index else ''}",
                ("check", "capacity", "demand", "", "fails at [g]", "over demand"),
                rows,
                (0.36, 0.15, 0.15, 0.1, 0.12, 0.12),
                f"{data.folder}/code_checks.csv",
            )
        )
    return tables


def dynamic_check(data):
    """Lines, picture and tables of the code's dynamic check."""
    tables, folder = data.tables, data.folder
    verdicts, yade = tables["verdicts"], tables["yade"]
    if verdicts.empty:
        wanted = data.config["assessment"]["motions"]
        said = (
            f"Not made: it wants motions of as many stations as assessment.motions says ({wanted})."
        )
        return {"lines": [said], "picture": None, "tables": []}
    lines = [verdict.dynamic_check(verdicts, data.fit, tables["shaken"]), _motions(data)]
    if len(yade) and ((yade["d_yade_m"] / yade["d_m"] - 1.0).abs() > APART).any():
        lines.append(
            "YADE and the planar solver differ by more than a tenth in a history below. So far "
            "from rest small differences grow in a single one; the check rests on all of them."
        )
    low, high, _ = data.fit
    picture = Picture(
        partial(pictures.selected, tables["selected_spectra"]),
        50.0,
        "Spectra of 5 %: the demand, the motions' mean, and each motion.",
        f"The mean lies {per_cent(low)} to {per_cent(high)} from the demand.",
        f"{folder}/selected_spectra.csv",
    )
    return {
        "lines": lines,
        "picture": picture,
        "tables": [_decided(data), *([_in_yade(yade, folder)] if len(yade) else [])],
    }


def bare_said(row):
    """What a verdict's row says of d_SLV without the links that give way early; mostly nothing."""
    limit_m = getattr(row, "d_slv_bare_m", float("nan"))
    if limit_m != limit_m:
        return ""
    return f" ({1e3 * limit_m:.0f} mm without a link: {'' if row.slv_bare else 'not '}held)"


def _decided(data):
    """Table of the model that governs, and of the mechanism that decides in each other model."""
    verdicts, shaken = data.tables["verdicts"], data.tables["shaken"]
    governs = verdict.decided_by(verdicts)
    names = dict(zip(shaken["part"], shaken["mechanism"], strict=True))
    worst = verdict.deciding(verdicts)
    shown = pd.concat(
        [verdicts[verdicts["model"] == governs], worst[worst["model"] != governs]],
        ignore_index=True,
    )
    rows = [
        (
            f"{r.model}, {names[r.part]}",
            f"{r.exceed_d0:.0f} of {r.motions:.0f}",
            f"{1e3 * r.mean_d_m:.0f} mm",
            f"{1e3 * r.d_slv_m:.0f}, {1e3 * r.d_slc_m:.0f} mm{bare_said(r)}",
            held,
            "held" if r.slc else "not held",
            per_cent(r.agree),
        )
        for r, held in zip(shown.itertuples(), verdict.held_or_not(shown), strict=True)
    ]
    strong = tuple(k for k, r in enumerate(shown.itertuples()) if r.model == governs)
    return Table(
        "The code's dynamic check (C8.7.1.2.1.9): held if no history exceeds d0 and the mean of "
        "the largest displacements of the top does not exceed d_SLV (d_SLC). Last column: share of "
        "sets of one perturbed history a motion that give the same verdict on SLV; a "
        "check that is held in fewer than 95 % of them is in doubt and counts as not held. In bold "
        "the model that governs; of the others the mechanism that decides.",
        ("model, mechanism", "beyond d0", "mean", "d_SLV, d_SLC", "SLV", "SLC", "same verdict"),
        rows,
        (0.34, 0.1, 0.09, 0.15, 0.1, 0.1, 0.12),
        f"{data.folder}/dynamic_check_*.csv",
        strong,
    )


def _motions(data):
    """The selected motions and how their mean fits the demand."""
    motions, (low, high, fits) = data.tables["selected_motions"], data.fit
    factors = motions["factor"]
    return (
        f"{len(motions)} recorded motions, one horizontal component a station (appendix C), "
        f"factors {factors.min():.2f} to {factors.max():.2f}, in "
        f"{'both directions' if len(data.config['directions']) == 2 else 'one direction'}. Their "
        f"mean spectrum lies {per_cent(low)} to {per_cent(high)} from the demand's between "
        f"{data.range_s[0]:.2f} and {data.range_s[1]:.2f} s, "
        f"{'within' if fits else 'outside'} the code's −10 to +30 %."
    )


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
        "Run again in YADE, the discrete element program, of the model and mechanism that decide.",
        ("history", "", "planar solver", "YADE"),
        rows,
        (0.3, 0.34, 0.16, 0.2),
        f"{folder}/dynamic_check_yade.csv",
    )


def suite(data):
    """Collapse under all motions of the run, by model."""
    dynamic, rows = data.tables["dynamic"], []
    for r in dynamic.itertuples():
        middle, share = g3(r.median_pga_g), "–"
        if r.probability == r.probability:  # from enough stations
            middle += f" ({g3(r.ci_low_g)} to {g3(r.ci_high_g)})"
            share = "".join(verdict.collapses(r))
        curves = f"{r.curves} ({r.never_collapsed})"
        of = f"{r.model}, {'whole façade' if r.mechanisms == 1 else f'{r.mechanisms} mechanisms'}"
        rows.append((of, middle, g3(r.dispersion), share, curves))
    return Table(
        "Every motion of the run scaled until the façade falls: PGA of half collapse, and collapse "
        "at the demand's PGA. In brackets 95 % intervals, stations drawn with replacement; none "
        "from fewer than seven stations. A motion fells the façade where it fells any mechanism. "
        "In bold the model that the rate rests on.",
        ("model", "median PGA [g]", "dispersion", "collapse at the demand", "curves (stood)"),
        rows,
        (0.22, 0.25, 0.12, 0.24, 0.17),
        f"{data.folder}/dynamic.csv",
        tuple(k for k, model in enumerate(dynamic["model"]) if model == data.relied),
    )


def rate(data):
    """Annual rate by model and hazard curve; why there is none."""
    rates = data.tables["rate"]
    if rates.empty:
        why = verdict.no_rate(data.tables["dynamic"], data.config)
        return {"lines": [why], "tables": []}
    rows = [
        (
            r.model,
            r.hazard,
            f"{powered(r.annual_rate)} ({powered(r.rate_low)} to {powered(r.rate_high)})",
            f"{100 * r.probability:.2g} %",
            per_cent(r.outside_share),
        )
        for r in rates.itertuples()
    ]
    table = Table(
        f"Annual rate of collapse with its 95 % interval, and the probability within "
        f"{rates['years'].iloc[0]:g} years: the lognormal curve of all motions over each hazard "
        "curve. Last column: share of the rate from beyond the ends of the hazard curve, where it "
        "goes on as a power law.",
        ("model", "hazard", "collapses a year", "in that time", "from beyond"),
        rows,
        (0.1, 0.3, 0.32, 0.14, 0.14),
        f"{data.folder}/rate.csv",
        tuple(k for k, model in enumerate(rates["model"]) if model == data.relied),
    )
    first, last = rates["pga_first_g"].iloc[0], rates["pga_last_g"].iloc[0]
    stands = wall_named(data.config["facade"])
    lines = [
        f"The hazard of {rates['hazard'].iloc[0]} goes from {g3(first)} to {g3(last)} g of PGA on "
        f"the ground of the site. The rate depends on the wall, here {stands} (docs/risk.md); "
        "uncertainty of hazard, material and model is not in the intervals."
    ]
    return {"lines": lines, "tables": [table]}


def sensitivity(data):
    """Pictures and table of what changes the answers."""
    code, dynamic = data.tables["code_sensitivity"], data.tables["dynamic_sensitivity"]
    own = data.tables["code_checks"]
    own = own[own["part"] == data.weakest.part].set_index("check")["ratio"]
    drawn, tables, before = [], [], None
    for key, words in (("slv_ground", "ground"), ("slv_height", "floor")):
        part = code[code["check"] == key].rename(columns={"ratio": "value"})
        values = part[["key", "factor", "value"]].to_numpy().tolist()
        if part.empty or key not in own or values == before:
            continue
        before = values
        drawn.append(
            Picture(
                partial(pictures.tornado, part, own[key], "PGA of failure over the demand's [-]"),
                42.0,
                f"Sensitivity of the non-linear SLV check, {words}; line: as stated. What changes "
                "nothing is left out.",
                "; ".join(f"{r.key} ×{r.factor:g} gives {g3(r.value)}" for r in part.itertuples()),
                f"{data.folder}/code_sensitivity.csv",
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
        falls = " At 0 it falls by its own weight." if (found["ratio"] == 0.0).any() else ""
        tables.append(
            Table(
                f"Sensitivity of the dynamic answer ({dynamic['model'].iloc[0]}): PGA of half "
                f"collapse over that of the façade as stated, for some of the motions.{falls}",
                ("parameter", "factors", "median ratios", "ranges over motions", "motions"),
                rows,
                (0.28, 0.14, 0.18, 0.29, 0.11),
                f"{data.folder}/dynamic_sensitivity.csv",
            )
        )
    return {"pictures": drawn, "tables": tables}
