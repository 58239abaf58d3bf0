"""Tables and pictures of the assessment report's body: mechanisms, dynamic answers, rate."""

from functools import partial

import pandas as pd

from studies.assess import pictures, verdict, walls
from studies.assess.catalogue import NOTHING
from studies.assess.code_tables import DAMAGED_KEYS
from studies.assess.paper import Picture, Table
from studies.assess.shaken import is_far
from studies.assess.sites import WHOLE_PART
from studies.assess.ties_said import named

SHOWN = (
    *("linear_ground", "linear_height", "slv_ground", "slv_height", "slc_ground", "slc_height"),
    *("en_sd_ground", "en_sd_height", "en_nc_ground", "en_nc_height"),
    "housner",
)
APART = 0.1  # of two solvers' displacements, from which on it is said


def heads(say, table, *keys):
    """Heads of a table's columns; an empty key has an empty head."""
    return tuple(say(f"table.{table}.{key}") if key else "" for key in keys)


def with_unit(value, unit, say):
    """Three figures with their unit, where there is one."""
    figures = say.number(value, "g3")
    return figures if unit == "-" else f"{figures} {unit}"


def by_mechanism(data):
    """Mechanism by mechanism: by hand, by the code's dynamic check, half collapse by model."""
    say, tables = data.say, data.tables
    shaken, parts = tables["shaken"], tables["parts_dynamic"]
    verdicts, models = tables["verdicts"], list(tables["dynamic"]["model"])
    stated = verdict.as_stated(tables["mechanisms"]).set_index("part")
    half = {(r.part, r.model): _half(r, say) for r in parts.itertuples()}
    held = {}
    if len(verdicts):
        keys = verdicts.assign(key=verdict.held_or_not(verdicts))
        held = keys.set_index(["part", "model"])["key"].to_dict()
    rows = []
    for r in shaken.itertuples():
        cells = [NOTHING] * len(models)
        for k, model in enumerate(models if r.shaken else ()):
            cells[k] = half.get((r.part, model), NOTHING)
            if (r.part, model) in held:
                told = say(f"verdict.held.{held[r.part, model]}")
                cells[k] = say("table.held_half", held=told, half=cells[k])
        by_hand = {"pga_g": r.pga_fails_g, "share": r.pga_fails_g / data.demand_g}
        name = named(r, say, "" if r.shaken else r.why_not)
        alpha = say.number(stated.loc[r.part]["multiplier"], ".4f")
        rows.append((name, alpha, say("table.pga_share", **by_hand), *cells))
    share, governs = 0.42 / len(models), verdict.decided_by(verdicts)
    own_heads = [say("table.governs", model=m) if m == governs else m for m in models]
    caption = f"table.mechanisms.caption_{'some' if is_far(shaken).any() else 'all'}"
    return Table(
        say(caption, within=data.config["assessment"]["shaken_within"]),
        (*heads(say, "mechanisms", "mechanism", "alpha", "by_hand"), *own_heads),
        rows,
        (0.36, 0.08, 0.14, *[share] * len(models)),
        f"{data.folder}/parts_dynamic.csv",
        (0,),
    )


def _half(row, say):
    """Median PGA of half collapse; a word where most motions felled another mechanism before."""
    if row.never_collapsed > 0.5 * row.curves:
        return say("table.later")
    return say.number(row.median_pga_g, "g3")


def checks(data):
    """Checks of the mechanism that fails first and of the whole façade, a table each."""
    say, tables = data.say, []
    for part, rows in data.tables["code_checks"].groupby("part", sort=False):
        by_check = rows.set_index("check")
        cells = [
            (
                say(f"table.check.{key}"),
                with_unit(r["capacity"], r["unit"], say),
                with_unit(r["demand"], r["unit"], say),
                say(f"table.checks.{'passes' if r['ratio'] >= 1.0 else 'fails'}"),
                say.number(r["pga_fails_g"], "g3"),
                say.number(r["ratio"], "g3"),
            )
            for key, r in by_check.loc[[key for key in SHOWN if key in by_check.index]].iterrows()
        ]
        caption = f"table.checks.caption{'_ground' if 'slv_ground' in by_check.index else ''}"
        tables.append(
            Table(
                say(caption, name=data.names[part]),
                heads(say, "checks", "check", "capacity", "demand", "", "fails_at", "over"),
                cells,
                (0.36, 0.15, 0.15, 0.1, 0.12, 0.12),
                f"{data.folder}/code_checks.csv",
            )
        )
    return tables


def dynamic_check(data):
    """Lines, picture and tables of the code's dynamic check."""
    say, tables, folder = data.say, data.tables, data.folder
    verdicts, yade = tables["verdicts"], tables["yade"]
    if verdicts.empty:
        wanted = data.config["assessment"]["motions"]
        return {
            "lines": [say("table.dynamic.not_made", wanted=wanted)],
            "picture": None,
            "tables": [],
        }
    lines = [_motions(data)]
    if len(yade) and ((yade["d_yade_m"] / yade["d_m"] - 1.0).abs() > APART).any():
        lines.append(say("table.dynamic.apart"))
    low, high, _ = data.fit
    picture = Picture(
        partial(pictures.selected, say, tables["selected_spectra"]),
        50.0,
        say("table.dynamic.picture"),
        say("table.dynamic.picture_words", low=low, high=high),
        f"{folder}/selected_spectra.csv",
    )
    return {
        "lines": lines,
        "picture": picture,
        "tables": [_decided(data), *([_in_yade(data)] if len(yade) else [])],
    }


def bare_said(row, say):
    """What a verdict's row says of d_SLV without the links that give way early; mostly nothing."""
    limit_m = getattr(row, "d_slv_bare_m", float("nan"))
    if limit_m != limit_m:
        return ""
    key = "table.dynamic.bare_held" if row.slv_bare else "table.dynamic.bare_lost"
    return say(key, slv_m=limit_m)


def _decided(data):
    """Table of the model that governs, and of the mechanism that decides in each other model."""
    say, verdicts = data.say, data.tables["verdicts"]
    governs = verdict.decided_by(verdicts)
    worst = verdict.deciding(verdicts)
    shown = pd.concat(
        [verdicts[verdicts["model"] == governs], worst[worst["model"] != governs]],
        ignore_index=True,
    )
    rows = [
        (
            say("table.model_of", model=r.model, of=data.names[r.part]),
            say("table.of", count=r.exceed_d0, all=r.motions),
            say.number(r.mean_d_m, "mm"),
            say("table.dynamic.both_limits", slv=1e3 * r.d_slv_m, slc_m=r.d_slc_m)
            + bare_said(r, say),
            say(f"verdict.held.{held}"),
            say(f"verdict.held.{verdict.HELD if r.slc else verdict.LOST}"),
            say.number(r.agree, "percent"),
        )
        for r, held in zip(shown.itertuples(), verdict.held_or_not(shown), strict=True)
    ]
    strong = tuple(k for k, r in enumerate(shown.itertuples()) if r.model == governs)
    return Table(
        say("table.dynamic.caption"),
        heads(say, "dynamic", "model", "beyond", "mean", "limits", "slv", "slc", "same"),
        rows,
        (0.34, 0.1, 0.09, 0.15, 0.1, 0.1, 0.12),
        f"{data.folder}/dynamic_check_*.csv",
        strong,
    )


def _motions(data):
    """The selected motions and how their mean fits the demand."""
    say, motions, (low, high, fits) = data.say, data.tables["selected_motions"], data.fit
    factors, both = motions["factor"], len(data.config["directions"]) == 2
    key = f"table.dynamic.motions_{'both' if both else 'one'}"
    told = say(key, n=len(motions), least=factors.min(), most=factors.max())
    ends = {"low": low, "high": high, "from_s": data.range_s[0], "to_s": data.range_s[1]}
    return f"{told} {say('table.dynamic.fits' if fits else 'table.dynamic.misfits', **ends)}"


def _in_yade(data):
    """Histories of the dynamic check that YADE ran again."""
    say, rows = data.say, []
    columns = ["model", "part", "record", "direction", "pga_g", "d_m", "d_yade_m", "status_yade"]
    for values, part in data.tables["yade"].groupby(columns, sort=False, dropna=False):
        model, piece, record, direction, _, d_m, d_yade_m, status = values
        about = {"model": model, "record": record, "direction": say(f"table.direction.{direction}")}
        if piece == WHOLE_PART:
            history = say("table.yade.whole", **about)
        else:
            history = say("table.yade.part", **about, name=data.names[piece])
        which = say.all_of(say(f"table.yade.which.{key}") for key in part["which"])
        told = say("table.yade.length", d_m=d_yade_m, status=say(f"table.yade.status.{status}"))
        rows.append((history, which, say.number(d_m, "mm"), told))
    return Table(
        say("table.yade.caption"),
        heads(say, "yade", "history", "", "planar", "yade"),
        rows,
        (0.34, 0.26, 0.16, 0.24),
        f"{data.folder}/dynamic_check_yade.csv",
    )


def suite(data):
    """Collapse under all motions of the run, by model."""
    say, dynamic, rows = data.say, data.tables["dynamic"], []
    for r in dynamic.itertuples():
        middle, share = say.number(r.median_pga_g, "g3"), NOTHING
        if r.probability == r.probability:  # from enough stations
            low, high = (say.number(v, "g3") for v in (r.ci_low_g, r.ci_high_g))
            middle = say("table.interval", value=middle, low=low, high=high)
            share = "".join(verdict.collapses(r, say, bare=True))
        curves = f"{r.curves} ({r.never_collapsed})"
        alone = r.mechanisms == 1
        of = say("table.suite.whole") if alone else say("table.suite.several", n=r.mechanisms)
        name = say("table.model_of", model=r.model, of=of)
        rows.append((name, middle, say.number(r.dispersion, "g3"), share, curves))
    return Table(
        say("table.suite.caption"),
        heads(say, "suite", "model", "median", "dispersion", "collapse", "curves"),
        rows,
        (0.22, 0.25, 0.12, 0.24, 0.17),
        f"{data.folder}/dynamic.csv",
        tuple(k for k, model in enumerate(dynamic["model"]) if model == data.relied),
    )


def rate(data):
    """Annual rate by model and hazard curve; why there is none."""
    say, rates = data.say, data.tables["rate"]
    if rates.empty:
        why = verdict.no_rate(data.tables["dynamic"], data.config, say)
        return {"lines": [why], "tables": []}
    rows = [
        (
            r.model,
            r.hazard,
            say("table.rate.value", rate=r.annual_rate, low=r.rate_low, high=r.rate_high),
            say("table.rate.probability", percent=100 * r.probability),
            say.number(r.outside_share, "percent"),
        )
        for r in rates.itertuples()
    ]
    table = Table(
        say("table.rate.caption", years=rates["years"].iloc[0]),
        heads(say, "rate", "model", "hazard", "rate", "time", "beyond"),
        rows,
        (0.1, 0.3, 0.32, 0.14, 0.14),
        f"{data.folder}/rate.csv",
        tuple(k for k, model in enumerate(rates["model"]) if model == data.relied),
    )
    first = next(rates.itertuples())
    ends = {"first_g": first.pga_first_g, "last_g": first.pga_last_g}
    wall = walls.named(data.facade, say)
    lines = [say("table.rate.line", hazard=first.hazard, **ends, wall=wall)]
    return {"lines": lines, "tables": [table]}


def varied(key, say):
    """What was varied, in words: a key of the configuration stays as it is."""
    if key in walls.WALL_KEYS:
        return say(f"table.sensitivity.{walls.WALL_KEYS[key]}")
    damping = {name: value for value, name in DAMAGED_KEYS.items()}.get(key)
    return key if damping is None else say("table.sensitivity.damaged", damping=damping)


def sensitivity(data):
    """Pictures and table of what changes the answers."""
    ratios = data.tables["dynamic_sensitivity"].dropna(subset=["ratio"])
    return {
        "pictures": _of_the_check(data),
        "tables": [_of_the_collapse(data, ratios)] if len(ratios) else [],
    }


def _of_the_check(data):
    """Pictures of what changes the non-linear check, on the ground and on the floor."""
    say, code, by_check = data.say, data.tables["code_sensitivity"], data.tables["code_checks"]
    by_check = by_check[by_check["part"] == data.weakest.part].set_index("check")["ratio"]
    drawn, before = [], None
    for check, place in (("slv_ground", "ground"), ("slv_height", "floor")):
        part = code[code["check"] == check].rename(columns={"ratio": "value"})
        values = part[["key", "factor", "value"]].to_numpy().tolist()
        if part.empty or check not in by_check or values == before:
            continue
        before = values
        part = part.assign(key=[varied(key, say) for key in part["key"]])
        told = [
            say("table.sensitivity.words", key=r.key, factor=r.factor, value=r.value)
            for r in part.itertuples()
        ]
        drawn.append(
            Picture(
                partial(pictures.tornado, say, part, by_check[check]),
                42.0,
                say(f"table.sensitivity.{place}"),
                "; ".join(told),
                f"{data.folder}/code_sensitivity.csv",
            )
        )
    return drawn


def _of_the_collapse(data, ratios):
    """Table of what changes the PGA of half collapse."""
    say, rows = data.say, []
    spread = ratios.groupby(["key", "factor"], sort=False)["ratio"].agg(
        ["median", "min", "max", "size"]
    )
    for key, part in spread.groupby(level="key", sort=False):
        ranges = [
            say("table.range", low=s.low, high=s.high)
            for s in part.rename(columns={"min": "low", "max": "high"}).itertuples()
        ]
        factors = part.index.get_level_values("factor")
        rows.append(
            (
                varied(key, say),
                "; ".join(f"×{say.number(f, 'g')}" for f in factors),
                "; ".join(say.number(m, "g3") for m in part["median"]),
                "; ".join(ranges),
                str(part["size"].min()),
            )
        )
    falls = "_falls" if (ratios["ratio"] == 0.0).any() else ""
    return Table(
        say(f"table.sensitivity.caption{falls}", model=ratios["model"].iloc[0]),
        heads(say, "sensitivity", "parameter", "factors", "medians", "ranges", "motions"),
        rows,
        (0.28, 0.14, 0.18, 0.29, 0.11),
        f"{data.folder}/dynamic_sensitivity.csv",
    )
