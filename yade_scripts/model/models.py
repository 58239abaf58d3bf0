"""Which assembly builds the scene of a model, so that entry points need not know."""

import math

from yade_scripts.model import facade, interlocking, registry
from yade_scripts.model.facades import Facade
from yade_scripts.model.gravity import GRAVITY_M_S2
from yade_scripts.model.scene import from_dict, observed_at
from yade_scripts.model.shape import shape_of


def build_scene(case):
    """Build the scene of a case: of a case file, or of one that holds its `scene`, as CB's.

    With `width_nodes` it is the full scene under two components, with `observed_m` d is that
    height's. ValueError for an unknown model, or a height that the façade has not.
    """
    scene = _assembled(case)
    height = case.get("observed_m")
    return scene if height is None else observed_at(scene, height)


def _assembled(case):
    if "scene" in case:
        return from_dict(case["scene"])
    kind = registry.model(case["model"])
    if kind.walls == "bricks":
        return interlocking.interlocking_scene(case, case["beta_s"], two_way=kind.two_way)
    count = case.get("width_nodes")
    full = {"planar": False, "width_nodes": count, "two_components": True} if count else {}
    return facade.facade_scene(case, case["model"], case["beta_s"], **full)


def numerics(case):
    """Section numerics with the step that belongs to the model."""
    section = dict(case["numerics"])
    if "scene" not in case and registry.model(case["model"]).walls == "bricks":
        section["step_fraction"] = case["w3"]["step_fraction"]
    return section


def with_nodes(case, nodes):
    """Copy of a case with n nodes a return wall, 2n − 1 at the base; None: its own."""
    if nodes is None:
        return case
    counts = {"nodes_thickness": 2 * nodes - 1, "nodes_height": nodes, "nodes_per_block": nodes}
    return {**case, "numerics": {**case["numerics"], **counts}}


def static_multiplier(case):
    """Static λ at which the façade starts to turn [-]: b/h, and more for W1c and W3.

    A façade with a shape of its own: b_g/z_g (see `shape`) for b/h.
    W1c: b/h + N_w f_t t_s h²/3/(W h/2), at which the top of the bond reaches its tensile
    strength f_t if tension grows linearly from the toe. (Of W2c no such number is known:
    floors that move apart tear its bonds.)
    W3: λ0 of the kinematic curve, b/h + N_w Σ F_i y_i/(W h/2) with
    F_i = μ γ t_s v h_b i at y_i = h − i·h_b above the hinge.
    """
    the_facade, wall = Facade.of(case["facade"]), case["return_wall"]
    h, b = the_facade.height_m, the_facade.thickness_m
    kind = registry.model(case["model"])
    if kind.walls == "one" and kind.bonded:
        weight = the_facade.density_kg_m3 * GRAVITY_M_S2 * h * b * the_facade.width_m
        bond = wall["count"] * wall["tension_mpa"] * 1e6 * wall["thickness_m"] * h**2 / 3.0
        if not the_facade.is_plain:
            shape = shape_of(the_facade)
            return (shape.lever_m[0] + bond / (shape.mass_kg * GRAVITY_M_S2)) / shape.lever_m[1]
        return b / h + bond / (0.5 * weight * h)
    if kind.walls != "bricks":
        return b / h if the_facade.is_plain else shape_of(the_facade).static_multiplier
    w3 = case["w3"]
    course = w3["course_height_m"]
    arms = sum(i * (h - i * course) for i in range(1, round(h / course)))
    friction = math.tan(math.radians(w3["friction_deg"])) * wall["thickness_m"]
    moment = wall["count"] * friction * w3["overlap_m"] * course * arms
    return b / h + moment / (h * b * the_facade.width_m * 0.5 * h)
