"""Histories side by side, of one motion or many: the digits of one after the other."""

import numpy as np
import pytest
from numba import njit
from rocking.solver import (
    Motions,
    law,
    moving_supports,
    peaks,
    runs,
    stable_step,
    to_plane,
)
from rocking.solver.vectors import WIDTH, minus, plus, put, take
from yade_process import resolved

from tests.trials.side_by_side import differing
from tests.trials.side_by_side import drawn as drawn_whole
from yade_scripts.model.models import build_scene

WHAT = ("d_over_b", "end_s", "overturned", "failed")


def alone(monkeypatch, *args, **options):
    """`peaks`, one history after the other."""
    with monkeypatch.context() as patched:
        patched.setattr(runs, "_beside", lambda loop, count: False)
        return peaks(*args, **options)


def same(one, other, mine=slice(None)):
    return all(
        np.array_equal(getattr(one, w)[mine], getattr(other, w), equal_nan=True) for w in WHAT
    )


def drawn(seed, model):
    """A façade drawn at random, with motions of its ground, walls and vertical."""
    draw = np.random.default_rng(seed)
    nodes = dict.fromkeys(
        ("nodes_thickness", "nodes_height", "nodes_per_block"), int(draw.integers(2, 12))
    )
    config = resolved(
        numerics=nodes,
        facade={
            "height_m": float(draw.uniform(3.0, 9.0)),
            "thickness_m": float(draw.uniform(0.25, 0.6)),
            "friction_deg": float(draw.choice([3.0, 20.0, 30.0])),
        },
    )
    beta = float(draw.choice([0.0, 3e-4, 2.76e-3]))
    return shaken(draw, {**config, "model": model, "beta_s": beta}, seed % 2)


def shaken(draw, case, lifted):
    """A case's plane and what else `peaks` takes, under motions drawn at random."""
    scene = build_scene(case)
    time = np.arange(0.0, 2.0, 0.01)
    shape = np.sin(np.pi * time / time[-1])
    rows = shape * draw.normal(0.0, 2.0, (2 + len(moving_supports(scene)), time.size))
    slow = shape * 3.0 * np.sin(2.0 * np.pi * draw.uniform(0.5, 1.5) * time)
    motions = Motions(time, rows[0] + slow, rows[2:] + slow, rows[1] * lifted)
    factors = draw.choice([-1.0, 1.0]) * np.geomspace(0.02, 3.0, int(draw.integers(3, 28)))
    return to_plane(scene), motions, case["numerics"], draw.permutation(factors)


def bricks(seed, **w3):
    """W3 with courses of twice the default height."""
    nodes = dict.fromkeys(("nodes_thickness", "nodes_height", "nodes_per_block"), 5)
    config = resolved(w3={"course_height_m": 0.648, **w3}, numerics=nodes)
    draw = np.random.default_rng(seed)
    *given, factors = shaken(draw, {**config, "model": "W3", "beta_s": 2.76e-3}, seed % 2)
    return *given, factors[: WIDTH + 2]


MODELS = ("W1", "W2", "W1c", "W2c")


@pytest.mark.parametrize(("seed", "model"), [(k, MODELS[k // 2 % 4]) for k in range(14)])
def test_every_digit_is_that_of_one_after_the_other(monkeypatch, seed, model):
    given = drawn(seed, model)
    one, many = alone(monkeypatch, *given), peaks(*given)
    assert same(one, many)
    assert np.unique(one.end_s).size > 1  # of unequal length: lanes are filled anew


@pytest.mark.parametrize(
    ("seed", "w3"),
    [
        (0, {}),  # hinged headers: ties
        (1, {"lower_courses": 0}),  # headers leave their slots
        (2, {"header_joint": "sliding"}),
        (3, {"header_joint": "study", "lower_courses": 9, "split_inclination_deg": 5.0}),
    ],
)
def test_every_digit_of_bricks_is_that_of_one_after_the_other(monkeypatch, seed, w3):
    given = bricks(seed, **w3)
    one, many = alone(monkeypatch, *given), peaks(*given)
    assert same(one, many)
    assert one.overturned.any()
    assert np.unique(one.end_s).size > 1


def test_a_header_that_left_its_slot_is_out_in_its_own_history_alone():
    plane, motions, numerics, _ = bricks(1, lower_courses=0)
    factors = np.geomspace(0.002, 0.2, WIDTH)
    kept = plane._replace(debris=np.zeros_like(plane.debris))
    held, left = (peaks(one, motions, numerics, factors) for one in (kept, plane))
    differs = held.end_s != left.end_s
    assert 0 < differs.sum() < WIDTH


def test_the_drawn_facades_stand_and_fall():
    fell = np.concatenate([peaks(*drawn(k, "W1")).overturned for k in range(4)])
    assert 0.1 < fell.mean() < 0.9


def test_neighbours_do_not_matter():
    plane, motions, numerics, _ = drawn(2, "W2")
    factors = np.geomspace(0.05, 2.0, 2 * runs.AT_ONCE + 3)
    whole = peaks(plane, motions, numerics, factors)
    for mine in (slice(5, 8), slice(60, 70), slice(None, None, -1), slice(1, None, 9)):
        assert same(whole, peaks(plane, motions, numerics, factors[mine]), mine)


def test_a_history_that_fails_does_not_spoil_those_beside_it(monkeypatch):
    plane, motions, numerics, _ = drawn(3, "W2")
    factors = np.linspace(0.02, 2.0, 19)
    strict = {**numerics, "max_speed_ratio": 0.3}
    one = alone(monkeypatch, plane, motions, strict, factors)
    many = peaks(plane, motions, strict, factors)
    assert same(one, many)
    assert 0 < many.failed.sum() < factors.size
    assert np.isnan(many.d_over_b[many.failed]).all()
    wild = plane, motions, numerics, [0.0, 0.1, 1.0, 10.0]
    assert same(alone(monkeypatch, *wild, step_s=0.05), peaks(*wild, step_s=0.05))


@pytest.mark.parametrize("seed", range(16))
def test_whatever_is_drawn_keeps_its_digits(seed):
    names, _ = differing(*drawn_whole(seed, 0.2, ("few", "pulse", "odd", "uneven", "nothing")))
    assert not names


@pytest.mark.parametrize("seed", [7001, 7015, 7073, 7105])
def test_courses_of_which_parts_of_joints_go_together_in_some_lanes_keep_their_digits(seed):
    given, options = drawn_whole(seed)
    assert given[0].lines.half_m.size
    names, _ = differing(given, options)
    assert not names


@pytest.mark.parametrize(("seed", "share"), [(1, 0.5), (2, 1.0), (3, 3.0)])
def test_bricks_whose_numbers_ran_over_are_as_by_themselves(monkeypatch, seed, share):
    """No rule ends them before, and forces of 0·∞ do not act on the façade."""
    plane, motions, numerics, _ = bricks(seed)
    loose = {**numerics, "max_speed_ratio": np.inf, "overturn_ratio": np.inf, "after_motion_s": 0.2}
    huge = 10.0 ** np.array([8, 12, 16, 20, 40, 100, 200, 300])
    given = plane, motions, loose, [*huge, 0.3, *-huge, -0.6]
    step = share * stable_step(plane)
    one, many = alone(monkeypatch, *given, step_s=step), peaks(*given, step_s=step)
    assert one.failed.sum() > WIDTH
    assert same(one, many)


@pytest.mark.parametrize(("seed", "model"), [(k, MODELS[k % 4]) for k in range(4, 12)])
def test_motions_of_their_own_keep_the_digits_of_one_after_the_other(monkeypatch, seed, model):
    """As long and as finely sampled as they are; some histories have one and the same."""
    plane, first, numerics, factors = drawn(seed, model)
    draw = np.random.default_rng(seed)
    several = [first]
    for share in (0.4, 0.7, 1.6, 2.3):
        time = share * first.time_s[:-1]
        rows = np.vstack([first.ground_m_s2, first.vertical_m_s2, first.supports_m_s2])[:, :-1]
        rows = rows * draw.uniform(0.3, 1.5) + 0.3 * draw.normal(size=time.size)
        several.append(Motions(time, rows[0], rows[2:], rows[1]))
    motions = [several[k] for k in draw.integers(0, len(several), factors.size)]
    given = plane, motions, numerics, factors
    one, many = alone(monkeypatch, *given), peaks(*given)
    assert same(one, many)
    for motion in several:  # and those of its own motion alone
        mine = [k for k, other in enumerate(motions) if other is motion]
        assert same(many, peaks(plane, motion, numerics, factors[mine]), mine)
    assert np.unique(one.end_s).size > 1


def test_bricks_and_masses_keep_their_digits_under_motions_of_their_own(monkeypatch):
    plane, first, numerics, factors = bricks(0)
    second = Motions(
        0.5 * first.time_s[:-1],
        *(
            2.0 * row[..., :-1]
            for row in (first.ground_m_s2, first.supports_m_s2, first.vertical_m_s2)
        ),
    )
    given = plane, [first, second] * 5, numerics, factors[:10]
    assert same(alone(monkeypatch, *given), peaks(*given))


def test_as_many_motions_as_factors_are_asked_for():
    plane, motions, numerics, _ = drawn(2, "W2")
    with pytest.raises(ValueError, match="3 factors, and 2 motions"):
        peaks(plane, [motions] * 2, numerics, [0.1, 0.2, 0.3])
    one, more = (Motions([0.0, 1.0], [0.0, 1.0], np.zeros((n, 2))) for n in (4, 5))
    with pytest.raises(ValueError, match=r"motions of \[4, 5\] supports side by side"):
        peaks(plane, [one, more] * 2, numerics, np.ones(4))


HELD = {"ties": [{"height_m": 3.0}], "floors": [{"height_m": 3.24, "anchor_kn": 5.0}]}
SUPPORTED = {
    "pieces": {"hinges_m": [3.0]},
    "courses": {"courses": 3},
    "one block": {},
    "pieces, held": {"hinges_m": [3.0], **HELD},
}


@pytest.mark.parametrize("name", SUPPORTED)
def test_every_support_that_a_scene_names_is_asked_for(name):
    """Whatever names it: a node, a group, a bed, a tie or a floor; else a foreign row is read."""
    config = resolved(facade=SUPPORTED[name])
    plane = to_plane(build_scene({**config, "model": "W2", "beta_s": 0.003}))
    with pytest.raises(ValueError, match="4 moving supports, got 3"):
        peaks(plane, Motions([0.0, 1.0], [0.0, 1.0], np.zeros((3, 2))), config["numerics"], 1.0)


def test_no_amplitude_no_history():
    plane, motions, numerics, _ = drawn(2, "W2")
    assert peaks(plane, motions, numerics, []).d_over_b.shape == (0,)


def test_the_law_gives_lanes_the_digits_of_one_number():
    draw = np.random.default_rng(0)
    depth, rate, speed, slip, step = 1e-4 * draw.normal(size=(5, WIDTH)) + 5e-5
    rate, speed = 100.0 * rate, 100.0 * speed
    joint, found = (2.76e-3, 0.33, 0.2), np.zeros((6, WIDTH))

    @njit(error_model="numpy")
    def lanes(values, out):
        was = take(values, 5) > 0.0
        got = law.dry(
            *(take(values, 0), take(values, 1), take(values, 2), take(values, 3), take(values, 4)),
            ~was,
            joint,
            4e-4,
        )
        put(out, 0, got[0])
        put(out, 1, got[1])
        put(out, 2, got[2])
        put(out, 3, got[3])
        put(out, 4, got[6])
        put(out, 5, got[7])

    was = draw.normal(size=WIDTH)
    lanes(np.array([depth, rate, speed, slip, step, was]), found)
    kinds = set()
    for i in range(WIDTH):
        one = law.dry(
            depth[i], rate[i], speed[i], slip[i], step[i], bool(was[i] <= 0.0), joint, 4e-4
        )
        assert [one[k] for k in (0, 1, 2, 3, 6, 7)] == found[:, i].tolist()
        kinds.add(one[4:6])
    assert len(kinds) > 1  # some slide


@pytest.mark.parametrize("shape", [(3,), (3, WIDTH)])
def test_a_product_is_not_rounded_before_it_is_added(shape):
    """1 − 2⁻⁶⁰, the product of 1 + 2⁻³⁰ and 1 − 2⁻³⁰, is 1 once it is rounded."""
    small, values = 2.0**-30, np.zeros(shape)
    values[0], values[1] = 1.0 + small, 1.0 - small

    @njit(error_model="numpy")
    def both(rows):
        one, other = take(rows, 0), take(rows, 1)
        put(rows, 0, minus(1.0, one, other))
        put(rows, 1, plus(-1.0, one, other))

    both(values)
    assert (values[0] == small**2).all()
    assert (values[1] == -(small**2)).all()
