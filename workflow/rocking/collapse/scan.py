"""The dense scan of an incremental dynamic analysis: every range of collapse, with its scatter."""

import functools
import json

import numpy as np
import pandas as pd

from rocking.collapse import hidden, search
from rocking.collapse.search import Answer
from rocking.solver.lines import in_parts
from rocking.solver.motions import Motions
from rocking.solver.plane import moving_supports, to_plane
from rocking.solver.runs import STEP_FRACTION, Brief, fitted, peaks, stable_step
from rocking.solver.substructure import NO_BODIES, Bodies, bodies
from smdof.chain import shear_chain
from yade_scripts.commands.perturb import (
    NODE_CHOICES,
    NODE_KEYS,
    STEP_SPREAD,
    Realisation,
    perturbed_numerics,
)
from yade_scripts.model import floor_motions, models, registry, yielding
from yade_scripts.model.chain import yields
from yade_scripts.model.facade import facade_scene
from yade_scripts.model.floor_motions import GROUND, VERTICAL
from yade_scripts.model.motion import amplitude
from yade_scripts.model.storeys import storeys_of
from yade_scripts.model.wall_motion import floor_motion

NODES = 17  # along every edge: within 1 % of its converged answer where YADE needs more
STEPS = 4  # different steps of the realisations
SHORTER = tuple(1.0 - STEP_SPREAD * k / STEPS for k in range(STEPS))
LAYOUTS_SHORTER = tuple(1.0 - 0.03 * k for k in range(NODE_CHOICES))  # of long steps
BRICKS_STEP = 0.4  # of W3's stable step, which its bricks decide: 0.20 ms
COURSES_NODES = {"nodes_thickness": 5, "nodes_height": 9, "nodes_per_block": 5}  # beds need none
LIGHT_STEP = 0.5  # of the stable step with the masses that carry the walls
COURSES_STEP = 0.072  # of the stable step of the same façade in one block
# Before walls that do not give way, whose impacts add up (docs/record.md#accuracy)
FIRM_STEP, GIVES_WAY = 0.06, 20.0  # what carries walls that do: so many times its mass at most
# The light one of pieces makes their stable step short: of it they take so many times the share
# of one block, up to the second (docs/record.md#accuracy has the errors)
PIECES_STEPS, PIECES_MOST = 4.0 / 3.0, 0.4
HEAVY_KG = 1e9  # of a building that drives its walls; what they do to it is left out
OWN_MOTIONS = 32  # at once, where each amplitude has floor motions of its own: 0.4 GB
KEPT = 16  # façades whose scenes are kept, for the motions that follow
LATE_STEP = 0.5  # of `COURSES_STEP`, where the dashpots of thin courses act at the end of a step
YIELDED = 2.0  # times as long a brief history goes on behind a building that yields
UPRIGHT = 1e-12  # θ₀/α of a block that is let go: its lean at rest is not looked for
# Of brief histories by long steps: times the step of courses, and parts of friction along a joint
COURSES_LONG, COURSES_PARTS = 3.0, 16  # what they cost half collapse: docs/record.md#assessment


class Scan:
    """Outcomes of one curve at any amplitudes, by the planar solver.

    `ground` is the acceleration for a factor of one [m/s²]; `planes` the scene in every layout of
    nodes that realisations use, `steps_s` their steps, of which realisations take the shares
    `shorter` one after the other. From half of `static_g`, the static multiplier, a curve climbs,
    and asks for `block` amplitudes at once.
    """

    numerics: dict
    direction: str
    ground: np.ndarray
    planes: list
    steps_s: list
    shorter: tuple = SHORTER
    carried: Bodies | None
    motions: Motions
    static_g: float
    block: int = search.BLOCK
    #: whether amplitudes may have motions of their own, which take memory
    own_motions: bool = False

    def routes(self, pga_g):
        """Which scan runs each intensity: itself, or one that has what it does not."""
        return [self] * len(pga_g)

    def shaking(self, pga_g):
        """`Motions` of each intensity, and the factor on them."""
        pga_g = np.ravel(np.asarray(pga_g, float))
        return [self.motions] * pga_g.size, amplitude(self.ground, self.direction, pga_g)

    def run(self, pga_g, scatter):
        """Outcomes at ascending amplitudes; `scatter` turns node layout and step with them.

        pga_g, extra_nodes, step_factor, d_over_b, status, collapsed.
        """
        return together([(self, pga_g, scatter)])[0]

    def seen(self, strategy):
        """Outcomes of all that a search asks for, by ascending amplitude, and what it found."""
        return seen_together([(self, strategy)])[0]


def together(asks):
    """What `run` of some scans gives; histories of one plane and step march side by side.

    Parameters
    ----------
    asks : list of (Scan, pga_g, scatter)
        As for `run`, of any cases and motions.

    Returns
    -------
    list of DataFrame
    """
    return [table for table, _ in marched(asks)]


def marched(asks):
    """Outcomes as of `together`, each with the largest d/b of every second, shape (n, seconds)."""
    alike: dict[tuple, list] = {}
    parts, count = [], 0
    for scan, levels, scatter in asks:
        pga_g = np.asarray(levels, float)
        turn = np.arange(pga_g.size) * bool(scatter)
        extra, step = turn % len(scan.planes), np.array(scan.shorter)[turn % len(scan.shorter)]
        routes = scan.routes(pga_g)
        for k, (route, layout) in enumerate(zip(routes, extra, strict=True)):
            key = (id(route.planes[layout]), step[k] * route.steps_s[layout])
            alike.setdefault(key, []).append((route, layout, pga_g[k], count + k))
        parts.append({"pga_g": pga_g, "extra_nodes": extra, "step_factor": step})
        count += pga_g.size
    d_over_b, status = np.full(count, np.nan), np.full(count, "failed", object)
    swings = np.full((count, 1), np.nan)
    for (_, step_s), histories in alike.items():
        for some in _batches(histories):
            (scan, layout, *_), here = some[0], np.array([row for *_, row in some])
            motions, factors = _shaking(some)
            how = {"carried": scan.carried, "step_s": step_s}
            outcomes = peaks(scan.planes[layout], motions, scan.numerics, factors, **how)
            d_over_b[here] = np.minimum(outcomes.d_over_b, 1.0)
            wider = max(outcomes.spans.shape[1] - swings.shape[1], 0)
            swings = np.pad(swings, ((0, 0), (0, wider)))
            swings[here, : outcomes.spans.shape[1]] = outcomes.spans
            status[here[~outcomes.failed]] = "ok"
            status[here[outcomes.overturned]] = "overturned"
    tables, first = [], 0
    for part in parts:
        mine = slice(first, first := first + part["pga_g"].size)
        fell = (status[mine] == "overturned").astype(int)
        said = {"d_over_b": d_over_b[mine], "status": status[mine], "collapsed": fell}
        tables.append((pd.DataFrame({**part, **said}), swings[mine]))
    return tables


def _batches(histories):
    """Cut histories (scan, layout, pga_g, row) into as many at once as memory holds."""
    if not any(scan.own_motions for scan, *_ in histories):
        return [histories]
    return [histories[at : at + OWN_MOTIONS] for at in range(0, len(histories), OWN_MOTIONS)]


def _shaking(histories):
    """Motions and factors of histories (scan, layout, pga_g, row); each scan is asked once."""
    by_scan: dict[int, list] = {}
    for k, (scan, *_) in enumerate(histories):
        by_scan.setdefault(id(scan), []).append(k)
    motions, factors = [None] * len(histories), np.zeros(len(histories))
    for mine in by_scan.values():
        scan_motions, factors[mine] = histories[mine[0]][0].shaking([histories[k][2] for k in mine])
        for k, motion in zip(mine, scan_motions, strict=True):
            motions[k] = motion
    return motions, factors


def one_by_one(asks):
    """Outcomes of what runs by itself, each without its seconds."""
    return [(scan.run(*what), None) for scan, *what in asks]


def seen_together(searches, run=marched):
    """What `seen` of some scans gives: what they ask for at a time is run at once.

    Parameters
    ----------
    searches : list of (Scan, strategy)
    run : callable
        As `marched`.

    Returns
    -------
    list of (DataFrame, found)
        Of histories by a solver that tells their seconds, what `hidden.reach` says is a column.
    """
    parts: list[list] = [[] for _ in searches]
    found, answers = [None] * len(searches), dict.fromkeys(range(len(searches)))
    while answers:
        asked = {}
        for k, answer in answers.items():
            try:
                asked[k] = searches[k][1].send(answer)
            except StopIteration as end:
                found[k] = end.value
        tables = run([(searches[k][0], a.pga_g, a.realisations) for k, a in asked.items()])
        answers = {}
        for k, (table, swings) in zip(asked, tables, strict=True):
            parts[k].append((table, swings))
            status, d_over_b = table["status"].to_numpy(), table["d_over_b"].to_numpy(float)
            answers[k] = Answer(status, d_over_b, swings)
    for (scan, _), part in zip(searches, parts, strict=True):
        part += [] if part else run([(scan, [], False)])  # it asked for nothing
    return list(zip(map(_whole, parts), found, strict=True))


def _whole(parts):
    """One table of some, by ascending amplitude, with what each history's swings could come to."""
    tables, swings = zip(*parts, strict=True)
    table = pd.concat(tables, ignore_index=True).sort_values("pga_g")
    if all(part is not None for part in swings):
        rows = search.stacked(swings)[table.index]
        stood, pga_g = (table["status"] == "ok").to_numpy(), table["pga_g"].to_numpy()
        table["reach"] = np.nan
        table.loc[stood, "reach"] = hidden.reach(pga_g[stood], rows[stood], pga_g.min(initial=1.0))
    return table.reset_index(drop=True)


@functools.lru_cache(maxsize=KEPT)
def _layouts_of(text, fraction, brief=False):
    """Scene, planes, steps [s], shorter steps and carried masses of a scene file (JSON)."""
    case = json.loads(text)
    kind, shorter = registry.model(case["model"]), SHORTER
    bricks = not kind.single_block  # their scene holds the masses that carry them
    courses = case["facade"].get("courses", 0)
    planes = []
    turns = layouts(case["numerics"], COURSES_NODES if courses else {})
    for numerics in turns[:1] if courses else turns:  # joints of courses have no nodes
        name = case["model"] if bricks else kind.one_way_model
        scene = models.build_scene({**case, "model": name, "numerics": numerics})
        planes.append(to_plane(scene, GROUND if kind.two_way and not bricks else None))
    usual = BRICKS_STEP if bricks else COURSES_STEP if courses else STEP_FRACTION
    share = fraction or usual
    if getattr(planes[0], "in_row", False) and not courses:
        share = max(share, min(PIECES_STEPS * share, PIECES_MOST))
    if fraction:
        shorter = LAYOUTS_SHORTER
    steps_s = [share * stable_step(plane) for plane in planes]
    carried = carried_masses(case, scene) if kind.two_way and not bricks else None
    if courses:
        usual = FIRM_STEP if _stands_firm(carried, planes[0]) else COURSES_STEP
        share = min(share, usual) * (LATE_STEP if planes[0].late > 1.0 else 1.0)
        if brief and fraction:
            share *= COURSES_LONG
            fewer = [in_parts(plane.lines, COURSES_PARTS) for plane in planes]
            planes = [p._replace(lines=some) for p, some in zip(planes, fewer, strict=True)]
        steps_s = [share * one_block_step(case)] * len(planes)
    if carried is not None:  # light masses between stiff contacts want shorter ones
        ahead = [getattr(plane, "lead", 0.0) for plane in planes]
        most = [
            LIGHT_STEP * stable_step(plane, carried, lead)
            for plane, lead in zip(planes, ahead, strict=True)
        ]
        steps_s = list(map(min, steps_s, most))
    planes = [fitted(plane, carried, step) for plane, step in zip(planes, steps_s, strict=True)]
    return scene, planes, steps_s, shorter, carried


def _stands_firm(carried, plane):
    """Whether walls do not give way to a façade: no mass carries them, or a heavy one."""
    if carried is None:
        return True
    return carried.mass_kg.sum() > GIVES_WAY * np.sum(plane.mass_kg)


class Screen(Scan):
    """Outcomes of one model, record and direction of a case file.

    Floor motions are those of `floor_motions.read`; `before` is a shock before them (time_s,
    columns, pause_s), as it shakes. A history ends once what is left of the motion no longer tells
    (`runs.Brief`): its largest displacement and whether it fell are those of the whole motion.
    Behind a building that yields its elastic floors tell when little is left, and histories end
    `YIELDED` times as much later. A `fraction` is the step over the stable one, where the solver's
    own choice is too dear (of pieces between hinges up to `PIECES_STEPS` as much); then every
    layout of nodes has a step of its own. `brief` is for climbs that look for half collapse: with a
    fraction, courses take `COURSES_LONG` times their step and `COURSES_PARTS` of friction.

    Where a building yields and drives its walls, it marches with the façade: as one that carries
    them and that nothing can push. Where it does not at an amplitude, its floors are scaled.
    """

    carrying: "Screen | None" = None  # with the building that yields

    def __init__(self, case, time_s, columns, direction, fraction=None, before=None, brief=False):
        """Prepare the scene in every layout of nodes that realisations use."""
        self.direction, self.ground = direction, columns["ground"]
        ends = Brief()
        if registry.model(case["model"]).chain and yields(case["smdof"]):
            ends = ends._replace(after_s=YIELDED * ends.after_s)
        self.numerics = {**case["numerics"], "brief": ends}
        kept = _layouts_of(json.dumps(case, sort_keys=True), fraction, brief)
        self.scene, self.planes, self.steps_s, self.shorter, self.carried = kept
        self.two_way = registry.model(case["model"]).two_way
        if before is not None:
            columns = yielding.following(columns, before[1])
        self.time_s, self.columns, self.before = time_s, columns, before
        self.motions = self._motions(time_s, columns)
        self.yields = isinstance(columns, yielding.ByAmplitude)
        self.own_motions = self.yields or before is not None
        self.static_g = models.static_multiplier(case)
        kind = registry.model(case["model"])
        if isinstance(columns, yielding.YieldingFloors) and kind.single_block:
            wall = {**case["return_wall"], "building_mass_kg": HEAVY_KG}
            heavy = {**case, "model": kind.two_way_model, "return_wall": wall}
            how = fraction, before, brief
            self.carrying = Screen(heavy, time_s, dict(columns), direction, *how)
            free = self.carrying.carried or NO_BODIES
            self.carrying.carried = free._replace(carried=np.zeros_like(free.carried))

    def routes(self, pga_g):
        """As of any scan; where the building yields `carrying`."""
        if self.carrying is None:
            return super().routes(pga_g)
        weak = self.columns.weak(amplitude(self.ground, self.direction, np.asarray(pga_g, float)))
        return [self.carrying if yields else self for yields in weak]

    def _motions(self, time_s, columns):
        if self.two_way:
            alone = [row for name, row in columns.items() if name not in (GROUND, VERTICAL)]
            return Motions(time_s, columns["ground"], (), columns.get(VERTICAL), alone)
        return driving(self.scene, time_s, columns)

    def shaking(self, pga_g):
        """As of any scan; a shock before keeps its own amplitude, floors that yield have theirs."""
        motions, factors = super().shaking(pga_g)
        if self.before is None and (self.carrying is not None or not self.yields):
            return motions, factors
        if self.yields:
            second = self.columns.at_all(factors)
        else:
            second = [floor_motions.scaled(self.columns, factor) for factor in factors]
        if self.before is None:
            stay = [moved.scaled for moved in second]
            driven = [
                motions[k] if stay[k] else self._motions(self.time_s, moved)
                for k, moved in enumerate(second)
            ]
            return driven, np.where(stay, factors, 1.0)
        both = [floor_motions.after(self.before, self.time_s, columns) for columns in second]
        return [self._motions(*columns) for columns in both], np.ones(len(both))


def scan_settings(case):
    """What a search takes of a case file: section ida, realisations and amplitude_spread.

    W3, of more than twenty blocks, has its own steps.
    """
    ensemble = {key: case["ensemble"][key] for key in ("realisations", "amplitude_spread")}
    bricks = {} if registry.model(case["model"]).single_block else case["w3"]["scan"]
    return {**case["ida"], **ensemble, **bricks}


def driving(scene, time_s, columns):
    """`Motions` of a scene whose supports are driven, by floor motions as `floor_motions.read`."""
    columns = floor_motions.motion_columns(scene, columns)
    base = columns[scene.blocks[scene.index(scene.reference)].motion]
    supports = [columns[name] for name in moving_supports(scene)]
    return Motions(time_s, base, supports, columns.get(VERTICAL))


def one_block_step(case):
    """Stable step of the façade of a case of courses in one block, walls driven [s].

    It is that of a block that is let go upright: one may fall by itself where courses stand.
    """
    facade = {**case["facade"], "courses": 0}
    name = registry.model(case["model"]).one_way_model
    numerics = {**case["numerics"], **dict.fromkeys(NODE_KEYS, NODES)}
    one_block = {**case, "facade": facade, "numerics": numerics}
    return stable_step(
        to_plane(facade_scene(one_block, name, case["beta_s"], release_ratio=UPRIGHT))
    )


def layouts(numerics, nodes=None):
    """Section numerics in every layout of nodes that realisations use."""
    nodes = {**numerics, **dict.fromkeys(NODE_KEYS, NODES), **(nodes or {})}
    return [
        perturbed_numerics(nodes, Realisation(0, 1.0, extra_nodes=n)) for n in range(NODE_CHOICES)
    ]


def carried_masses(case, scene):
    """Masses, springs and dashpots of the chain that carries the return walls of a case file.

    The motions of `scene`, its one-way counterpart, say where each wall hangs.
    """
    chain, mass = case["smdof"], case["return_wall"]["building_mass_kg"]
    shear = shear_chain(chain["n_dof"], chain["period_s"], mass)
    mass_matrix, stiffness = shear.matrices()
    damping = shear.damping_matrix(chain["damping_ratio"], chain["damping_model"])
    mixed = scene.notes.get("motions", {})
    floors = [floor_motion(j) for j in range(1, chain["n_dof"] + 1)]
    shares = [mixed.get(name, {name: 1.0}) for name in moving_supports(scene, GROUND)]
    hang = [[share.get(floor, 0.0) for floor in floors] for share in shares]
    carried = bodies(np.diag(mass_matrix), stiffness, damping, hang)
    return carried._replace(storeys=storeys_of(case, mass))
