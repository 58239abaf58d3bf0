"""Whether a façade stands on its own compliant base before anything shakes it.

A plain façade on a base of stiffness jkn stands as long as the base turns it back by more than its
weight turns it over, jkn b³w/12 > W h/2: with jkn = E/h up to the height h³ = E b²/(6 ρ g). In
general it stands if some outward rotation φ about the front toe lets weight, loads and what holds
restore more than the base pushes over,

    W (b_g cos(φ + τ) − z_g sin(φ + τ)) + Σ min(k z sin φ, F) z cos φ > cos φ Σ F_i a_i,

τ its tilt, a_i the places of the base's forces inward from the toe. Pieces between hinges stand if
their stiffness less that of the weights on them is positive definite, and loads off the middle
leave them a place of rest (`statics`).
"""

import math
from collections.abc import Mapping

import numpy as np

from rocking.configuration.schema import ConfigError, show
from yade_scripts.model import registry
from yade_scripts.model.base import parts
from yade_scripts.model.facade import facade_scene, joint_stiffness
from yade_scripts.model.facades import NAMES, ROWS, Facade
from yade_scripts.model.gravity import GRAVITY_M_S2
from yade_scripts.model.hinges import hinge_stiffness
from yade_scripts.model.holds import holds
from yade_scripts.model.rest import DoesNotStandError
from yade_scripts.model.shape import shape_of
from yade_scripts.model.thrusts import leaning

ANGLES = np.geomspace(1e-6, 1.0, 200)  # over the rotation at which the weight passes the toe
UNITS = {"height_m": "m", "tilt_deg": "°"}
HEIGHTS = ("height_m", "gable_height_m", "parapet_height_m")  # what grows with the façade
LISTS = {
    key: tuple(sorted({"z_m", "height_m"} & NAMES[kind])) for key, kind in ROWS.items()
}  # and what of its rows
WEAKEST = "weakest"  # of facade.hinges_m
LEAST = 0.1  # of its height, or of its tilt, at which a façade may stand that does not
PLAIN = "W1"  # the model that asks least of a building
NODES = {"nodes_thickness": 9, "nodes_height": 5, "nodes_per_block": 5}


def check_static_stability(resolved: Mapping) -> None:
    """Refuse a façade that cannot stand on its base, in the models that nothing bonds to walls.

    The ConfigError has the height that would stand, all heights of the façade in proportion, or the
    tilt.
    """
    models = map(registry.model, resolved["models"])
    if not any(kind.single_block and not kind.bonded for kind in models):
        return
    if resolved["facade"]["hinges_m"] == WEAKEST:
        from rocking.mechanics.blocks import weakest_hinge  # loads SciPy, seldom needed

        resolved = _with(resolved, {"hinges_m": [weakest_hinge(resolved["facade"])]})
    if stands(resolved):
        return
    facade, jkn = resolved["facade"], joint_stiffness(resolved)[0]
    if facade["tilt_deg"] and stands(_with(resolved, {"tilt_deg": 0.0})):
        key, at = "tilt_deg", lambda f: _with(resolved, {"tilt_deg": f * facade["tilt_deg"]})
    else:
        key, at = "height_m", lambda f: _with(resolved, _heights(facade, f))
    if not stands(at(LEAST)):
        if key == "tilt_deg":
            raise ConfigError(
                f"facade.tilt_deg = {show(facade['tilt_deg'])}: expected 0 (°), since the façade "
                "falls by itself at a tenth of that too"
            )
        keys = [f"facade.{key}" for key in ("thrusts", "floors") if facade[key]] or ["facade"]
        raise ConfigError(
            f"{' and '.join(keys)}: the façade falls by itself, at a tenth of its height too; "
            "expected less thrust, or loads nearer the middle of its thickness"
        )
    low, high = LEAST, 1.0
    for _ in range(30):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if stands(at(middle)) else (low, middle)
    limit, unit = math.floor(1e2 * low * facade[key]) / 1e2, UNITS[key]
    raise ConfigError(
        f"facade.{key} = {show(facade[key])}: expected at most {limit:.4g} ({unit}), or the façade "
        f"of {show(facade['thickness_m'])} m falls by itself on its base of {jkn:.3g} Pa/m"
    )


def stands(config: Mapping) -> bool:
    """Whether the façade of a configuration has a position of rest that it returns to."""
    if config["facade"]["hinges_m"] or config["facade"]["courses"]:
        return _pieces_stand(config) and _pieces_rest(config)
    return restoring(config) > 0.0


def restoring(config: Mapping) -> float:
    """Largest moment about the front toe by which a façade of one block rights itself, over W z_g.

    Without ties and floors the static multiplier at which it tips over on its compliant base; not
    positive where it cannot stand. Where the base pushes is said in
    `closed_forms.capacity_compliant_base`.
    """
    facade = Facade.of(config["facade"])
    shape = shape_of(facade)
    b, width = facade.thickness_m, facade.width_m - shape.base_lost_m
    weight, (arm, height) = leaning(facade.floors, facade.thrusts, shape)
    if arm <= 0.0:  # thrusts alone turn it over
        return arm / height
    angle = math.atan2(arm, height) * ANGLES
    sin, cos, tilted = np.sin(angle), np.cos(angle), angle + math.radians(facade.tilt_deg)
    jkn, edge = parts(facade)
    q, edge = weight / (jkn * width), edge / jkn
    whole = 0.5 * b - (b**3 / 12.0 + 0.5 * edge * b**2) * sin / q
    partly = (np.sqrt(edge**2 + 2.0 * q / sin) - edge) ** 3 * sin / (6.0 * q)
    place = np.where(sin * (0.5 * b**2 + edge * b) <= q, whole, partly)
    moment = weight * (arm * np.cos(tilted) - height * np.sin(tilted) - cos * place)
    for hold in holds(facade):
        out = hold.height_m * sin
        pull = np.clip(hold.stiffness_n_m * (out - hold.slack_m), 0.0, hold.capacity_n)
        moment += np.where(out < hold.reach_m, pull, 0.0) * hold.height_m * cos
    return float(moment.max() / (weight * height))


def _pieces_stand(config):
    """Whether rigid pieces that stand on each other stand, floors and ties holding.

    With θ_j the rotation of piece j, L_j its height and u(z) the displacement at z,
    2V = Σ jkn_j b³w/12 (θ_j − θ_(j−1))² + Σ k u(z)² − Σ P ∫₀ᶻ θ² dz over all weights P.
    """
    facade = Facade.of(config["facade"])
    shape = shape_of(facade)
    edges = np.array([0.0, *shape.hinges_m, shape.top_m])
    jkn = np.array([joint_stiffness(config)[0], *hinge_stiffness(facade.e_mpa, shape)])
    joints = [(0.0, shape.thickness_m, shape.base_lost_m)]
    joints += [shape.joint_at(z) for z in shape.hinges_m]
    size = np.array([(y1 - y0) ** 3 * (shape.width_m - lost) for y0, y1, lost in joints])
    turning = jkn * size / 12.0
    apart = np.eye(jkn.size) - np.eye(jkn.size, k=-1)
    matrix = apart.T @ (turning[:, None] * apart)

    def lengths(z):  # of each piece below a height
        return np.clip(z - edges[:-1], 0.0, np.diff(edges))

    for hold in holds(facade):
        if hold.slack_m <= 0.0:
            z = hold.height_m
            matrix += hold.stiffness_n_m * np.outer(lengths(z), lengths(z))
    loads = [(mass * GRAVITY_M_S2, centre[2]) for mass, centre, _, _ in shape.pieces]
    loads += [(row.load_n, row.height_m) for row in facade.floors]
    for load, z in loads:
        matrix -= load * np.diag(lengths(z))
    return bool(np.linalg.eigvalsh(matrix)[0] > 0.0)


def _pieces_rest(config):
    """Whether loads off the middle leave pieces a place where they rest, with joints that open."""
    try:
        facade_scene({**config, "numerics": NODES}, PLAIN, beta_s=0.0)
    except DoesNotStandError:
        return False
    return True


def _with(config, changes):
    """A configuration with other values in section facade."""
    return {**config, "facade": {**config["facade"], **changes}}


def _heights(facade, factor):
    """All heights of a façade, multiplied."""
    scaled = {key: factor * facade[key] for key in HEIGHTS}
    scaled["hinges_m"] = [factor * z for z in facade["hinges_m"]]
    for name, keys in LISTS.items():
        scaled[name] = [{**row, **{key: factor * row[key] for key in keys}} for row in facade[name]]
    return scaled
