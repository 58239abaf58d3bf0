"""Which assembly builds the scene of a model, so that entry points need not know."""

import math
from dataclasses import replace

import numpy as np

from yade_scripts.model import facade, interlocking, registry
from yade_scripts.model.floor_motions import VERTICAL
from yade_scripts.model.gravity import GRAVITY_M_S2
from yade_scripts.model.motion import along
from yade_scripts.model.scene import from_dict, observed_at
from yade_scripts.model.shape import is_plain, shape_of


def build_scene(case):
    """Build the scene of a case.

    Parameters
    ----------
    case : dict
        A case file: model, beta_s and the configuration's sections; with `width_nodes` the
        full scene under two components, with `observed_m` that height for d. Or one that holds
        its `scene`, as the complete building's.

    Returns
    -------
    Scene

    Raises
    ------
    ValueError
        For an unknown model, or a height that the façade has not.
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
    if count := case.get("width_nodes"):
        return facade.facade_scene(
            case,
            case["model"],
            case["beta_s"],
            planar=False,
            width_nodes=count,
            two_components=True,
        )
    return facade.facade_scene(case, case["model"], case["beta_s"])


def numerics(case):
    """Section numerics with the step that belongs to the model."""
    section = dict(case["numerics"])
    if "scene" not in case and registry.model(case["model"]).walls == "bricks":
        section["step_fraction"] = case["w3"]["step_fraction"]
    return section


def static_multiplier(case):
    """Static λ at which the façade starts to turn [-]: b/h, and more for W1c and W3.

    A façade with a shape of its own: b_g/z_g (see `shape`) for b/h.
    W1c: b/h + N_w f_t t_s h²/3/(W h/2), at which the top of the bond reaches its tensile
    strength f_t if tension grows linearly from the toe. (Of W2c no such number is known:
    floors that move apart tear its bonds.)
    W3: λ0 of the kinematic curve, b/h + N_w Σ F_i y_i/(W h/2) with
    F_i = μ γ t_s v h_b i at y_i = h − i·h_b above the hinge.
    """
    section, wall = case["facade"], case["return_wall"]
    h, b = section["height_m"], section["thickness_m"]
    kind = registry.model(case["model"])
    if kind.walls == "one" and kind.bonded:
        weight = section["density_kg_m3"] * GRAVITY_M_S2 * h * b * section["width_m"]
        bond = wall["count"] * wall["tension_mpa"] * 1e6 * wall["thickness_m"] * h**2 / 3.0
        if not is_plain(section):
            own = shape_of(section)
            return (own.lever_m[0] + bond / (own.mass_kg * GRAVITY_M_S2)) / own.lever_m[1]
        return b / h + bond / (0.5 * weight * h)
    if kind.walls != "bricks":
        return b / h if is_plain(section) else shape_of(section).static_multiplier
    w3 = case["w3"]
    course = w3["course_height_m"]
    arms = sum(i * (h - i * course) for i in range(1, round(h / course)))
    friction = math.tan(math.radians(w3["friction_deg"])) * wall["thickness_m"]
    moment = wall["count"] * friction * w3["overlap_m"] * course * arms
    return b / h + moment / (h * b * section["width_m"] * 0.5 * h)


def shaken(scene, columns):
    """A scene and the motions it needs: shaken vertically too where the motions say how.

    Returns
    -------
    scene : Scene
    columns : dict of str to ndarray
        See `motion_columns`.
    """
    vertical = VERTICAL if VERTICAL in columns else None
    return replace(scene, vertical=vertical), motion_columns(scene, columns)


def with_second(time_s, columns, second_time_s, second):
    """Floor motions of two components on one time axis: those along the façade as `along(name)`.

    Parameters
    ----------
    time_s, columns
        Of the component out of plane, see `floor_motions.read`.
    second_time_s, second
        Of the component along the façade.

    Returns
    -------
    time_s : ndarray
        Of the first, to the end of the longer.
    columns : dict of str to ndarray
        Linear between samples, zero after either's end.
    """
    step = time_s[1] - time_s[0]
    last = max(time_s[-1], second_time_s[-1])
    longer = time_s[0] + step * np.arange(math.ceil((last - time_s[0]) / step - 1e-6) + 1)

    def on(times, values):
        return np.interp(longer, times, values, right=0.0)

    return longer, {
        **{name: on(time_s, values) for name, values in columns.items()},
        **{along(name): on(second_time_s, values) for name, values in second.items()},
    }


def scaled(columns, factor):
    """Floor motions times a factor; its sign turns the horizontal ones, not the vertical one."""
    size = {VERTICAL: abs(factor)}
    return {name: size.get(name, factor) * values for name, values in columns.items()}


def after(before, time_s, columns):
    """Floor motions of two shocks one after the other, on one time axis.

    Parameters
    ----------
    before : (time_s, columns, pause_s)
        The first shock, as it shakes, and the rest from its last sample to the second's first.
    time_s, columns
        The second, as it shakes.

    Returns
    -------
    time_s : ndarray
        The samples of both, and one where each rests: motions are linear between samples.
    columns : dict of str to ndarray
        Those of either; what one has not is zero there.

    Raises
    ------
    ValueError
        If the pause is shorter than a step of the first.
    """
    first_s, first, pause_s = before
    step, still = first_s[1] - first_s[0], time_s[1] - time_s[0]
    if not pause_s > step + still:
        raise ValueError(f"pause of {pause_s:g} s: expected more than {step + still:g} s")
    begin = first_s[-1] + pause_s
    times = np.concatenate((first_s, [first_s[-1] + step, begin - still], begin + time_s))
    names = dict.fromkeys((*first, *columns))
    none = [np.zeros(len(first_s)), np.zeros(len(time_s))]
    return times, {
        name: np.concatenate((first.get(name, none[0]), [0.0, 0.0], columns.get(name, none[1])))
        for name in names
    }


def motion_columns(scene, columns):
    """Add the motions between floors that a scene needs.

    Parameters
    ----------
    scene : Scene
        Its note "motions" holds, by name, the weights of the columns.
    columns : dict of str to ndarray
        "ground", "floor1", … [m/s²]; what is there already stays.

    Returns
    -------
    dict of str to ndarray

    Raises
    ------
    ValueError
        If a floor is missing.
    """
    found = dict(columns)
    for name, weights in scene.notes.get("motions", {}).items():
        if name in columns:
            continue
        missing = [column for column in weights if column not in columns]
        if missing:
            raise ValueError(f"the motion file has no column for {', '.join(missing)}")
        found[name] = sum(weight * columns[column] for column, weight in weights.items())
    return found
