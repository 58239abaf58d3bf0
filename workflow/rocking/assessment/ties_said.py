"""What the report says of rows of ties: its sentence on the first page, and its section."""

import math

from rocking.assessment import verdict
from rocking.assessment.paper import Table
from rocking.assessment.verdict import g3, per_cent, the, words_of

SAME_KN = 0.05  # forces are said to a tenth


def answer(data):
    """The answer on ties, for the first page."""
    rows, after, tried = (data.tables[k] for k in ("ties", "ties_mechanisms", "ties_tried"))
    by_hand, held = verdict.passes(
        *(data.tables[k] for k in ("code_checks", "mechanisms", "verdicts"))
    )
    if data.config["assessment"]["tie_levels_m"] == []:
        return "Not looked for: assessment.tie_levels_m is empty."
    if by_hand and held is not False:
        beside = " besides those that are there" if data.config["facade"]["ties"] else ""
        if held is None:
            return f"None{beside} are needed by hand; the dynamic check was not made."
        return f"None{beside} are needed for this demand."
    kept = rows[rows["force_kn"] > 0.0]
    if kept.empty:
        return "No row at floors or eaves makes the façade pass; what fails is named under Ties."
    said = words_of(
        [
            f"{kn(r.force_kn)} at {r.height_m:.2f} m ({r.count} φ{r.commercial_mm:g}, "
            f"{r.yield_mpa:g} MPa)"
            for r in kept.itertuples()
        ]
    )
    left = [the(name) for name in after.loc[after["beyond"] == 1, "mechanism"]]
    models = words_of(list(data.tables["verdicts"]["model"].unique()))
    what, rest, alone = "the kinematic checks", "", ""
    if len(tried):
        what += f" and the dynamic check with {models}"
    else:
        rest = "; the dynamic check was not made"
    if left:
        some = "one mechanism" if len(left) == 1 else f"{len(left)} mechanisms"
        alone = " With ties at these levels alone the façade does not pass."
        rest = f" for all but {some} that no row at these levels holds, {words_of(left)}{rest}"
    many = len(kept) > 1
    with_rows = f"With {'rows' if many else 'a row'} of ties of {said}"
    more = less(many, bool(left)) + as_sold(kept) + relied(rows)
    return f"{with_rows} {what} pass{rest}.{alone} {more}"


def kn(force_kn):
    """A force to a tenth, and to two digits where that would leave nothing of it."""
    return f"{force_kn:.1f} kN" if force_kn >= SAME_KN else f"{force_kn:.2g} kN"


def less(many, beyond):
    """Sentence on 95 % of a row: each was tried, the others as they are."""
    of = "any one row, the others as they are," if many else "the force"
    return f"With 95 % of {of} {'a further mechanism fails' if beyond else 'they do not'}."


def as_sold(rows):
    """Sentence on the rods that are sold, which stand in brackets; nothing where none was tried."""
    if rows["sold_holds"].isna().any():
        return ""
    return f" With the rods in brackets {'the same' if rows['sold_holds'].all() else 'fewer'} pass."


def relied(rows):
    """Sentence on what the model that the rate rests on asks for by itself, where it is other."""
    other = (rows["force_relied_kn"] - rows["force_kn"]).abs() > SAME_KN
    if not other.any():
        return ""
    own = rows[rows["force_relied_kn"] > 0.0]
    said = [f"{kn(r.force_relied_kn)} at {r.height_m:.2f} m" for r in own.itertuples()]
    return f" {rows['relied'].iloc[0]} by itself asks for {words_of(said) if said else 'none'}."


def asked_by(row):
    """What fails with 95 % of a row of ties.csv."""
    by_hand = not isinstance(row.governed_by, str) or not row.governed_by
    return "checks by hand" if by_hand else f"{row.governed_by}, {row.model}"


def section(data):
    """Lines and tables of the rows of ties with which the façade passes."""
    rows, after, folder = data.tables["ties"], data.tables["ties_mechanisms"], data.folder
    rows = rows[rows["force_kn"] > 0.0]
    beyond = after[after["beyond"] == 1]
    lines, tables = [answer(data)], []
    if len(rows):
        tables = [_rows(rows, folder), _after(after, folder)]
        lines.append(
            f"To assess the façade with these rows under the same motions, give {folder}/ties.yaml "
            "after its own file. "
            "By hand alone each row is the least: with less in any one of them a mechanism fails. "
            "Under the motions rows that pull on a failing mechanism grow until it holds, one or "
            "all of them, by the least force in sum; then each gives back what the others have "
            "made needless, until 95 % of any one row is too little."
        )
    if len(beyond):
        bends = beyond["mechanism"].str.startswith("vertical").any()
        where = ", such as the height at which a wall opens as it bends" * bool(bends)
        lines.append(
            f"Not held by rows at these levels: {'; '.join(map(the, beyond['mechanism']))}. Hold "
            f"these otherwise, or state further levels in assessment.tie_levels_m{where}."
        )
    return {"lines": lines, "tables": tables}


def _rows(rows, folder):
    """Table of the rows in steel."""
    return Table(
        "Least rows with which every mechanism passes, and what they take in steel. The force is "
        "that of the whole row at yield; anchors have to hold more than the rods. Last column: "
        "what fails with 95 % of it.",
        ("level", "by hand", "with the dynamic check", "rods", "diameter", "asked for by"),
        [
            (
                f"{r.height_m:.2f} m",
                kn(r.force_by_hand_kn) if r.force_by_hand_kn else "–",
                kn(r.force_kn),
                f"{r.count} of {r.yield_mpa:g} MPa, {r.length_m:g} m long",
                f"{r.diameter_mm:.1f} mm, sold as φ{r.commercial_mm:g}",
                asked_by(r),
            )
            for r in rows.itertuples()
        ],
        (0.1, 0.12, 0.16, 0.2, 0.16, 0.26),
        f"{folder}/ties.csv",
    )


def _after(after, folder):
    """Table of what every mechanism then does."""
    told = []
    for r in after.itertuples():
        shaken = "–"
        if not math.isnan(r.mean_d_m):
            over = f", {r.exceed_d0:.0f} beyond d0" if r.exceed_d0 else ""
            shaken = f"{1e3 * r.mean_d_m:.0f} of {1e3 * r.d_slv_m:.0f} mm{over}"
        word = "remains" if r.beyond else "passes"
        told.append((r.mechanism, g3(r.pga_fails_g), per_cent(r.ratio), shaken, word))
    return Table(
        "What every mechanism then does: by hand, and in the dynamic check of the model under "
        "which it comes nearest to its d_SLV, the mean of the largest displacements (up to the "
        "first history beyond d0).",
        ("mechanism with these rows", "by hand [g]", "of demand", "shaken", ""),
        told,
        (0.42, 0.12, 0.12, 0.24, 0.1),
        f"{folder}/ties_mechanisms.csv",
    )
