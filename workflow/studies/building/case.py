"""The building of a configuration: its plan, its floor load, its models CBDEM and SBDEM."""

from functools import cache

from rocking.configuration.files import read_yaml
from rocking.configuration.schema import ConfigError
from scipy.optimize import brentq

from studies.building.model.assembly import build
from studies.building.model.bricks import Brick
from studies.building.model.contacts import Joints
from yade_scripts.files import read_json
from yade_scripts.model.building.plan import PlanError, plan_from_dict

from .modes import Solver

MODELS = ("CBDEM", "SBDEM")
PAPER_PERIODS_S = {
    ("CBDEM", "y"): 0.25,
    ("SBDEM", "y"): 0.27,
    ("CBDEM", "rz"): 0.16,
    ("SBDEM", "rz"): 0.17,
}
LARGEST_LOAD_KG_M2 = 20000.0


def read_plan(path):
    """Read and check a plan file; PlanError in one line with file and part."""
    try:
        data = read_yaml(path)
    except ConfigError as error:
        raise PlanError(error.detail) from None
    return plan_from_dict(data, str(path))


def real_brick(settings):
    """Return the real brick of section building."""
    return Brick(*(settings[f"brick_{part}_m"] for part in ("length", "height", "width")))


def real_joints(settings):
    """Return the joint stiffnesses of section building, which hold for the real brick."""
    return Joints(**{k: v for k, v in settings.items() if k.endswith(("_jkn_pa_m", "_jks_pa_m"))})


def build_model(settings, plan, model, load_kg_m2=None, coarsening=None):
    """Build CBDEM, or SBDEM without the façades, with the section `building` of the configuration.

    None keeps the plan's own load, and takes the configured coarsening.
    """
    if model not in MODELS:
        raise ValueError(f"model {model!r}: expected one of {', '.join(MODELS)}")
    if model == "SBDEM":
        plan = plan.without_facades()
    if load_kg_m2 is not None:
        plan = plan.with_floor_load(load_kg_m2)
    return build(
        plan,
        brick=real_brick(settings),
        coarsening=settings["coarsening"] if coarsening is None else coarsening,
        joints=real_joints(settings),
        density_kg_m3=settings["density_kg_m3"],
        timber_density_kg_m3=settings["timber_density_kg_m3"],
    )


def fitted_model(settings, plan, fit, model, coarsening=None):
    """Build a model from the file of its plan and that of its fitted floor load, `building_fit`."""
    load = read_json(fit)["floor_load_kg_m2"]
    return build_model(settings, read_plan(plan), model, load, coarsening)


def mass_behind_facade(settings, plan, load_kg_m2):
    """Mass of the complete building less one of its façades [kg]; foundations do not count."""
    scenes = (build_model(settings, plan, model, load_kg_m2).scene for model in MODELS)
    complete, bare = (sum(b.mass_kg for b in scene.blocks if b.free) for scene in scenes)
    facades = sum(wall.facade for wall in plan.walls)
    return complete - (complete - bare) / max(facades, 1)


def translation_mode(modes):
    """Return the index of the translational mode: the largest effective mass along y."""
    return modes.largest("y")


def twist_mode(modes):
    """Return the index of the rotation about z, the translational mode along y left out."""
    ratio = modes.effective_ratio[:, 5].copy()
    ratio[translation_mode(modes)] = -1.0
    return int(ratio.argmax())


def load_of_period(period_s, target_s, largest_kg_m2, within_kg_m2):
    """Floor load under which a building has a period [kg/m²]; 0 or the largest if none between.

    `period_s` gives the period [s] of a load, which lengthens with it; the load is found to
    `within_kg_m2`.
    """
    if period_s(0.0) >= target_s:
        return 0.0
    if period_s(largest_kg_m2) < target_s:
        return largest_kg_m2
    return brentq(lambda q: period_s(q) - target_s, 0.0, largest_kg_m2, xtol=within_kg_m2)


def fit_floor_load(settings, plan):
    """Floor load fitted to the period of the complete building along y [kg/m²], and the period.

    One load on every floor is the only free parameter. K does not depend on it, so one
    factorisation serves the whole search. Where even the unloaded floors give too long a period the
    load is zero and the period says so; None where `fit_period_s` is null: the plan's own loads
    hold. A PlanError if the plan has no floor to load, or no reasonable load reaches the period.
    """
    target = settings["fit_period_s"]
    if target is None:
        modes = Solver(build_model(settings, plan, "CBDEM").scene).modes(12)
        return None, float(modes.period_s[translation_mode(modes)])
    if not plan.floors:
        raise PlanError(f"plan '{plan.name}' has no floor whose load fit_period_s could fit")
    building = build_model(settings, plan, "CBDEM", 0.0)
    solver = Solver(building.scene)
    areas = panel_areas(building)

    @cache
    def period(load):
        modes = solver.modes(12, solver.mass_with({i: load * a for i, a in areas.items()}))
        return float(modes.period_s[translation_mode(modes)])

    load = load_of_period(period, target, LARGEST_LOAD_KG_M2, 1e-3)
    if load == LARGEST_LOAD_KG_M2 and period(load) < target:
        raise PlanError(
            f"fit_period_s = {target:g} s: plan '{plan.name}' stays stiffer with"
            f" {LARGEST_LOAD_KG_M2:g} kg/m² on every floor"
        )
    return load, period(load)


def panel_areas(building):
    """Return {block: area in plan [m²]} of the floors' panels, which carry the load."""
    blocks = building.scene.blocks
    panels = [first + count for first, count, _ in building.floors]
    return {i: blocks[i].size_m[0] * blocks[i].size_m[1] for i in panels}
