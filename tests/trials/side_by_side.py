"""Amplitudes side by side against one after the other, for façades, motions and lists at random.

    .venv/bin/python tests/trials/side_by_side.py --first 25 --count 600

What is drawn: models, façades, nodes and strengths; a window of a recorded motion of the suite, one
after a long rest or repeated, a few samples, a single pulse, samples at odd or uneven times, 200 s,
or nothing; unsorted amplitudes with equal ones, zero, tiny and huge ones among them, in numbers
that fill lanes or do not; steps from 0.08 to 40 of the stable one, strict and loose rules. Every
column of the outcomes is compared bit by bit. 600 take two minutes of processor time.
"""

import argparse
import math
from pathlib import Path
from unittest import mock

import numpy as np
from rocking.collapse.scan import carried_masses, driving
from rocking.configuration import config
from rocking.configuration.study import as_in_the_study
from rocking.records import load, read_table
from rocking.solver import Motions, peaks, runs, stable_step, to_plane
from rocking.solver.stack import Stack

from smdof import floor_motions, shear_chain
from yade_scripts.model import registry
from yade_scripts.model.models import build_scene

SUITE = Path(__file__).resolve().parents[2] / "config/suites/recorded_suite.tsv"
COLUMNS = ("factor", "d_over_b", "overturned", "failed", "end_s")
MODELS = dict(W1=0.15, W2=0.15, W1c=0.15, W2c=0.15, W3=0.14, W2m=0.16, W2cm=0.07, W3m=0.03)
MOTIONS = ("window",) * 5 + ("rest", "again", "few", "pulse", "odd", "uneven", "nothing", "long")
SIZES = (1, 2, 3, 7, 8, 9, 16, 17, 64, 65, 70)
ODD = (0.0, -0.0, 1e-12, 1e3, -1e6, 1e150)
STEPS = (0.08, 0.3, 0.5, 0.9, 2.0, 6.0, 40.0)


def drawn_facade(draw, model):
    """Section facade; W3 has bricks of whole courses and no openings."""
    height = 0.6 * int(draw.integers(5, 16))
    own = {
        "height_m": height,
        "thickness_m": float(draw.uniform(0.2, 0.8)),
        "width_m": float(draw.uniform(2.0, 8.0)),
        "friction_deg": float(draw.choice([0.0, 1.0, 10.0, 20.0, 30.0, 45.0])),
        "shear_stiffness_ratio": float(draw.choice([0.05, 0.33, 1.0])),
        "e_mpa": float(10.0 ** draw.uniform(1.7, 3.7)),
    }
    some = [("tilt_deg", 0.5), ("gap_m", 5e-3), ("base_stiffness_pa_m", 1e9)]
    if not model.startswith("W3"):
        hole = {"z_m": 0.3 * height, "width_m": 0.9, "height_m": 0.2 * height}
        some += [("base", "column"), ("parapet_height_m", 0.8), ("openings", [hole])]
        some += [("thickness_steps", [{"z_m": 0.5 * height, "thickness_m": 0.2}])]
        some += [("ties", [{"height_m": 0.9 * height}]), ("sides", "two")]
        some += [("floors", [{"height_m": 0.7 * height, "load_kn": 20.0, "anchor_kn": 5.0}])]
    if model in ("W1", "W2", "W2m"):
        some += [("courses", int(draw.integers(2, 9)))] * 4
    return own | {key: value for key, value in some if draw.random() < 0.1}


def drawn_case(draw):
    """A case that the configuration allows."""
    model = str(draw.choice(list(MODELS), p=list(MODELS.values())))
    while True:
        keys = ("nodes_thickness", "nodes_height", "nodes_per_block")
        wall = {"cohesion_mpa": float(draw.choice([0.0, 0.01, 0.1])), "building_mass_kg": 6e4}
        wall["tension_mpa"] = float(draw.choice([0.0, 0.005, 0.07]))
        bricks = {"course_height_m": 0.6, "lower_courses": int(draw.integers(0, 5))}
        bricks["header_joint"] = str(draw.choice(["rigid", "bonded", "sliding", "hinged", "study"]))
        sections = {
            "facade": drawn_facade(draw, model),
            "numerics": {key: int(draw.choice([3, 4, 5, 9, 17])) for key in keys},
            "return_wall": wall,
            "w3": bricks,
        }
        sections["numerics"]["step_fraction"] = 0.05
        try:
            case = config.resolve(as_in_the_study(sections)) | {"model": model}
            case["beta_s"] = float(draw.choice([0.0, 1e-4, 2.76e-3]))
            kind = registry.model(model)  # what carries one block's walls is beside its scene
            own = {"model": kind.one_way_model} if kind.single_block else {}
            return case, build_scene(case | own)
        except ValueError:  # an opening beside a step, a gap below ties …
            continue


def drawn_ground(draw, kind):
    """Acceleration of the ground, and its times."""
    if kind in ("window", "rest", "again"):
        record = load(str(draw.choice(list(read_table(SUITE)))), SUITE)
        ground, step = np.asarray(record.acceleration_m_s2, float), record.dt_s
        count = int(draw.uniform(1.5, 9.0) / step)
        begin = max(0, int(np.argmax(np.abs(ground))) - count // 2)
        ground = ground[begin : begin + count]
        if kind == "rest":
            ground = np.concatenate([np.zeros(int(20.0 / step)), ground])
        if kind == "again":
            ground = np.concatenate([ground, np.zeros(int(3.0 / step)), ground[::-1]])
        return ground, step * np.arange(ground.size)
    if kind == "few":
        return draw.normal(0.0, 3.0, 4), 0.05 * np.arange(4.0)
    if kind == "pulse":
        return draw.uniform(-60.0, 60.0) * (np.arange(200) == 70), 0.01 * np.arange(200.0)
    if kind == "uneven":
        return draw.normal(0.0, 2.5, 300), np.cumsum(draw.uniform(1e-3, 3e-2, 300))
    if kind == "long":
        time = 0.02 * np.arange(1e4)
        swell = 2.0 * np.sin(0.7 * math.tau * time) * np.sin(math.tau * time / 200.0) ** 8
        return swell + draw.normal(0.0, 0.05, time.size), time
    size = 3.0 if kind == "odd" else 0.0
    return draw.normal(0.0, size, 300), 0.01 * math.pi / 3.0 * np.arange(300.0)


def drawn_motions(draw, kind, case, scene):
    """`Motions` of ground and walls, by the chain where times are even."""
    (ground, time), chain = drawn_ground(draw, kind), case["smdof"]
    floors = ground + draw.normal(0.0, 1.0, (chain["n_dof"], ground.size)) * (kind == "uneven")
    if kind in ("window", "rest", "again", "long", "odd"):
        shaken = floor_motions(ground, time[1], shear_chain(chain["n_dof"], chain["period_s"]))
        whole = len(shaken.time_s) // int(draw.integers(1, 3))  # may end while the floors move
        time, ground = shaken.time_s[:whole], shaken.ground_m_s2[:whole]
        floors = shaken.floors_m_s2[:, :whole]
    columns = {"ground": ground} | {f"floor{j}": row for j, row in enumerate(floors, 1)}
    if draw.random() < 0.4:
        columns["vertical"] = draw.choice([0.3, 1.0, 4.0]) * np.roll(ground, 7)
    if case["model"].endswith("m"):
        return Motions(time, ground, (), columns.get("vertical"))
    return driving(scene, time, columns)


def drawn(seed, seconds=2.0, kinds=MOTIONS):
    """What `peaks` takes; lists of amplitudes that would take longer than `seconds` are shorter."""
    draw = np.random.default_rng(seed)
    case, scene = drawn_case(draw)
    motions = drawn_motions(draw, str(draw.choice(kinds)), case, scene)
    plane, carried = to_plane(scene), None
    kind = registry.model(case["model"])
    if kind.two_way and kind.single_block:  # bricks have their masses in the scene
        carried = carried_masses(case, scene)
    numerics = {**case["numerics"], "after_motion_s": float(draw.choice([0.0, 0.5, 3.0]))}
    for key, values in (("max_speed_ratio", [0.1, 1.0]), ("overturn_ratio", [0.05, 3.0])):
        if draw.random() < 0.15:
            numerics[key] = float(draw.choice(values))
    share = float(draw.choice(STEPS, p=[0.2, 0.25, 0.25, 0.1, 0.08, 0.06, 0.06]))
    step = share * (stable_step(plane, carried) if carried else stable_step(plane))
    each = 3e-7 if not isinstance(plane, Stack) else 6e-8 * max(len(plane.kn_n_m), 20)
    each *= (motions.time_s[-1] + numerics["after_motion_s"]) / step
    size = int(draw.choice([n for n in SIZES if n * each < seconds] or [3]))
    factors = draw.choice([-1.0, 1.0], size) * np.exp(draw.uniform(-4.0, 1.4, size))
    for odd in (*ODD, factors[0]):
        if draw.random() < 0.15:
            factors[int(draw.integers(0, size))] = odd
    return (plane, motions, numerics, factors), {"carried": carried, "step_s": step}


def differing(given, options):
    """Columns in which the two ways differ, and the outcomes one after the other."""
    with np.errstate(all="ignore"):
        many = peaks(*given, **options)
        with mock.patch.object(runs, "_beside", return_value=False):
            one = peaks(*given, **options)
    pairs = [(name, getattr(one, name), getattr(many, name)) for name in COLUMNS]
    return [n for n, a, b in pairs if a.dtype != b.dtype or a.tobytes() != b.tobytes()], one


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--first", type=int, default=0, help="the first seed")
    parser.add_argument("--count", type=int, default=600)
    args = parser.parse_args()
    beside = histories = fell = failed = wrong = 0
    for seed in range(args.first, args.first + args.count):
        given, options = drawn(seed)
        names, one = differing(given, options)
        if one.factor.size > 2:
            beside, histories = beside + 1, histories + one.factor.size
            fell, failed = fell + one.overturned.sum(), failed + one.failed.sum()
        if names:
            wrong += 1
            print(f"seed {seed}: {', '.join(names)} differ", flush=True)
    print(
        f"{args.count} lists, {beside} of them side by side with {histories} histories "
        f"({fell} overturned, {failed} failed): {wrong} lists differ"
    )


if __name__ == "__main__":
    main()
