"""Tables of the rows of ties that a façade is recommended; see `ties`."""

import math

from studies.assess.shaken import why_not
from studies.assess.sites import EXTENT

ROWS = ["height_m", "force_by_hand_kn", "force_kn", "margin", "force_built_kn", "count"]
ROWS += ["diameter_mm", "yield_mpa", "length_m", "anchor_kn", "anchor_load_kn", "anchor_by"]
ROWS += ["anchors_most", "model", "governed_by", "governed_part", "relied", "built_holds"]
MODELS = ["model", "height_m", "force_kn", "holds"]
PLACES = ("held_m", "foot_m", "hinge_m", "side", *EXTENT, "at_foot")  # what names a mechanism
AFTER = [
    "part",
    "mechanism",
    *PLACES,
    "pga_fails_g",
    "ratio",
    "why_not",
    "why_words",
    "beyond",
    "model",
]
AFTER += ["exceed_d0", "mean_d_m", "d_slv_m", "holds"]


def table_of(tied, result, relied=""):
    """Rows of `ties.Recommended` as a table, with rods and anchors as they are recommended (ROWS).

    `relied` is the model that they are for; it is empty without the dynamic check.
    """
    assessment, rows = tied.sections["assessment"], []
    every = zip(result.rows, result.by_hand_n, result.why, result.built, strict=True)
    for row, least_n, why, made in every:
        if not row.force_n:
            continue
        rod, anchor = tied.entry(made), tied.anchor(row.height_m)
        row_about = {
            "height_m": row.height_m,
            "force_by_hand_kn": 1e-3 * least_n,
            "force_kn": 1e-3 * row.force_n,
            "margin": assessment["tie_margin"],
            "force_built_kn": 1e-3 * made.force_n,
            "count": rod["count"],
            "diameter_mm": rod["diameter_mm"],
            "yield_mpa": rod["yield_mpa"],
            "length_m": rod["length_m"],
            "anchor_kn": 1e-3 * anchor.force_n,
            "anchor_load_kn": 1e-3 * made.force_n / rod["count"],
            "anchor_by": anchor.by,
            "anchors_most": tied.most(row.height_m),
            "model": why.model if why else "",
            "governed_by": why.mechanism if why else "",
            "governed_part": why.part if why else "",
            "relied": relied,
            "built_holds": int(result.holds),
        }
        rows.append(row_about)
    return rows


def of_models(result):
    """What every other model asks for by itself (MODELS); without a force where no row holds."""
    rows = []
    for model, forces in result.alone.items():
        if forces is None:
            rows.append((model, math.nan, math.nan, 0))
            continue
        for row, force_n in zip(result.rows, forces, strict=True):
            if force_n:
                rows.append((model, row.height_m, 1e-3 * force_n, 1))
        if not any(forces):
            rows.append((model, math.nan, 0.0, 1))
    return rows


def after(tied, result, shaken):
    """What each mechanism does with the rows as built, by hand and shaken (AFTER).

    A row a mechanism that is not shaken, and one a model of each that is. What only ties bring in
    and takes more than `assessment.shaken_within` of the demand by hand is named with the others.
    """
    rows, beyond = [], set(result.beyond)
    there = any(row.force_n for row in result.built)
    last = shaken.everything(result.built) if shaken is not None and there else {}
    known, fails_g = tied.mechanisms(result.built)
    least_g = tied.sections["assessment"]["shaken_within"] * tied.demand.pga_g
    tried = shaken.cases_with(result.built) if shaken is not None else []
    for name, candidate in known.items():
        pga_g, by_model = fails_g[name], last.get(name, {})
        why = ("", "") if by_model else why_not(candidate, pga_g, least_g, tried)
        about = (
            name,
            candidate.name,
            *(getattr(candidate, key) for key in PLACES),
            pga_g,
            pga_g / tied.demand.pga_g,
            *why,
            int(name in beyond),
        )
        outcomes = by_model or {"": dict.fromkeys(("exceed_d0", "mean_d_m", "d_slv_m"), math.nan)}
        for model, said in outcomes.items():
            shake = [said[key] for key in ("exceed_d0", "mean_d_m", "d_slv_m")]
            held = int(said["holds"]) if by_model else ""
            rows.append(dict(zip(AFTER, (*about, model, *shake, held), strict=True)))
    return sorted(rows, key=lambda row: row["pga_fails_g"])
