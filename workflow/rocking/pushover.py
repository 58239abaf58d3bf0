"""Static capacity curves: YADE's beside the closed forms, and what the joints carry in W3."""

import copy
import math

import numpy as np
import pandas as pd

from rocking.mechanics import closed_forms
from rocking.mechanics.smoothing import smoothed
from yade_scripts.model import base, interlocking, registry
from yade_scripts.model.facades import Facade

RULES = ("rigid", "bonded", "sliding", "hinged")
DRAWN = (*RULES, "study")
# one change of the default W3 each; "header_*" without inclined joints, so only the rule differs
# ("header_study" has its own, in the return wall)
VARIANTS: dict[str, dict] = {
    "default": {},
    **{f"header_{rule}": {"w3.header_joint": rule, "w3.lower_courses": 0} for rule in RULES},
    "header_study": {"w3.header_joint": "study"},
    "study_7_lower_courses": {"w3.header_joint": "study", "w3.lower_courses": 7},
    "study_all_courses": {"w3.header_joint": "study", "w3.lower_courses": 1000},
    "study_all_vertical": {
        "w3.header_joint": "study",
        "w3.lower_courses": 1000,
        "w3.split_inclination_deg": 0.0,
    },
    "lower_courses_0": {"w3.lower_courses": 0},
    "lower_courses_6": {"w3.lower_courses": 6},
    "overlap_0.0625_m": {"w3.overlap_m": 0.0625},
    "overlap_0.1875_m": {"w3.overlap_m": 0.1875},
    "friction_20_deg": {"w3.friction_deg": 20.0},
    "friction_40_deg": {"w3.friction_deg": 40.0},
    "joints_twice_as_stiff": {"w3.jkn_pa_m": 2.2e9, "w3.jks_pa_m": 8.8e8},
    "course_0.216_m": {"w3.course_height_m": 0.216},
    "course_0.648_m": {"w3.course_height_m": 0.648},
    "half_step": {"w3.step_fraction": 0.5, "scale": "w3.step_fraction"},
    "nodes_9": {"pushover.nodes_thickness": 9},
    "nodes_33": {"pushover.nodes_thickness": 33},
    "half_speed": {"pushover.speed_m_s": 0.5, "scale": "pushover.speed_m_s"},
    "full_model": {"w3.half_model": False},
}


def variant(config, name):
    """Configuration of one variant; `scale` names a key that is multiplied, not replaced."""
    out = copy.deepcopy(config)
    changes = dict(VARIANTS[name])
    scaled = changes.pop("scale", None)
    for path, value in changes.items():
        section, key = path.split(".")
        out[section][key] = out[section][key] * value if path == scaled else value
    return out


def laid(config):
    """Names of the variants whose bricks can be laid in a façade; those of `config` must be.

    ValueError: see `interlocking.check`.
    """
    interlocking.check(config)
    names = []
    for name in VARIANTS:
        try:
            interlocking.check(variant(config, name))
        except ValueError:  # courses of another height that do not fill this façade
            continue
        names.append(name)
    return names


def theta_of(d_over_b, facade):
    """Rotation [rad] whose top displacement h sin θ is d."""
    facade = Facade.of(facade)
    ratio = np.asarray(d_over_b) * facade.thickness_m / facade.height_m
    return np.arcsin(np.clip(ratio, -1.0, 1.0))


def closed_form(d_over_b, config, model):
    """Kinematic curves of a model, upper and lower, and their shift on the compliant base.

    The compliant base shifts every curve by what it takes from the block alone,
    `capacity_compliant_base` − tan(α − θ): the reaction stands inside the toe by a third of the
    width in contact, whatever else holds the façade. Lower is NaN without interlocking.
    """
    facade, wall = Facade.of(config["facade"]), config["return_wall"]
    facade.refuse("the kinematic curve")
    h, b = facade.height_m, facade.thickness_m
    theta = theta_of(d_over_b, facade)
    rigid = closed_forms.capacity_rigid(theta, h, b)
    jkn, edge_pa = base.parts(facade)
    compliant = closed_forms.capacity_compliant_base(
        np.maximum(theta, 1e-12), h, b, facade.density_kg_m3, jkn, edge_pa=edge_pa
    )
    if registry.model(model).walls != "bricks":
        return rigid, np.full_like(rigid, np.nan), compliant - rigid
    w3 = config["w3"]
    friction = math.tan(math.radians(w3["friction_deg"]))
    sizes = w3["course_height_m"], w3["overlap_m"], wall["thickness_m"]
    bricks = closed_forms.Interlocked(*sizes, friction, wall["count"])
    given = theta, h, b, facade.width_m, facade.density_kg_m3, bricks
    upper, lower = (closed_forms.capacity_interlocking(*given, k) for k in ("upper", "lower"))
    return upper, lower, compliant - rigid


def complete_curve(raw, config, model):
    """Contract of pushover/{model}.csv: YADE's curve with the closed forms beside it."""
    upper, lower, shift = closed_form(raw["d_over_b"], config, model)
    return pd.DataFrame(
        {
            "d_over_b": raw["d_over_b"],
            "lambda_dem": raw["lambda_dem"],
            "lambda_kinematic": upper,
            "lambda_kinematic_lower": lower,
            "lambda_elastic": upper + shift,
            "lambda_elastic_lower": lower + shift,
            "lambda_dem_corrected": raw["lambda_dem"] - shift,
        }
    )


def summary(curve, reach=0.5, bonded=False):
    """Peak, back-extrapolated λ0 and place between the bounds, up to d/b = `reach`.

    λ0 is the largest smoothed λ corrected for the base's compliance: with a rigid base the
    kinematic curve starts at its largest value. A bonded contact (W1c) has a peak of its own and no
    λ0. From d_over_b_inside on the corrected curve lies between the bounds (with 1 % of λ0 for the
    saw tooth); NaN for models without bounds.
    """
    part = curve[(curve["d_over_b"] <= reach) & (curve["d_over_b"] >= 0.0)]
    d = part["d_over_b"].to_numpy()
    upper = part["lambda_kinematic"].to_numpy()
    lower = part["lambda_kinematic_lower"].to_numpy()
    raw = smoothed(part, "lambda_dem") if np.isfinite(lower).all() else part["lambda_dem"]
    corrected = smoothed(part, "lambda_dem_corrected")
    peak = int(np.argmax(raw))
    settled = d > 0.005  # before that the correction is the whole of the block's λ
    lambda0 = math.nan if bonded else float(corrected[settled].max())
    out = {
        "lambda_peak": float(np.asarray(raw)[peak]),
        "d_over_b_peak": float(d[peak]),
        "lambda0_dem": lambda0,
        "lambda0_kinematic": float(upper[0]),
        "ratio": lambda0 / float(upper[0]),
        "d_over_b_inside": math.nan,
    }
    if np.isfinite(lower).all():
        slack = 0.01 * float(upper[0])
        outside = np.flatnonzero((corrected < lower - slack) | (corrected > upper + slack))
        out["d_over_b_inside"] = float(d[outside[-1]]) if len(outside) else 0.0
    return out


def joint_forces(forces, config):
    """Normal force of every bed joint along the push, beside the weight above the overlap.

    course is that below the joint, normal_n of one wall, weight_n γ·t_s·v·h_b·i with i courses
    above: what the kinematic curve assumes.
    """
    beds = forces[forces["joint"].str.contains(r" bed \d+ ")].copy()
    beds["wall"] = beds["joint"].str.replace(r" bed .*", "", regex=True)
    beds = beds[beds["wall"] == beds["wall"].iloc[0]]
    beds["course"] = beds["joint"].str.extract(r" bed (\d+) ")[0].astype(int)
    table = beds.groupby(["d_over_b", "course"], as_index=False).agg(
        z_m=("z_m", "first"), normal_n=("normal_n", "sum")
    )
    facade, w3 = config["facade"], config["w3"]
    courses = round(facade["height_m"] / w3["course_height_m"])
    unit = facade["density_kg_m3"] * closed_forms.GRAVITY_M_S2
    each = unit * config["return_wall"]["thickness_m"] * w3["overlap_m"] * w3["course_height_m"]
    table["weight_n"] = each * (courses - table["course"])
    table["ratio"] = table["normal_n"] / table["weight_n"]
    return table


def friction_moment_ratio(table):
    """ΣN·z over ΣW·z of the joints at each d/b: 1 where the kinematic assumption holds."""
    moments = table.assign(n=table["normal_n"] * table["z_m"], w=table["weight_n"] * table["z_m"])
    sums = moments.groupby("d_over_b")[["n", "w"]].sum()
    return sums["n"] / sums["w"]
