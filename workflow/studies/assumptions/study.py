"""What an assumption is worth: variants of a scene, and ratios between collapse intensities.

A ratio above 1 says that a model stands more shaking than the one it is held against: as a
substitute it is on the unsafe side.
"""

import numpy as np
import pandas as pd
from rocking.collapse import probability
from rocking.collapse.case import Variant
from rocking.collapse.equivalent import SLOPE, equivalent
from rocking.collapse.ratios import spread
from rocking.collapse.varied import collapses, intensities

from yade_scripts.model.registry import MODELS

MEASURES = ("collapse", "p10", "median", "p90", "equivalent", "all")
CAPACITY = [f"pga_{name}_g" for name in MEASURES]
SIDE = (*MEASURES, "mean")  # of models side by side, whose whole curve is known
OF_BUILDINGS = ("collapse", "median", "equivalent", "all")
OF_BASE = {  # measure, and the measure of the base that it is divided by
    **{name: name for name in ("equivalent", "collapse", "median")},
    **{name: "median" for name in ("p10", "p90")},
}
KEY = ["record", "direction"]
BASE = "as configured"
# of two-storey masonry, and a building that does not yield
STRENGTHS = {"V/W 0.10": 0.10, "V/W 0.20": 0.20, "V/W 0.30": 0.30, "elastic": None}
SPREAD = {"curves": "n_known", "low": 10, "median": 50, "high": 90}
SPREAD |= {"share_unsafe": lambda ratios: ratios.share(low=1.0)}


OF_BRICKS = (
    ("headers", "sliding", {"w3.header_joint": "sliding"}),
    ("headers", "bonded", {"w3.header_joint": "bonded"}),
    ("headers", "bonded, cut bricks", {"w3.header_joint": "study"}),
    ("inclined courses", "none", {"w3.lower_courses": 0}),
    ("inclined courses", "lowest 9", {"w3.lower_courses": 9}),
)


def variants(case, stage, surrogate=None):
    """Every assumption of a driven case, W2 or W3, at another level; β is to be chosen anew.

    `stage` are answers of the building stage: period_s, complete_period_s [s], mass_kg; None: they
    are not known, and levels that rest on them are left out. `surrogate` are keywords of
    `Motion.named`, None: the record has none. `about` says the assumption and its level.
    """
    wall, bricks = case["return_wall"], not case.kind.single_block
    length = wall["length_m"] or 0.5 * case["facade"]["height_m"]
    strength = case["smdof"]["base_shear_ratio"]

    def two_way(mass_kg):
        changes = {"model": case.kind.two_way_model, "return_wall.building_mass_kg": mass_kg}
        # bricks that carry the masses have an elastic building alone
        return changes | ({"smdof.base_shear_ratio": None} if bricks else {})

    def friction(degrees):
        sections = ("facade", "return_wall", *(["w3"] if bricks else []))
        return {f"{section}.friction_deg": degrees for section in sections}

    def back(factor):
        """Stiffness of the back joint: L of W2's E/L, the front joints' stiffness of W3."""
        joints = ("jkn_pa_m", "jks_pa_m") if bricks else ()
        scaled = {f"w3.{key}": factor * case["w3"][key] for key in joints}
        return {"return_wall.length_m": length / factor, **scaled}

    feel, walls = "return walls feel the façade", "motion of the walls"
    mass_kg = wall["building_mass_kg"] or (stage["mass_kg"] if stage else None)
    rows = [(feel, "building's mass", two_way(mass_kg))] if mass_kg else []
    rows += [
        (feel, "51 t", two_way(51e3)),
        (feel, "97 t", two_way(97e3)),
        (walls, "storey's middle", {"return_wall.motion": "middle"}),
        (walls, "by height", {"return_wall.motion": "interpolated"}),
    ]
    rows += OF_BRICKS if bricks else ()
    rows += [
        ("friction", "20°", friction(20.0)),
        ("friction", "40°", friction(40.0)),
        ("stiffness behind", "half", back(0.5)),
        ("stiffness behind", "double", back(2.0)),
        ("base of the façade", "the elastic wall's", {"facade.base": "column"}),
        ("law of β", "eq. 5", {"damping.law": "eq5"}),
        ("law of β", "fitted", {"damping.law": "fitted"}),
        *_periods(stage),
        *(
            ("building's strength", named, {"smdof.base_shear_ratio": ratio})
            for named, ratio in STRENGTHS.items()
            if ratio != strength
        ),
        ("building's damping", "2 %", {"smdof.damping_ratio": 0.02}),
        ("building's damping", "10 %", {"smdof.damping_ratio": 0.10}),
        ("width", "6 m", {"facade.width_m": 6.0}),
        ("width", "8 m", {"facade.width_m": 8.0}),
    ]
    changed = [Variant(f"{a}, {b}", changes=c, about=_about(a, b)) for a, b, c in rows]
    if surrogate is None:
        return changed
    made = {"surrogate": surrogate}
    return [*changed, Variant("surrogate", motion=made, about=_about("record", "surrogate"))]


def _periods(stage):
    """First periods that the building stage gives, as rows of `variants`."""
    if stage is None:
        return []
    names = {"building stage": "period_s", "complete building": "complete_period_s"}
    return [("T1", level, {"smdof.period_s": stage[key]}) for level, key in names.items()]


def _about(assumption, level):
    return {"assumption": assumption, "level": level}


AS_CONFIGURED = Variant("base", about=_about(BASE, ""))


def collapse(case, motion, directions, stage, law, surrogate=None, slope=SLOPE):
    """Collapse of a driven case as configured, and with every `variants`: rows of intensities."""

    def find(changed, shaken, direction):
        return intensities(changed.calibrated(law), shaken, direction, slope=slope, power=0.0)

    every = [AS_CONFIGURED, *variants(case, stage, surrogate)]
    return collapses([case], motion, directions, find, every)


def buildings(case, settings):
    """W2 one-way and two-way before many buildings: periods, dampings, mass ratios.

    All periods at the configured damping, further dampings at its T1; `about` has mass_ratio (0:
    driven), period_s, damping_ratio.
    """
    facade, chain = case["facade"], case["smdof"]
    own_mass = facade["density_kg_m3"] * facade["height_m"] * facade["thickness_m"]
    own_mass *= facade["width_m"]
    pairs = [(period, chain["damping_ratio"]) for period in settings["periods_s"]]
    pairs += [(chain["period_s"], damping) for damping in settings["damping_ratios"]]
    return [
        Variant(
            "building",
            changes={
                "model": case.kind.two_way_model if ratio else case.model,
                "smdof.period_s": period,
                "smdof.damping_ratio": damping,
                "return_wall.building_mass_kg": own_mass / (ratio or 1.0),
            },
            about={"mass_ratio": ratio, "period_s": period, "damping_ratio": damping},
        )
        for period, damping in dict.fromkeys(pairs)
        for ratio in (0.0, *settings["mass_ratios"])
    ]


def mean_intensity(pga_g, share):
    """Mean collapse intensity, ∫(1 − P) dPGA [g]; NaN where the curve ends before all collapse.

    Where outcomes reverse, first crossings say where trouble begins; this says how much of the
    range of amplitudes a façade stands in all.
    """
    pga_g, share = np.asarray(pga_g, float), np.asarray(share, float)
    if not share.size or share[-1] < 1.0:
        return np.nan
    return float(pga_g[0] + np.trapezoid(1.0 - share, pga_g))


def measured(runs, spread, planar, slope=SLOPE):
    """Collapse intensities of one curve that was run, with pga_mean_g.

    `runs` are those of the planar solver's scan, or of YADE alone.
    """
    row = probability.summary(runs if planar else None, runs, (), spread, slope)
    dense = probability.from_scan(runs, spread)
    return row | {"pga_mean_g": mean_intensity(dense["pga_g"], dense["probability"])}


def from_probabilities(table, slope=SLOPE):
    """Collapse intensities of one curve of which only probabilities are known, and its runs.

    Columns of tables/collapse_probability.csv; YADE's share where the planar one is blank, its
    columns may be missing.
    """
    table = table.reindex(columns=probability.PROBABILITY_COLUMNS).sort_values("pga_g")
    share = table["probability"].fillna(table["probability_yade"])
    pga_g, share = table["pga_g"].to_numpy()[share.notna()], share.dropna().to_numpy()
    fell, stood = pga_g[share > 0.0], pga_g[share < 1.0]
    above = pga_g[pga_g > (stood.max() if stood.size else 0.0)]
    crossings = [probability.first_crossing(pga_g, share, level) for level in probability.LEVELS]
    runs = table["realisations"].fillna(table["realisations_yade"]).fillna(1.0).sum()
    return {
        "pga_collapse_g": fell.min() if fell.size else np.nan,
        **dict(zip(("pga_p10_g", "pga_median_g", "pga_p90_g"), crossings, strict=True)),
        "pga_all_g": above.min() if fell.size and above.size else np.nan,
        "pga_equivalent_g": equivalent(pga_g, share, slope),
        "pga_mean_g": mean_intensity(pga_g, share),
        "runs": int(runs),
    }


def compared(capacity, reference):
    """Add what each model stands over what the reference stands, by the measures of `SIDE` known.

    ratio_collapse … ratio_mean are blank where the reference is missing; side is "safe" or "unsafe"
    of the median, within its own scatter "even".
    """
    table = capacity.reset_index(drop=True).copy()
    names = [name for name in SIDE if f"pga_{name}_g" in capacity]
    columns = [f"pga_{name}_g" for name in names]
    other = table[KEY].join(table[table["model"] == reference].set_index(KEY)[columns], on=KEY)
    table["reference"] = reference
    for name in names:
        table[f"ratio_{name}"] = table[f"pga_{name}_g"] / other[f"pga_{name}_g"]
    side = np.where(table["pga_median_g"] > other["pga_p90_g"], "unsafe", "even")
    side = np.where(table["pga_median_g"] < other["pga_p10_g"], "safe", side)
    table["side"] = np.where(table["ratio_median"].notna(), side, "")
    table.loc[table["model"] == reference, "side"] = ""
    return table


def pairs(capacity, reference):
    """Every one-way coupled model over its two-way counterpart, then each over the reference.

    See `compared`; a pair that is both stands once.
    """
    there, ratios = list(capacity["model"].unique()), []
    for kind in (MODELS[name] for name in there if name in MODELS):
        if kind.two_way and kind.one_way_model in there:
            ratio = compared(capacity, kind.name)
            ratios.append(ratio[ratio["model"] == kind.one_way_model])
    ratio = compared(capacity, reference)
    ratios.append(ratio[ratio["model"] != reference])
    return pd.concat(ratios).drop_duplicates(["model", "reference", *KEY])


def losses(capacity):
    """How much of the capacity the building takes, and how much of that its assumption.

    The loss is 1 − W2/W1 as the study has it, driven, and 1 − W2m/W1 with walls that feel the
    façade; the second is what the building's motion takes, the rest is the assumption. Of curves
    and measures of which all three are known.
    """
    rows = []
    for measure in ("collapse", "equivalent", "median", "mean", "all"):
        if f"pga_{measure}_g" not in capacity:
            continue
        wide = capacity.pivot(index=KEY, columns="model", values=f"pga_{measure}_g")
        if not {"W1", "W2", "W2m"} <= set(wide):
            break
        wide = wide[["W1", "W2", "W2m"]].dropna().reset_index()
        wide.columns = [*KEY, "pga_w1_g", "pga_w2_g", "pga_w2m_g"]
        wide.insert(2, "measure", measure)
        wide["loss_one_way"] = 1.0 - wide["pga_w2_g"] / wide["pga_w1_g"]
        wide["loss_two_way"] = 1.0 - wide["pga_w2m_g"] / wide["pga_w1_g"]
        wide["assumption"] = wide["loss_one_way"] - wide["loss_two_way"]
        rows.append(wide)
    columns = [*KEY, "measure", "pga_w1_g", "pga_w2_g", "pga_w2m_g"]
    columns += ["loss_one_way", "loss_two_way", "assumption"]
    return pd.concat(rows) if rows else pd.DataFrame(columns=columns)


def spread_of(table, columns, by):
    """How ratios spread by group and measure, those of which any is known; see SPREAD."""
    wide = table.set_index(by)[columns].rename(columns=lambda name: name.removeprefix("ratio_"))
    long = wide.stack(future_stack=True).rename_axis([*by, "measure"]).reset_index(name="ratio")
    spreads = spread(long, [*by, "measure"], SPREAD)
    return spreads[spreads["curves"] > 0]


def error_by_building(table):
    """Error of one-way coupling before many buildings: ratios to two-way coupling, all records."""
    key = [*KEY, "period_s", "damping_ratio"]
    ratios = {f"pga_{name}_g": f"ratio_{name}" for name in OF_BUILDINGS}
    one_way = table[table["mass_ratio"] == 0.0].set_index(key)[[*ratios]]
    two_way = table[table["mass_ratio"] > 0.0].join(one_way, on=key, rsuffix="_one_way")
    for column, name in ratios.items():
        two_way[name] = two_way[f"{column}_one_way"] / two_way[column]
    by = ["damping_ratio", "period_s", "mass_ratio"]
    return spread_of(two_way.sort_values(by), [*ratios.values()], by)


def tornado(table):
    """What each assumption of a model is worth: collapse with it over collapse as configured."""
    table = table.rename(columns={"runs_planar": "runs"})
    base = table[table["assumption"] == BASE].set_index(KEY)
    base = table[KEY].join(base[CAPACITY], on=KEY)
    for name, other in OF_BASE.items():
        table[f"ratio_{name}"] = table[f"pga_{name}_g"] / base[f"pga_{other}_g"]
    ratios = [f"ratio_{name}" for name in OF_BASE]
    return table[["model", *KEY, "assumption", "level", *CAPACITY, *ratios, "runs"]]
