"""The walls of the calibration study, the β each is run at, and the best-fitting β of a wall."""

import itertools
import math

import numpy as np
from rocking.configuration.config import resolve
from rocking.mechanics import beta as calibration
from rocking.mechanics import closed_forms

from studies.shared.restitution import IMPACTS, TARGETS, e_exp, e_one_sided, misfit, rebounds
from yade_scripts.model.facade import joint_stiffness
from yade_scripts.model.quadrature import gauss_lobatto
from yade_scripts.model.scene import Block, Interface, NodeList, Scene, box_inertia
from yade_scripts.model.stiffness import modes

SECTIONS = ("facade", "return_wall", "smdof", "numerics")
AS_GOOD = 0.01  # misfits that differ by less, in e_exp/|e_1SR|, fit equally well
END = 3.0  # end of a history after the first fall, in units of 1/p: three rebounds are over
# β at which every wall is run, over 1/ω_c (see `calibration.groups`): around the fits, which lie
# at 0.6 to 1.1; a fit that comes to lie at an end is marked
LADDER = 0.85 * np.sqrt(2.0) ** np.arange(-2, 3)
WHOLE_RANGE = 8  # further β over the study's whole range, for figure 4a
SENSITIVITY = ((0.11, 1800.0, 0.8 / 0.11), (0.3, 4050.0, 15.0))  # b [m], E [MPa], h/b
FACADE = (0.375, 1800.0, 17.28)  # the study's façade: softer on its base than any batch's wall


def two_block_minimum(config):
    """Smallest β of the study's range [s]: 1/ω of the stiffest mode of two stacked halves.

    The wall is cut at mid height; base and cut have jkn = E/(h/2), the spacing of the
    joints, so that ζ = 0.5 at the highest of the six planar modes, as the largest β gives
    ζ = 0.5 to the rotation of the single block (after DeJong, 2009).
    """
    facade = config["facade"]
    h, b, width = facade["height_m"], facade["thickness_m"], facade["width_m"]
    half = (width, b, 0.5 * h)
    mass = 0.5 * facade["density_kg_m3"] * h * b * width
    jkn = facade["e_mpa"] * 1e6 / (0.5 * h)
    points, weights = gauss_lobatto(3)
    blocks = [Block("base", (0.0, 0.5 * b, -0.5), half, 1.0, (1.0, 1.0, 1.0), free="")]
    nodes = NodeList()
    for i in (1, 2):
        centre = (0.0, 0.5 * b, 0.5 * h * (i - 0.5))
        blocks.append(Block(f"half {i}", centre, half, mass, box_inertia(mass, half), free="yzX"))
        line = np.stack([0 * points, points * b, np.full(3, 0.5 * h * (i - 1))], axis=1)
        nodes.add_joint(
            f"joint {i}",
            i,
            i - 1,
            line,
            (0, 0, 1),
            weights * b * width,
            Interface(jkn, facade["shear_stiffness_ratio"] * jkn),
        )
    scene = Scene(blocks, nodes.joints, nodes.done(), "half 2", (0.0, 0.5 * b, h), "base", b)
    return 1.0 / float(modes(scene)[0][-1])


def single_block_maximum(config):
    """Largest β of the study's range [s], 1/ω of the block's rotation on its base."""
    f = config["facade"]
    return 1.0 / closed_forms.base_rocking_frequency(
        f["height_m"], f["thickness_m"], f["density_kg_m3"], f["e_mpa"] * 1e6
    )


def beta_grid(config, whole_range=False):
    """β at which a wall is run [s], ascending: the ladder, and the study's range if asked for."""
    betas = LADDER / calibration.groups(config)["omega_c_rad_s"]
    if whole_range:
        ends = two_block_minimum(config), single_block_maximum(config)
        betas = np.concatenate([betas, np.geomspace(*ends, WHOLE_RANGE)])
    return [float(f"{b:.6g}") for b in np.sort(betas)]


def wall_case(name, config, release_ratio, betas, *, end=END, **about):
    """One wall for the study `walls`, released, with what the tables say about it."""
    h, b, density = (config["facade"][key] for key in ("height_m", "thickness_m", "density_kg_m3"))
    p = closed_forms.block(h, b).p_rad_s
    base = joint_stiffness(config)[0]
    # on a soft base a small rebound is half a swing of the block on its springs, about its foot
    # at half the frequency of the rotation about its centre, however low the rebound
    swing = 2.0 * math.pi / closed_forms.base_rocking_frequency(h, b, density, base * h)
    limit = closed_forms.quarter_period(release_ratio, p) + end / p + IMPACTS * swing
    return {
        "id": name,
        "config": {key: config[key] for key in SECTIONS},
        "model": "W1",
        "release_ratio": release_ratio,
        "beta_s": list(betas),
        "limit_s": float(f"{limit:.6g}"),
        "about": about,
    }


def batch_wall(settings, b, e_mpa, slenderness, ratio, **numerics):
    """Resolved configuration of a batch's wall, of unit width."""
    return resolve(
        {
            "models": ["W1"],
            "facade": {
                "courses": 0,
                "height_m": float(f"{slenderness * b:.6g}"),
                "thickness_m": b,
                "width_m": 1.0,
                "density_kg_m3": settings["density_kg_m3"],
                "e_mpa": e_mpa,
                "base": settings["base"],
            },
            "return_wall": {"count": 2, "thickness_m": 0.5 * ratio},
            "numerics": {**study_numerics(settings), **numerics},
        }
    )


def study_numerics(settings):
    """Section numerics of the study's runs."""
    return {key: settings[key] for key in ("nodes_thickness", "nodes_height", "step_fraction")}


def batches(settings):
    """(b, E) of each batch, in the order of their names batch1, batch2, …"""
    return list(itertools.product(settings["thickness_m"], settings["e_mpa"]))


def batch_cases(settings, number):
    """Cases of batch `number` (from 1): every slenderness at every return-wall ratio."""
    b, e_mpa = batches(settings)[number - 1]
    cases = []
    for slenderness in settings["slenderness"]:
        for ratio in sorted({*settings["return_wall_ratio"], settings["reference_ratio"]}):
            config = batch_wall(settings, b, e_mpa, slenderness, ratio)
            reference = ratio == settings["reference_ratio"]
            cases.append(
                wall_case(
                    f"b{b:g}_E{e_mpa:g}_s{slenderness:g}_r{ratio:g}",
                    config,
                    settings["release_ratio"],
                    beta_grid(config, reference and number == 1),
                    role="reference" if reference else "ratio",
                )
            )
    return cases


def sensitivity_cases(settings):
    """Two walls with one thing changed at a time, and the study's façade, for the law's range.

    Role "stiffness" varies what the law describes; role "other" what it leaves out: release,
    friction, shear stiffness, width at the same ratio, and the discretisation.
    """
    r, released = settings["reference_ratio"], settings["release_ratio"]
    walls = []  # its number, the change, its role, the configuration, the release
    for number, (b, e_mpa, slenderness) in enumerate(SENSITIVITY, 1):
        base = batch_wall(settings, b, e_mpa, slenderness, r)
        for change, role, sections, release in _changes(settings, slenderness * b, e_mpa):
            config = {**base, **{name: {**base[name], **keys} for name, keys in sections.items()}}
            walls.append((number, change, role, config, release))
    for change, ratio, factor in (
        ("façade", r, 1.0),
        ("façade, ratio 0.1", 0.1, 1.0),
        ("façade, ratio 0.5", 0.5, 1.0),
        ("façade, density ×1.25", r, 1.25),
    ):
        config = batch_wall(settings, *FACADE, ratio)
        config["facade"]["density_kg_m3"] *= factor
        walls.append((3, change, "stiffness", config, released))
    return [
        wall_case(
            f"wall {number}: {change}",
            config,
            release,
            beta_grid(config),
            role=role,
            change=change,
            wall=number,
        )
        for number, change, role, config, release in walls
    ]


def _changes(settings, h, e_mpa):
    """What is changed of a wall of height h [m]: name, role, keys by section, release θ0/α."""
    release, density = settings["release_ratio"], settings["density_kg_m3"]
    low, high = 0.6 * release, 1.4 * release
    jkn = e_mpa * 1e6 / h
    twice = {
        "nodes_thickness": 2 * settings["nodes_thickness"],
        "nodes_height": 2 * settings["nodes_height"],
        "step_fraction": 0.5 * settings["step_fraction"],
    }
    narrow = {"thickness_m": 0.25 * settings["reference_ratio"]}
    return [
        ("none", "other", {}, release),
        ("L/h 0.25", "stiffness", {"return_wall": {"length_m": 0.25 * h}}, release),
        ("L/h 1", "stiffness", {"return_wall": {"length_m": h}}, release),
        ("ratio 0.05", "stiffness", {"return_wall": {"thickness_m": 0.025}}, release),
        ("ratio 1", "stiffness", {"return_wall": {"thickness_m": 0.5}}, release),
        ("base jkn ×0.5", "stiffness", {"facade": {"base_stiffness_pa_m": 0.5 * jkn}}, release),
        ("base jkn ×2", "stiffness", {"facade": {"base_stiffness_pa_m": 2.0 * jkn}}, release),
        ("E ×0.25", "stiffness", {"facade": {"e_mpa": 0.25 * e_mpa}}, release),
        (f"θ0/α {low:g}", "other", {}, low),
        (f"θ0/α {high:g}", "other", {}, min(high, 0.95)),
        ("back friction 0°", "other", {"return_wall": {"friction_deg": 0.0}}, release),
        ("base friction 45°", "other", {"facade": {"friction_deg": 45.0}}, release),
        ("jks/jkn 1", "other", {"facade": {"shear_stiffness_ratio": 1.0}}, release),
        ("density ×1.25", "stiffness", {"facade": {"density_kg_m3": 1.25 * density}}, release),
        (
            "width ×0.5, same ratio",
            "other",
            {"facade": {"width_m": 0.5}, "return_wall": narrow},
            release,
        ),
        ("nodes ×2, step ×0.5", "other", {"numerics": twice}, release),
    ]


def at_ratio(config, ratio):
    """Configuration with return walls as thick together as a share of the façade's width."""
    walls = config["return_wall"]
    thickness_m = ratio * config["facade"]["width_m"] / walls["count"]
    return {**config, "return_wall": {**walls, "thickness_m": thickness_m}}


def wall_cases(settings, wall, ratios=(), betas=()):
    """Cases of one given wall: as configured, then at other return-wall ratios."""
    cases = []
    for ratio in (None, *ratios):
        config = wall if ratio is None else at_ratio(wall, ratio)
        config = {**config, "numerics": {**config["numerics"], **study_numerics(settings)}}
        cases.append(
            wall_case(
                wall["run"] if ratio is None else f"{wall['run']} r{ratio:g}",
                config,
                settings["release_ratio"],
                sorted({*beta_grid(config), *betas}),
                end=2.0 * END,
                role="wall",
            )
        )
    return cases


def best_fit(betas_s, e_ratio, targets=TARGETS):
    """Best-fitting β of one wall from e_exp/|e_1SR|, shape (n, 3), at several ascending β [s].

    e_n/e_target is linear in ln β between neighbouring runs; where an impact is missing (nan) in
    one of them there is no value between them either. Of numbers and lists::

        beta_s, misfit       the middle of the β that fit best within AS_GOOD, in ln β; nan if
                             no β has every impact
        at_edge              whether it is the smallest or largest β that could be judged
        single_s             list: β at which impact n alone is at the middle of its range, nan
                             where it never is
        low_s, high_s        smallest and largest of beta_s and the single ones
        ratio                list: e_n/e_target at beta_s
    """
    x, e = np.log(np.asarray(betas_s, float)), np.asarray(e_ratio, float)
    count = len(targets)
    if np.any(np.diff(x) <= 0.0) or e.shape != (len(x), count):
        raise ValueError(f"best fit of β: expected ascending β and {count} ratios for each")
    fine = np.unique(np.concatenate([x, np.linspace(x[0], x[-1], 2001)]))
    # nan in either neighbour spreads to everything between them
    curves = np.stack([np.interp(fine, x, e[:, n]) for n in range(count)], axis=1)
    single = []
    for n, (low, high) in enumerate(targets):
        gap = curves[:, n] - 0.5 * (low + high)
        crossing = np.flatnonzero((gap[:-1] >= 0.0) & (gap[1:] < 0.0))
        single.append(float(np.exp(fine[crossing[0]])) if len(crossing) else math.nan)
    error = misfit(curves, 1.0, targets)
    judged = np.flatnonzero(np.isfinite(error))
    if not len(judged):
        none = dict.fromkeys(("beta_s", "misfit", "low_s", "high_s"), math.nan)
        return {**none, "at_edge": False, "single_s": single, "ratio": [math.nan] * count}
    least = judged[np.argmin(error[judged])]
    # the middle of the β that fit as well: ranges leave the least misfit flat, or with a kink
    # at either end, and a thousandth of e would move the winner by several per cent
    poorer = np.flatnonzero(~(error <= error[least] + AS_GOOD))
    first = max(poorer[poorer < least], default=-1) + 1
    last = min(poorer[poorer > least], default=len(fine)) - 1
    best = int(np.argmin(np.abs(fine - 0.5 * (fine[first] + fine[last]))))
    beta = float(np.exp(fine[best]))
    every = [beta, *(s for s in single if math.isfinite(s))]
    return {
        "beta_s": beta,
        "misfit": float(error[best]),
        "at_edge": bool(least in (judged[0], judged[-1])),
        "single_s": single,
        "low_s": min(every),
        "high_s": max(every),
        "ratio": [float(v) for v in curves[best]],
    }


def targets_of(measured, e_target):
    """Targets of a wall: measured e_exp over |e_1SR| where given, else those of the study."""
    out = list(TARGETS)
    for n, value in enumerate(measured[:IMPACTS]):
        out[n] = (value / e_target, value / e_target)
    return tuple(out)


def evaluate(cases, histories):
    """Rebounds and e_exp of every run, wall by wall.

    Cases are as given to the study `walls`, histories as of `restitution.read_archive` in the same
    order. Of each wall case, e_1sr, beta_s (n,), found (`Rebounds`), e (n, 3) and histories.
    """
    by_wall: dict[str, list] = {case["id"]: [] for case in cases}
    for history in histories:
        by_wall[history["id"]].append(history)
    out = []
    for case in cases:
        runs, facade = by_wall[case["id"]], case["config"]["facade"]
        if [r["beta_s"] for r in runs] != case["beta_s"]:
            raise ValueError(f"histories of wall '{case['id']}' do not belong to its case")
        observed = [rebounds(r["time_s"], r["theta_over_alpha"]) for r in runs]
        out.append(
            {
                "case": case,
                "e_1sr": e_one_sided(facade["height_m"], facade["thickness_m"]),
                "beta_s": np.array(case["beta_s"]),
                "found": observed,
                "e": np.array([e_exp(f) for f in observed]),
                "histories": runs,
            }
        )
    return out
