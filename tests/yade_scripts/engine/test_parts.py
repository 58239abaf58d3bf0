"""Parts of a façade on their building: base and walls on the chain, in both solvers."""

from pathlib import Path

import numpy as np
import pytest
from rocking.collapse import scan
from rocking.collapse.scan import Screen, carried_masses
from rocking.configuration.config import ConfigError
from rocking.records import load
from rocking.records.floors import floor_columns
from rocking.solver import history, to_plane
from rocking.solver.plane import matrices
from rocking.solver.stack import stack_matrices
from yade_process import in_yade, resolved

from yade_scripts.model.chain import chain_matrices
from yade_scripts.model.models import build_scene
from yade_scripts.model.scene import to_json
from yade_scripts.model.stiffness import assemble, free_dofs

TABLE = Path(__file__).parents[3] / "config" / "suites" / "recorded_suite.tsv"
MASS_KG, BETA_S = 66e3, 0.002
NODES = {"nodes_thickness": 5, "nodes_height": 5, "nodes_per_block": 5, "after_motion_s": 0.1}
ANCHORED = {"height_m": 4.0, "load_kn": 30.0, "friction": 0.0, "anchor_kn": 40.0}
SETBACK = {"thickness_steps": [{"z_m": 2.0, "thickness_m": 0.25}]}
KINDS = {
    "before walls": {"base_height_m": 2.5, "height_m": 4.0},
    "gable": {
        "base_height_m": 6.0,
        "building_height_m": 7.0,
        "height_m": 2.0,
        "outline": "triangle",
        "sides": "two",
    },
    "bending": {
        "base_height_m": 2.5,
        "building_height_m": 8.0,
        "height_m": 4.0,
        "hinges_m": [2.0],
        "floors": [ANCHORED],
        **SETBACK,
    },
    "leaning": {
        "base_height_m": 2.5,
        "height_m": 4.0,
        "tilt_deg": 0.5,
        "courses": 4,
        "openings": [{"x_m": 0.0, "z_m": 2.2, "width_m": 1.0, "height_m": 1.0}],
        "floors": [{"height_m": 2.0, "load_kn": 10.0, "friction": 0.3}],
        "ties": [{"height_m": 3.5, "count": 2, "diameter_mm": 12.0, "length_m": 4.0}],
    },
}


def part(model, facade, rule="top", **numerics):
    """Case of a part of a façade with the building's mass."""
    config = resolved(
        facade=facade,
        return_wall={"building_mass_kg": MASS_KG, "motion": rule},
        damping={"law": "value", "beta_s": BETA_S},
        numerics={**NODES, **numerics},
        models=[model],
    )
    return {**config, "model": model, "beta_s": BETA_S}


def recorded(case):
    """Floor motions of a record that chose nothing here."""
    return floor_columns(load("GMN_NS", TABLE), case["smdof"])


def planar(monkeypatch, case, factors):
    """d/b by the compiled solver, with the case's own nodes."""
    monkeypatch.setattr(scan, "NODES", case["numerics"]["nodes_thickness"])
    time_s, columns = recorded(case)
    screen = Screen(case, time_s, columns, "pos")
    pga_g = np.abs(columns["ground"]).max() / 9.80665
    return screen.run(pga_g * np.array(factors), scatter=False)["d_over_b"].to_numpy()


@pytest.mark.parametrize("rule", ["top", "middle", "interpolated"])
@pytest.mark.parametrize("model", ["W1", "W2", "W2m"])
def test_a_base_on_the_ground_is_the_whole_facade(model, rule):
    """To the digit: its scene, and the plane in the frame of the ground."""
    whole, stated = (
        build_scene(part(model, facade, rule))
        for facade in ({}, {"base_height_m": 0.0, "building_height_m": 6.48})
    )
    assert to_json(stated) == to_json(whole)
    if model == "W2":
        one, other = to_plane(whole), to_plane(whole, "ground")
        for own, same in zip(one[:-1], other[:-1], strict=True):
            assert np.array_equal(own, same)


@pytest.mark.parametrize("rule", ["top", "middle", "interpolated"])
@pytest.mark.parametrize("raised_m", [1.0, 2.5, 4.0])
def test_base_and_chain_by_two_routes(raised_m, rule):
    """What moves as rigid ties would have it: K and C of the scene are those of the plane.

    The scene's base and panels follow the masses by height; then no tie strains, and what is left
    is the plane's three freedoms and the masses. Their mass is the building's.
    """
    two_routes(part("W2m", {"base_height_m": raised_m, "height_m": 4.0}, rule), rule)


def test_pieces_on_the_chain_by_two_routes():
    """The same of two pieces, whose anchors hold to a mass of the chain."""
    two_routes(part("W2m", KINDS["bending"]), "top")


def two_routes(case, rule):
    """Hold K, C and the mass of a scene of W2m against those of its plane."""
    scene = build_scene(case)
    equation, found = free_dofs(scene), assemble(scene)
    n, facade = case["smdof"]["n_dof"], case["facade"]
    raised = facade["base_height_m"]
    whole = facade["building_height_m"] or raised + facade["height_m"]
    levels = whole / n * np.arange(n + 1) - raised
    own_dofs = 3 * sum(block.name.startswith("façade") for block in scene.blocks)

    def weights(z):
        return np.array([np.interp(z, levels, row) for row in np.eye(n + 1)[1:]])

    moves = np.zeros((equation.max() + 1, own_dofs + n))
    for block, numbers in zip(scene.blocks, equation, strict=True):
        z, y = block.centre_m[2], numbers[1]
        if block.name.startswith("façade"):
            at = numbers[[1, 2, 3]]
            moves[at, at - equation[1, 1]] = 1.0  # the first ones
        elif "panel" in block.name:
            tall = levels[1] - levels[0]
            ends = weights(z - 0.5 * tall), weights(z + 0.5 * tall)
            moves[y, own_dofs:] = 0.5 * (ends[0] + ends[1])
            moves[numbers[3], own_dofs:] = (ends[0] - ends[1]) / tall  # the top moves inward
        elif block.name == "base":
            moves[y, own_dofs:] = weights(0.0)
        elif block.free:
            number = int(block.name.split()[-1])
            piece = block.name.startswith("return wall") and rule == "interpolated"
            own = weights(z) if piece else np.eye(n)[number - 1]
            if rule == "middle" and not block.name.startswith("mass"):
                own = 0.5 * (own + (np.eye(n)[number - 2] if number > 1 else 0.0))
            moves[y, own_dofs:] = own
    one_way = build_scene({**case, "model": "W2"})
    plane, chain = to_plane(one_way, "ground"), carried_masses(case, one_way)
    of_plane = matrices if own_dofs == 3 else stack_matrices
    k, c = of_plane(plane, len(chain.hang))[1:3]
    size = own_dofs + len(chain.hang)
    hang = np.zeros((size, own_dofs + n))
    hang[:own_dofs, :own_dofs], hang[own_dofs:, own_dofs:] = np.eye(own_dofs), chain.hang
    for own, other, carried in zip(
        (k, c), found.dense(), (chain.k_n_m, chain.c_n_s_m), strict=True
    ):
        own = hang.T @ own[:size, :size] @ hang
        own[own_dofs:, own_dofs:] += carried
        assert moves.T @ other @ moves == pytest.approx(own, rel=1e-6, abs=1e-9 * own.max())
    assert plane.foot == 0
    mass = moves.T @ np.diag(found.mass) @ moves
    assert mass[own_dofs:, own_dofs:].sum() == pytest.approx(
        MASS_KG, rel=0.02
    )  # what hangs by the ground too


def by_both(monkeypatch, case, factors):
    """Hold peaks of a case in YADE against the compiled solver's, which have to repeat."""
    found = planar(monkeypatch, case, [f * e for f in factors for e in (1.0, 1.0001)])
    assert found[1::2] == pytest.approx(found[::2], rel=0.003)
    time_s, columns = recorded(case)
    got = in_yade(
        "twoway_cases",
        "shaken",
        config={key: case[key] for key in case if key not in ("model", "beta_s")},
        runs=[(case["model"], MASS_KG, factor) for factor in factors],
        time_s=time_s.tolist(),
        columns={name: row.tolist() for name, row in columns.items()},
    )
    assert {run["status"] for run in got} == {"ok"}
    assert [run["peak"] for run in got] == pytest.approx(found[::2], rel=0.01)
    assert found[2] > 0.05
    assert case["beta_s"] == BETA_S  # that of `twoway_cases`


SHAKEN = {  # factors on the record at which histories repeat, and YADE's step
    ("before walls", "W2"): ([0.3, 0.5], 0.05),
    ("before walls", "W2m"): ([0.3, 0.5], 0.1),
    ("gable", "W2"): ([0.5, 1.0], 0.1),
    ("gable", "W2m"): ([0.5, 1.0], 0.1),
    ("bending", "W1"): ([0.5, 1.0], 0.1),
    ("bending", "W2"): ([0.5, 1.0], 0.1),
    ("bending", "W2m"): ([0.5, 1.0], 0.1),
    ("leaning", "W1"): ([1.0, 2.0], 0.1),
    ("leaning", "W2m"): ([0.5, 1.0], 0.1),
}


@pytest.mark.yade
@pytest.mark.slow
@pytest.mark.parametrize(("kind", "model"), SHAKEN)
def test_yade_and_the_compiled_solver(monkeypatch, kind, model):
    """Peaks within 1 % of each other under a recorded motion, where they repeat."""
    factors, step = SHAKEN[kind, model]
    nodes = 17 if kind == "leaning" else 5  # a course's joint is a line in the compiled solver
    case = part(model, KINDS[kind], step_fraction=step, nodes_thickness=nodes)
    by_both(monkeypatch, case, factors)


@pytest.mark.yade
@pytest.mark.parametrize("kind", KINDS)
def test_energy_closes_on_the_chain(kind):
    """YADE's books of W2m, base, panels and pieces in them: less than 2e-3 of what overturns it.

    From where the record begins to shake.
    """
    case = part("W2m", KINDS[kind])
    time_s, columns = recorded(case)
    first, last = np.searchsorted(time_s, [1.5, 2.5])
    factor = 0.6 if kind == "before walls" else 1.0
    got = in_yade(
        "accuracy_cases",
        "balanced",
        config={key: case[key] for key in case if key not in ("model", "beta_s")},
        model="W2m",
        beta_s=BETA_S,
        time_s=(time_s[first:last] - time_s[first]).tolist(),
        columns={"ground": (factor * columns["ground"][first:last]).tolist()},
        fraction=0.1 if kind == "bending" else 0.2,
    )
    assert got["status"] == "ok"
    assert got["peak"] > 0.1
    assert got["residual"] < 2e-3 * got["overturning"]


def taken(case, masses_m, masses_m_s, moving_kg, ground):
    """Force that the storeys of a chain take, and the frame that moves with the ground [N]."""
    _, k, c = chain_matrices(case["smdof"], MASS_KG)
    return (masses_m @ k + masses_m_s @ c).sum(axis=1) + moving_kg * ground


@pytest.mark.parametrize("kind", ["before walls", "gable"])
def test_impulse_on_part_and_chain_in_the_plane(kind):
    """What the façade is pushed by is what the masses are pushed back by, at every step, to 0.2 %.

    The one from the contact forces, the other from the masses' motion by their own equation;
    both as the scheme adds them, over whole steps and half of the first.
    """
    case = part("W2m", KINDS[kind])
    time_s, columns = recorded(case)
    screen = Screen(case, time_s, columns, "pos")
    motions = screen.motions
    h = history(
        screen.planes[0],
        motions,
        case["numerics"],
        0.7,
        carried=screen.carried,
        step_s=0.5 * screen.steps_s[0],
        sample_s=0.0,
    )
    step = np.full(h.time_s.size - 1, h.step_s)
    step[0] *= 0.5
    part_ns = np.cumsum(step * h.contact[:-1, 0])
    ground = 0.7 * np.interp(h.time_s, time_s, columns["ground"], right=0.0)
    each = MASS_KG / case["smdof"]["n_dof"]
    momentum = each * np.diff(h.supports_m, axis=0).sum(axis=1) / h.step_s
    force = taken(case, h.supports_m, h.supports_m_s, MASS_KG, ground)[:-1]
    chain_ns = momentum + np.cumsum(step * force)
    assert h.peak_d_over_b > 0.05
    assert np.abs(part_ns + chain_ns).max() < 2e-3 * np.abs(part_ns).max()


def so_far(time_s, force):
    """Impulse of a force up to each instant."""
    mean = 0.5 * np.diff(time_s) * (force[1:] + force[:-1])
    return np.concatenate(([0.0], np.cumsum(mean)))


@pytest.mark.yade
@pytest.mark.parametrize("kind", ["before walls", "gable"])
def test_impulse_on_part_and_chain_in_yade(kind):
    """The same from all blocks' momenta: the façade's, and the chain's with base and panel."""
    case = part("W2m", KINDS[kind])
    time_s, columns = recorded(case)
    last = np.searchsorted(time_s, 6.0)
    ground = 0.7 * columns["ground"][:last]
    got = in_yade(
        "twoway_cases",
        "momenta",
        config={key: case[key] for key in case if key not in ("model", "beta_s")},
        model="W2m",
        time_s=time_s[:last].tolist(),
        ground=ground.tolist(),
        stride=2,
    )
    rows, mass, names = np.array(got["rows"]), np.array(got["mass_kg"]), got["names"]
    count, half = len(names), 0.25 * (rows[1, 0] - rows[0, 0])
    t, rate = rows[:, 0] - half, rows[:, 1 + count :]  # velocities live half a step back
    place = rows[:, 1 : 1 + count] - half * rate
    own = names.index("façade")
    at = sorted(
        (i for i, name in enumerate(names) if name.split()[-1].isdigit()),
        key=lambda i: int(names[i].split()[-1]),
    )
    assert len(at) == case["smdof"]["n_dof"]
    rest = [i for i in range(count) if i != own]
    pull = np.interp(t, time_s[:last], ground)
    part_ns = mass[own] * (rate[:, own] - rate[0, own] + so_far(t, pull))
    momentum = rate[:, rest] @ mass[rest]
    force = taken(case, place[:, at], rate[:, at], mass[rest].sum(), pull)
    chain_ns = momentum - momentum[0] + so_far(t, force)
    assert got["peak"] > 0.05
    assert np.abs(part_ns + chain_ns).max() < 2e-3 * np.abs(part_ns).max()


def test_what_a_free_standing_part_hangs_on():
    """A gable at the very top of its building stands on the highest mass; anchors hold it to that.

    Without walls behind it every mass of the chain is a block by itself.
    """
    top = {
        **KINDS["gable"],
        "building_height_m": 6.0,
        "floors": [{"height_m": 1.0, "anchor_kn": 5}],
    }
    scene = build_scene(part("W2m", top))
    names = [block.name for block in scene.blocks]
    assert names == ["ground", "façade", "base", *(f"mass {j}" for j in range(1, 5))]
    assert {(tie.a, tie.b) for tie in scene.ties} == {(1, names.index("base"))}
    tie = scene.joints.index("base tie")
    (node,) = np.flatnonzero(scene.nodes.joint == tie)
    assert (scene.nodes.a[node], scene.nodes.b[node]) == (2, names.index("mass 4"))
    driven = build_scene(part("W2", top))
    assert driven.motions == ["floor4"]


@pytest.mark.parametrize(
    ("models", "facade", "message"),
    [
        (["W2"], {"sides": "two"}, r"models = .*W2.*expected \[W1\]"),
        (["W2c"], {"sides": "two", "base_height_m": 6.0}, "W2c.*expected.*W1.*W2.*W2m"),
        (["W1"], {"building_height_m": 6.0}, "building_height_m = 6: expected at least.*6.48"),
        (["W1"], {**KINDS["gable"], "building_height_m": 5.0}, "at least facade.base_height_m = 6"),
        (["W3"], {"building_height_m": 9.0}, "W3: expected a façade of one block"),
        (["W1"], {"outline": "triangle"}, "outline = triangle: expected facade.sides = two"),
        (["W1"], {**KINDS["gable"], "gable_height_m": 1.0}, "gable_height_m = 1: expected none"),
    ],
)
def test_impossible_parts(models, facade, message):
    """One line with key, value and what was expected."""
    with pytest.raises(ConfigError, match=message):
        resolved(facade=facade, models=models, damping={"law": "value", "beta_s": BETA_S})
