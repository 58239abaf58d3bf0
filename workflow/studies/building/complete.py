"""The complete building of a configuration (CB, CBc): its scene, its modes, its linear answer."""

import itertools

import numpy as np
from rocking.collapse.probability import collapse_ranges, from_scan
from rocking.mechanics.beta import beta_for
from scipy.optimize import brentq
from scipy.signal import cont2discrete, dlsim

from studies.building.case import build_model, read_plan, real_brick, real_joints, translation_mode
from studies.building.modes import Solver, largest_eigenvalue, per_mass, sparse_of
from studies.building.yade import complete
from yade_scripts.commands.perturb import Realisation, perturbed_numerics
from yade_scripts.commands.search import DIGITS
from yade_scripts.files import read_json
from yade_scripts.model import stiffness
from yade_scripts.model.registry import COMPLETE

from .history import mass_damping_rate

MODES = 12
LINEAR_MODES = 60  # of `linear_history`
OWN = ("step_fraction", "quiet_ratio", "rest_velocity_m_s", "sample_interval_s")  # of numerics


def complete_building(config, plan, load_kg_m2, model, beta_s, coarsening=None):
    """Build the scene of CB or CBc, with its critical step.

    `config` has sections building, complete, facade, return_wall and numerics; a plan has its front
    façade. None takes the load of the plan, and the configured coarsening. Notes of the scene are
    critical_step_s, rate_1_s (the mass-proportional damping that gives
    building.damping_ratio in the first mode along y of what stands behind the crack) and
    mass_behind_kg.
    """
    settings, section = config["building"], config["complete"]
    left, crack = complete.behind(plan)
    building = build_model(
        settings,
        left,
        "CBDEM",
        load_kg_m2,
        section["coarsening"] if coarsening is None else coarsening,
    )
    modes = Solver(complete.with_rigid_floors(building)).modes(MODES)
    rate = mass_damping_rate(modes.omega[translation_mode(modes)], settings["damping_ratio"])
    scene = complete.complete_scene(
        config,
        building,
        crack,
        beta_s,
        bonded=COMPLETE[model].bonded,
        masonry=(real_brick(settings), real_joints(settings)),
        rate_1_s=rate,
    )
    scene.notes.update(critical_step_s=critical_step(scene), rate_1_s=rate)
    return scene


def scene_of(config, job, model, coarsening=None, extra_nodes=0):
    """Scene of CB or CBc from a job's inputs plan, fit and law, and β.

    `config` is as of `complete_building`, its numerics with numbers for the nodes; `extra_nodes`
    are added to those along every edge and up every course, as realisations of a scan do.
    """
    load = read_json(job.input.fit)["floor_load_kg_m2"]
    beta = beta_for(config, job.input.law)
    numerics = perturbed_numerics(config["numerics"], Realisation(0, 1.0, extra_nodes=extra_nodes))
    section = config["complete"]
    section = {**section, "nodes_per_course": section["nodes_per_course"] + extra_nodes}
    config = {**config, "numerics": numerics, "complete": section}
    plan = read_plan(job.input.plan)
    return complete_building(config, plan, load, model, beta, coarsening), beta


def critical_step(scene):
    """Critical step of a large scene by Lanczos iteration, see `stiffness.critical_step` [s]."""
    triplets = stiffness.assemble(scene)
    parts = (sparse_of(triplets, values).tocsr() for values in (triplets.k, triplets.c))
    k, c = (per_mass(part, triplets.mass) for part in parts)

    def largest(matrix):
        return largest_eigenvalue(matrix, 1e-4)

    limit = 2.0 / np.sqrt(largest(k))
    if largest(limit**2 * k + 2.0 * limit * c) <= 4.0:
        return limit
    return brentq(lambda h: largest(h**2 * k + 2.0 * h * c) - 4.0, 1e-3 * limit, limit, rtol=1e-4)


def linear_history(scene, points, time_s, ground_m_s2):
    """Answer of a scene whose joints all stay closed, by its modes with their coupled damping.

    q̈ + φᵀCφ q̇ + ω²q = −Γ_y a_g of the lowest LINEAR_MODES, integrated exactly for a uniformly
    sampled, piecewise-linear a_g. Times, and displacements along y relative to the ground of blocks
    that are free there, shape (n_points, nt).
    """
    modes = Solver(scene).modes(LINEAR_MODES)
    triplets = stiffness.assemble(scene)
    c, n = sparse_of(triplets, triplets.c).tocsr(), len(modes.omega)
    zero, identity = np.zeros((n, n)), np.eye(n)
    a = np.block([[zero, identity], [-np.diag(modes.omega**2), -modes.phi.T @ (c @ modes.phi)]])
    b = np.concatenate([np.zeros(n), -modes.participation[:, 1]])[:, None]
    rows = [np.flatnonzero((modes.dof[:, 0] == p) & (modes.dof[:, 1] == 1))[0] for p in points]
    shape = np.hstack([modes.phi[rows], np.zeros((len(rows), n))])
    dt = (time_s[-1] - time_s[0]) / (len(time_s) - 1)
    system = cont2discrete((a, b, shape, np.zeros((len(rows), 1))), dt, method="foh")
    _, moved, _ = dlsim(system, np.asarray(ground_m_s2)[:, None])
    return np.asarray(time_s), moved.T


def run_numerics(config):
    """Section numerics of the runs of the complete building, with what section complete states."""
    return {**config["numerics"], "step_s": None, **{key: config["complete"][key] for key in OWN}}


def plan_of(scan, spread, step, most):
    """Where YADE begins a curve of the complete building (start_g) and where it looks (ranges) [g].

    It begins inside the scan's first range of collapse, at most `step` above its edge and not at
    it, since the reduction places that to a per cent or two only; of `most` further ranges it runs
    the middle, and that of the gap below each. The scan has pga_g, status and collapsed; `spread`
    is the half width of the window of a probability.
    """
    table = from_scan(scan, spread)
    ranges = collapse_ranges(table["pga_g"].to_numpy(), table["probability"].to_numpy())
    start = scan["pga_g"].max()
    if ranges:
        low, high = ranges[0]
        start = min(0.5 * (low + high), low * (1.0 + step))
    between = [
        0.5 * (lower + upper)
        for (_, b), (c, d) in itertools.islice(itertools.pairwise(ranges), most)
        for lower, upper in ((b, c), (c, d))
    ]
    return {"start_g": round(float(start), DIGITS), "ranges": [round(g, DIGITS) for g in between]}
