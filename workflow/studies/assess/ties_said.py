"""What the report says of rows of ties: its sentence on the first page, and its section."""

import math

from studies.assess import names
from studies.assess.catalogue import NOTHING
from studies.assess.paper import Table
from studies.assess.verdict import together


def answer(data):
    """The answer on ties, for the first page."""
    say, rows, after, tried = (
        data.say,
        *(data.tables[k] for k in ("ties", "ties_mechanisms", "ties_tried")),
    )
    if data.config["assessment"]["tie_levels_m"] == []:
        return say("ties.none.not_looked_for")
    beyond = after[after["beyond"] == 1].drop_duplicates("part")
    if rows.empty:
        return _none(data, beyond) + alone(data)
    model, made = rows["relied"].iloc[0], len(tried) > 0
    words = _passing(data, model, made)
    if len(beyond):
        left = say.all_of(name for name, _ in together(beyond, say))
        words += say("ties.not_held", names=left)
    if rows["built_holds"].all():
        words += say("ties.margin", margin=rows["margin"].iloc[0])
    else:
        words += say("ties.no_margin")
    if not made:
        words += say("ties.not_made")
    words += say("ties.anchors", each="; ".join(_anchor(r, say) for r in rows.itertuples()))
    return words + not_shaken(after, say) + beside(after, model, say) + alone(data)


def _passing(data, model, made):
    """How many mechanisms pass with the rows, by hand and with the model that they are for."""
    say, rows, after = data.say, data.tables["ties"], data.tables["ties_mechanisms"]
    every = after.drop_duplicates("part")
    about = {"rows": say.all_of(_row(r, say) for r in rows.itertuples())}
    about["by_hand"] = counted(every["ratio"] >= 1.0, say)
    if not made:
        return say.count("ties.passes", len(rows), **about)
    shaken = after[after["model"] == model]
    held = counted(shaken["holds"].astype(float) == 1.0, say)
    return say.count("ties.passes_both", len(rows), **about, held=held, model=model)


def counted(flags, say):
    """How many of some are true: all of them, or so many of so many."""
    count, of = int(flags.sum()), len(flags)
    return say("ties.every", of=of) if count == of else say("ties.some", count=count, of=of)


def _none(data, beyond):
    """What is said where no row is recommended."""
    say = data.say
    if len(beyond):
        left = say.all_of(name for name, _ in together(beyond, say))
        return say("ties.none.beyond", names=left)
    besides = "_besides" if data.facade.ties else ""
    if not len(data.tables["ties_tried"]):
        return say(f"ties.none.by_hand{besides}")
    return say(f"ties.none.needed{besides}", model=data.relied)


def _row(row, say):
    """One row of ties in words: rods, level, force."""
    return say(
        "ties.row",
        count=row.count,
        diameter_mm=row.diameter_mm,
        yield_mpa=row.yield_mpa,
        height_m=row.height_m,
        force_kn=row.force_built_kn,
    )


def _anchor(row, say):
    """What each anchor of a row carries and holds."""
    about = {"height_m": row.height_m, "load_kn": row.anchor_load_kn, "anchor_kn": row.anchor_kn}
    return say(f"ties.anchor.{row.anchor_by}", **about)


def not_shaken(after, say):
    """Sentence on the mechanisms of the tied façade that are judged by hand alone."""
    left = after[after["why_not"].fillna("") != ""].drop_duplicates("part")
    each = []
    for why, part in left.groupby("why_not", sort=False):
        listed = say.all_of(name for name, _ in together(part, say))
        each.append(say("ties.left", names=listed, why=say(f"ties.why.{why}")))
    return say("ties.by_hand_alone", each="; ".join(each)) if each else ""


def beside(after, model, say):
    """Sentence on what these rows do with the other models."""
    each = []
    for name in [m for m in after["model"].dropna().unique() if m not in ("", model)]:
        rows = after[after["model"] == name]
        lost = int((rows["holds"].astype(float) == 0.0).sum())
        if lost:
            each.append(say("ties.beside_lost", model=name, lost=lost, of=len(rows)))
        else:
            each.append(say("ties.beside_all", model=name))
    return say("ties.beside", each=say.all_of(each)) if each else ""


def alone(data):
    """Remark on what the other models ask for by themselves; nothing where there are none."""
    say, table, each = data.say, data.tables["ties_models"], []
    for model, part in table.groupby("model", sort=False):
        rows = part[part["force_kn"].fillna(0.0) > 0.0]
        if not part["holds"].all():
            each.append(say("ties.alone_more", model=model))
        elif len(rows):
            forces = say.all_of(
                say("ties.alone_force", force_kn=r.force_kn, height_m=r.height_m)
                for r in rows.itertuples()
            )
            each.append(say("ties.alone_forces", model=model, forces=forces))
        else:
            each.append(say("ties.alone_none", model=model))
    return say("ties.alone", each=say.all_of(each)) if each else ""


def asked_by(row, after, say):
    """What fails with 95 % of a row of ties.csv; `after` is the table of mechanisms."""
    if not isinstance(row.governed_part, str) or not row.governed_part:
        return say("ties.asked_by_hand")
    known = after[after["part"] == row.governed_part]
    name = names.name(next(known.itertuples()), say) if len(known) else row.governed_part
    return say("ties.asked_by", name=name, model=row.model)


def section(data):
    """Lines and tables of the rows of ties with which the façade passes."""
    say, rows, after = data.say, data.tables["ties"], data.tables["ties_mechanisms"]
    beyond = after[after["beyond"] == 1].drop_duplicates("part")
    lines, tables, assessment = [answer(data)], [], data.config["assessment"]
    if len(rows):
        tables = [_rows(data), _after(data)]
        lines.append(
            say(
                f"ties.how.{'stated' if assessment['tie_length_m'] else 'width'}",
                folder=data.folder,
                length_m=rows["length_m"].iloc[0],
                plate_m=assessment["anchor_plate_m"],
                shear_mpa=assessment["masonry_shear_mpa"],
                compression_mpa=assessment["masonry_compression_mpa"],
            )
        )
    if len(beyond):
        key = "opens" if beyond["held_m"].notna().any() else "any"
        each = "; ".join(names.the(row, say) for row in beyond.itertuples())
        lines.append(say(f"ties.beyond.{key}", names=each))
    return {"lines": lines, "tables": tables}


def _rows(data):
    """Table of the rows in steel, and the check of their anchors."""
    say, after, cells = data.say, data.tables["ties_mechanisms"], []
    for r in data.tables["ties"].itertuples():
        by = say(f"ties.table.{r.anchor_by}")
        load = {"load_kn": r.anchor_load_kn, "anchor_kn": r.anchor_kn, "most": r.anchors_most}
        rods = {"diameter_mm": r.diameter_mm, "yield_mpa": r.yield_mpa}
        cells.append(
            (
                say("ties.table.at", height_m=r.height_m),
                say.number(r.force_by_hand_kn, "kn") if r.force_by_hand_kn else NOTHING,
                say.number(r.force_kn, "kn"),
                say("ties.table.of_rods", count=r.count, **rods),
                say.number(r.force_built_kn, "kn"),
                say("ties.table.of_anchor", by=by, count=r.count, **load),
                asked_by(r, after, say),
            )
        )
    columns = ("level", "by_hand", "least", "rods", "force", "anchor", "asked")
    return Table(
        say("ties.table.caption"),
        tuple(say(f"ties.table.{key}") for key in columns),
        cells,
        (0.08, 0.1, 0.1, 0.16, 0.1, 0.24, 0.22),
        f"{data.folder}/ties.csv",
    )


def _after(data):
    """Table of what every mechanism then does, by hand and with every model."""
    say, after, told = data.say, data.tables["ties_mechanisms"], []
    models = [m for m in after["model"].dropna().unique() if m]
    for _, part in after.groupby("part", sort=False):
        first = next(part.itertuples())
        by_model = part.set_index("model")
        cells = [
            _of_model(by_model.loc[m], say) if m in by_model.index else NOTHING for m in models
        ]
        name = named(first, say, isinstance(first.why_not, str) and first.why_not)
        by_hand = {"pga_g": first.pga_fails_g, "share": first.ratio}
        told.append((name, say("table.pga_share", **by_hand), *cells))
    return Table(
        say("ties.after.caption"),
        (say("ties.after.mechanism"), say("ties.after.by_hand"), *models),
        told,
        (0.36, 0.16, *[0.48 / max(len(models), 1)] * len(models)),
        f"{data.folder}/ties_mechanisms.csv",
    )


def named(row, say, why):
    """Name of a mechanism in a table, with the reason where it is not shaken."""
    name = names.name(row, say)
    if not why:
        return name
    reason = say(f"verdict.why_told.{why}", pga_g=row.pga_fails_g)
    return say("table.not_shaken", name=name, why=reason)


def _of_model(row, say):
    """What the dynamic check says of one mechanism under one model."""
    if math.isnan(row["mean_d_m"]):
        return NOTHING
    about = {"mean": 1e3 * row["mean_d_m"], "slv_m": row["d_slv_m"]}
    key = "ties.after.passes" if row["holds"] else "ties.after.fails"
    if row["exceed_d0"]:
        return say(f"{key}_beyond", **about, count=row["exceed_d0"])
    return say(key, **about)
