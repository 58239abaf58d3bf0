"""What the report says of rows of ties: its sentence on the first page, and its section."""

import math

from studies.assess.anchors import CRUSHING, PUNCHING
from studies.assess.paper import Table
from studies.assess.shaken import CORNER, FAR, NARROW, STOCKY
from studies.assess.verdict import g3, per_cent, the, together, words_of

BY = {PUNCHING: "it punches through the wall", CRUSHING: "the wall crushes under it"}
REASONS = {
    CORNER: "not over the whole width",
    NARROW: "not over the whole width",
    STOCKY: "too low to rock",
    FAR: "far from the demand",
}


def answer(data):
    """The answer on ties, for the first page."""
    rows, after, tried = (data.tables[k] for k in ("ties", "ties_mechanisms", "ties_tried"))
    own = data.config["assessment"]
    if own["tie_levels_m"] == []:
        return "Not looked for: assessment.tie_levels_m is empty."
    beyond = after[after["beyond"] == 1].drop_duplicates("part")
    if rows.empty:
        return _none(data, beyond) + alone(data)
    said = words_of([_row(r) for r in rows.itertuples()])
    model, made = rows["relied"].iloc[0], len(tried) > 0
    every = after.drop_duplicates("part")
    what = f"{counted(every['ratio'] >= 1.0)} mechanisms pass by hand"
    if made:
        shaken = after[after["model"] == model]
        held = counted(shaken["holds"].astype(float) == 1.0)
        what += f", and {held} that were shaken with {model}"
    words = f"{said}: with {'these rows' if len(rows) > 1 else 'this row'} {what}."
    if len(beyond):
        left = words_of([name for name, _ in together(beyond)])
        words += f" No row at these levels holds {left}."
    if rows["built_holds"].all():
        margin = rows["margin"].iloc[0]
        words += f" In rods that are sold this is {margin:g} times the least or more."
    else:
        words += " No rods that are sold, on anchors that hold them, give the margin: these do not."
    if not made:
        words += " The dynamic check was not made."
    words += " Each anchor holds its rod: "
    words += "; ".join(f"{_anchor(r)}" for r in rows.itertuples()) + "."
    return words + not_shaken(after) + beside(after, model) + alone(data)


def counted(flags):
    """How many of some are true: all of them, or so many of so many."""
    count = int(flags.sum())
    return f"all {len(flags)}" if count == len(flags) else f"{count} of {len(flags)}"


def _none(data, beyond):
    """What is said where no row is recommended."""
    if len(beyond):
        names = words_of([name for name, _ in together(beyond)])
        return f"No row at floors or eaves makes the façade pass; {names} fails with the strongest."
    standing = " besides those that are there" if data.config["facade"]["ties"] else ""
    if not len(data.tables["ties_tried"]):
        return f"None{standing} are needed by hand; the dynamic check was not made."
    return f"None{standing} are needed for this demand with {data.relied}."


def _row(row):
    """One row of ties in words: rods, level, force."""
    return (
        f"{row.count} rods φ{row.diameter_mm:g} of {row.yield_mpa:g} MPa at {row.height_m:.2f} m "
        f"({kn(row.force_built_kn)})"
    )


def _anchor(row):
    """What each anchor of a row carries and holds."""
    return (
        f"at {row.height_m:.2f} m {kn(row.anchor_load_kn)} of {kn(row.anchor_kn)}, where "
        f"{BY[row.anchor_by]}"
    )


def not_shaken(after):
    """Sentence on the mechanisms of the tied façade that are judged by hand alone."""
    left = after[after["why_not"].fillna("") != ""].drop_duplicates("part")
    if left.empty:
        return ""
    said = []
    for why, part in left.groupby("why_not", sort=False):
        names = words_of([name for name, _ in together(part)])
        said.append(f"{names} ({REASONS.get(why, part['why_words'].iloc[0])})")
    return f" Judged by hand alone: {'; '.join(said)}."


def beside(after, model):
    """Sentence on what these rows do with the other models."""
    words = []
    for name in [m for m in after["model"].dropna().unique() if m not in ("", model)]:
        own = after[after["model"] == name]
        lost = own[own["holds"].astype(float) == 0.0]
        words.append(
            f"with {name} all pass"
            if lost.empty
            else f"with {name} {len(lost)} of {len(own)} do not"
        )
    return f" With the same rows {words_of(words)}." if words else ""


def alone(data):
    """Remark on what the other models ask for by themselves; nothing where there are none."""
    table, said = data.tables["ties_models"], []
    for model, part in table.groupby("model", sort=False):
        rows = part[part["force_kn"].fillna(0.0) > 0.0]
        if not part["holds"].all():
            said.append(f"{model} asks for more than anchors at these levels hold")
        elif len(rows):
            forces = words_of(
                [f"{about(r.force_kn)} kN at {r.height_m:.2f} m" for r in rows.itertuples()]
            )
            said.append(f"{model} asks for about {forces}")
        else:
            said.append(f"{model} for none")
    return f" By itself, without margin, {words_of(said)}." if said else ""


def about(value):
    """Two digits of a number that is known roughly."""
    return f"{float(f'{value:.2g}'):g}"


def kn(force_kn):
    """A force to a tenth, and to two digits where that would leave nothing of it."""
    return f"{force_kn:.1f} kN" if force_kn >= 0.05 else f"{force_kn:.2g} kN"


def asked_by(row):
    """What fails with 95 % of a row of ties.csv."""
    by_hand = not isinstance(row.governed_by, str) or not row.governed_by
    return "checks by hand" if by_hand else f"{row.governed_by}, {row.model}"


def section(data):
    """Lines and tables of the rows of ties with which the façade passes."""
    rows, after, folder = data.tables["ties"], data.tables["ties_mechanisms"], data.folder
    beyond = after[after["beyond"] == 1].drop_duplicates("part")
    lines, tables, own = [answer(data)], [], data.config["assessment"]
    if len(rows):
        tables = [_rows(rows, folder), _after(after, folder)]
        length = "stated" if own["tie_length_m"] else "the façade's width, since none is stated"
        lines.append(
            f"To assess the façade with these rows under the same motions, give {folder}/ties.yaml "
            "after its own file. By hand each row is the least: with less in any one of them a "
            "mechanism fails. Under the motions rows that pull on a failing mechanism grow until "
            "it holds, one or all of them, by the least force in sum; then each gives back what "
            f"the others have made needless. Rods are {rows['length_m'].iloc[0]:g} m long "
            f"({length}); with fewer of them, or thinner walls, an anchor fails first. An anchor "
            f"is a plate of {own['anchor_plate_m']:g} m, its strength by masonry of τ0 = "
            f"{own['masonry_shear_mpa']:g} and f = {own['masonry_compression_mpa']:g} MPa over FC "
            "and γ_M = 2 (appendix D): verify it on site."
        )
    if len(beyond):
        opens = beyond["held_m"].notna().any()
        where = ", such as the height at which a wall opens as it bends" if opens else ""
        lines.append(
            f"Not held by rows at these levels: {'; '.join(map(the, beyond.itertuples()))}. Hold "
            f"these otherwise, or state further levels in assessment.tie_levels_m{where}."
        )
    return {"lines": lines, "tables": tables}


def _rows(rows, folder):
    """Table of the rows in steel, and the check of their anchors."""
    return Table(
        "Rows of ties that are recommended. Least: the force of the whole row with which every "
        "mechanism passes, by hand and with the dynamic check. Rods and anchors are for that force "
        "times the margin; each anchor's load is what its rod yields at. Last column: what fails "
        "with 95 % of the least.",
        ("level", "by hand", "least", "rods", "force", "anchor: load, strength", "asked for by"),
        [
            (
                f"{r.height_m:.2f} m",
                kn(r.force_by_hand_kn) if r.force_by_hand_kn else "–",
                kn(r.force_kn),
                f"{r.count} φ{r.diameter_mm:g}, {r.yield_mpa:g} MPa",
                kn(r.force_built_kn),
                f"{kn(r.anchor_load_kn)} ≤ {kn(r.anchor_kn)} ({r.anchor_by}); "
                f"{r.count} of {r.anchors_most} that fit",
                asked_by(r),
            )
            for r in rows.itertuples()
        ],
        (0.08, 0.1, 0.1, 0.16, 0.1, 0.24, 0.22),
        f"{folder}/ties.csv",
    )


def _after(after, folder):
    """Table of what every mechanism then does, by hand and with every model."""
    models = [m for m in after["model"].dropna().unique() if m]
    told = []
    for _, part in after.groupby("part", sort=False):
        first, cells = part.iloc[0], []
        own = part.set_index("model")
        for model in models:
            cells.append(_of_model(own.loc[model]) if model in own.index else "–")
        why = first["why_words"] if isinstance(first["why_words"], str) else ""
        name = f"{first['mechanism']}{f'; not shaken: {why}' if why else ''}"
        told.append((name, f"{g3(first['pga_fails_g'])} ({per_cent(first['ratio'])})", *cells))
    return Table(
        "What every mechanism then does: the PGA at which its SLV check by hand fails, over the "
        "demand's in brackets, and by model the mean of the largest displacements over d_SLV in "
        "the dynamic check (up to the first history beyond d0).",
        ("mechanism with these rows", "by hand [g]", *models),
        told,
        (0.36, 0.16, *[0.48 / max(len(models), 1)] * len(models)),
        f"{folder}/ties_mechanisms.csv",
    )


def _of_model(row):
    """What the dynamic check says of one mechanism under one model."""
    if math.isnan(row["mean_d_m"]):
        return "–"
    over = f", {row['exceed_d0']:.0f} beyond d0" if row["exceed_d0"] else ""
    word = "passes" if row["holds"] else "fails"
    return f"{word}: {1e3 * row['mean_d_m']:.0f} of {1e3 * row['d_slv_m']:.0f} mm{over}"
