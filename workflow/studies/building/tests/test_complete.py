"""The complete building: its scene, its linear answer, its limits, and its curve."""

import json
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from studies.building.case import real_brick
from studies.building.complete import complete_building, critical_step, linear_history, plan_of
from studies.building.model import assembly
from studies.building.model.contacts import Joints
from studies.building.modes import Solver
from studies.building.yade.complete import apart, behind, with_rigid_floors
from yade_process import in_yade, resolved, run_study

from yade_scripts.commands.search import next_level
from yade_scripts.model import floor_motions, stiffness
from yade_scripts.model.building.plan import Opening, Plan, PlanError, PlanWall, TimberFloor
from yade_scripts.model.facade import facade_scene
from yade_scripts.model.return_walls import back_jkn
from yade_scripts.model.scene import from_dict, to_json

BETA_S = 5e-4
HEIGHT_M, THICKNESS_M = 1.44, 0.12
T = np.arange(0.0, 1.2, 0.01)


def small(**walls):
    """Two return walls and a façade before them, one floor."""
    sides = tuple(
        PlanWall(name, (x, 0.0), (x, 1.2), 0.12, HEIGHT_M, **walls)
        for name, x in (("left", 0.06), ("right", 1.14))
    )
    front = PlanWall("front", (0.0, 1.14), (1.2, 1.14), 0.12, HEIGHT_M, facade=True)
    floor = TimberFloor(
        "roof", 1.2, ("left", "right"), (0.2, 1.0), bearing_m=0.06, load_kg_m2=200.0
    )
    return Plan("small", (*sides, front), (floor,))


def config(**sections):
    facade = {"height_m": HEIGHT_M, "thickness_m": THICKNESS_M, "width_m": 1.2, "e_mpa": 300.0}
    return resolved(
        facade={**facade, **sections.pop("facade", {})},
        return_wall={"thickness_m": 0.12, **sections.pop("return_wall", {})},
        building={"coarsening": 4.0, **sections.pop("building", {})},
        complete={"coarsening": 4.0, **sections.pop("complete", {})},
        numerics={"nodes_thickness": 5, "after_motion_s": 0.1, **sections.pop("numerics", {})},
        **sections,
    )


def scene_of(model, settings=None, **how):
    return complete_building(settings or config(), small(), None, model, BETA_S, **how)


def job(model, settings=None, scene=None):
    settings = settings or config()
    own = {**settings["complete"], "max_pga_g": 3.0}
    numerics = {
        **settings["numerics"],
        **{k: own[k] for k in ("step_fraction", "sample_interval_s")},
    }
    scene = json.loads(to_json(scene or scene_of(model, settings)))
    return {"model": model, "scene": scene, "numerics": numerics, "complete": own}


def pulses():
    """Ground acceleration of a peak of 1 m/s², at rest at both ends."""
    ground = np.where(T < 0.8, np.sin(2 * np.pi * T / 0.4), 0.0)
    ground[0] = ground[-1] = 0.0
    return ground / np.abs(ground).max()


# --- scene ------------------------------------------------------------------------------------


def test_walls_end_at_the_crack_whichever_way_they_are_drawn():
    plan = small(openings=(Opening("door", 0.3, 0.3, 0.0, 0.6),))
    left, crack = behind(plan)
    assert crack == pytest.approx(1.08)
    assert [w.name for w in left.walls] == ["left", "right"]
    assert all(w.length_m == pytest.approx(1.08) for w in left.walls)
    turned = [
        replace(
            w, start_m=w.end_m, end_m=w.start_m, openings=(Opening("door", 0.6, 0.3, 0.0, 0.6),)
        )
        if w.axis == 1
        else w
        for w in plan.walls
    ]
    other, _ = behind(replace(plan, walls=tuple(turned)))
    for one, two in zip(left.walls, other.walls, strict=True):
        assert one.span(one.openings[0]) == pytest.approx(two.span(two.openings[0]))
        assert one.origin_m == two.origin_m


def test_a_plan_without_a_crack_is_refused():
    sides = tuple(w for w in small().walls if not w.facade)
    with pytest.raises(PlanError, match="facade: true"):
        behind(Plan("sides", sides))
    with pytest.raises(PlanError, match="no wall along y meets"):
        behind(
            Plan("front", (*(replace(w, end_m=(w.offset_m, 0.9)) for w in sides), small().walls[2]))
        )
    window = (Opening("window", 0.9, 0.25, 0.5, 0.4),)
    with pytest.raises(PlanError, match="window' lies across the crack"):
        behind(small(openings=window))


def test_three_points_have_the_moments_of_the_rectangle():
    u, v = assembly.POINTS.T
    assert np.abs(assembly.POINTS).max() < 1.0
    assert [u.mean(), v.mean(), (u * v).mean()] == pytest.approx([0.0] * 3, abs=1e-15)
    assert [(u * u).mean(), (v * v).mean()] == pytest.approx([1.0 / 3.0] * 2)


def test_back_joint_is_the_half_brick_s_stiffness_and_its_dashpots_are_the_other_models():
    """Σ kn is 2E/s·A of the half bricks; Σ βkn is β·E/L·A."""
    scene = scene_of("CB")
    nodes = scene.nodes
    at = nodes.b == scene.index("façade")
    area = 2 * 0.12 * HEIGHT_M
    assert nodes.area_m2[at].sum() == pytest.approx(area)
    e_l = 300e6 / (0.5 * HEIGHT_M)
    assert (nodes.beta_s * nodes.kn_n_m)[at].sum() == pytest.approx(BETA_S * e_l * area)
    length = np.array([scene.blocks[i].size_m[1] for i in nodes.a[at]])
    modulus = Joints().moduli(real_brick(config()["building"]))[0, 0]
    assert nodes.kn_n_m[at] == pytest.approx(2.0 * modulus / length * nodes.area_m2[at])


def test_bonded_form_has_the_strengths_and_the_rest_never_breaks():
    settings = config(return_wall={"tension_mpa": 0.1, "cohesion_mpa": 0.07})
    scene = scene_of("CBc", settings)
    nodes = scene.nodes
    at = nodes.b == scene.index("façade")
    assert np.array_equal(nodes.bonded, at)
    assert nodes.tension_n[at].sum() == pytest.approx(0.1e6 * nodes.area_m2[at].sum())
    assert nodes.cohesion_n[at].sum() == pytest.approx(0.07e6 * nodes.area_m2[at].sum())
    base = nodes.a == scene.index("façade")
    assert np.array_equal(nodes.welded, ~(at | base))
    assert not scene_of("CB").nodes.bonded.any()


def test_rigid_floors_keep_mass_inertia_and_period():
    left, _ = behind(small())
    building = assembly.build(left, coarsening=4.0)
    joined = with_rigid_floors(building)
    count = building.floors[0][1]
    assert len(joined.blocks) == len(building.scene.blocks) - count
    # a rigid motion of the floor has the same kinetic energy: K of the rest is untouched
    mass, expected = (sum(b.mass_kg for b in s.blocks if b.free) for s in (joined, building.scene))
    assert mass == pytest.approx(expected)
    one, two = (Solver(s).modes(6) for s in (building.scene, joined))
    assert two.period_s[one.largest("y")] == pytest.approx(one.period_s[one.largest("y")], rel=0.01)
    rigid = [m.effective_ratio.sum(axis=0) for m in (one, two)]
    assert rigid[0][:2] == pytest.approx(rigid[1][:2], rel=0.02)


def test_sparse_critical_step_is_the_dense_one():
    scene = scene_of("CB")
    assert critical_step(scene) == pytest.approx(stiffness.critical_step(scene), rel=1e-3)
    assert scene.notes["critical_step_s"] == critical_step(scene)


def test_dashpots_shorten_the_sparse_critical_step_as_the_dense_one():
    """Lanczos against the dense criterion on a façade, up to dashpots that govern the step."""
    for beta_s in (0.0, 0.0005, 0.02):
        scene = facade_scene(resolved(), "W1", beta_s)
        assert critical_step(scene) == pytest.approx(stiffness.critical_step(scene), rel=1e-3)


def test_drag_damps_translations_alone():
    """C of the building alone is rate·m on translations: modal ratios a/(2ω) without rotations."""
    scene = apart(scene_of("CB"))
    triplets = stiffness.assemble(scene)
    diagonal = np.zeros(len(triplets.mass))
    own = triplets.rows == triplets.cols
    np.add.at(diagonal, triplets.rows[own], triplets.c[own])
    facade = scene.index("façade")
    behind_crack = triplets.dof[:, 0] != facade
    rate = scene.notes["rate_1_s"]
    expected = np.where(triplets.dof[:, 1] < 3, rate * triplets.mass, 0.0)
    assert diagonal[behind_crack] == pytest.approx(expected[behind_crack])


def test_a_scene_is_read_as_it_was_written():
    scene = scene_of("CBc")
    assert to_json(from_dict(json.loads(to_json(scene)))) == to_json(scene)


# --- runs -------------------------------------------------------------------------------------


@pytest.mark.yade
def test_below_uplift_the_bonded_building_is_its_modes():
    """Top floor and façade within 1 % of the modal answer; apart, the top floor.

    A façade alone sways enough for its weight to matter, which the modes leave out.
    """
    work, ground = job("CBc"), 0.05 * pulses()
    scene = from_dict(work["scene"])
    for drop in (False, True):
        used = apart(scene) if drop else scene
        got = in_yade(
            "studies.building.tests.complete_cases",
            "shaken",
            job=work,
            time_s=T.tolist(),
            ground=ground.tolist(),
            drop=drop,
        )
        assert got["status"] == "ok", got
        assert got["broken"] == 0
        rows = np.array(got["rows"])
        rows = rows[rows[:, 0] < T[-2]]
        points = [used.index(used.notes["top"]), used.index("façade")][: 1 if drop else 2]
        fine = np.arange(0.0, T[-1], 1e-3)
        time_s, moved = linear_history(used, points, fine, np.interp(fine, T, ground))
        for j, expected in enumerate(moved):
            error = np.abs(rows[:, 1 + j] - np.interp(rows[:, 0], time_s, expected)).max()
            assert error < 0.01 * np.abs(expected).max(), (drop, j)


@pytest.mark.yade
def test_before_stiff_walls_the_facade_rocks_as_w1():
    """Bricks a hundred times stiffer stand still: peak within 3 % of W1's, same nodes and steps.

    The façade meets them through the joint that it has in W1, E/L, in place of the half bricks'.
    """
    stiff = {
        key: 100.0 * value
        for key, value in config()["building"].items()
        if key.endswith(("_jkn_pa_m", "_jks_pa_m"))
    }
    settings = config(building=stiff)
    scene = scene_of("CB", settings)
    nodes, jkn = scene.nodes, back_jkn(settings)
    at = nodes.b == scene.index("façade")
    kn = np.where(at, jkn * nodes.area_m2, nodes.kn_n_m)
    ks = np.where(at, settings["facade"]["shear_stiffness_ratio"] * kn, nodes.ks_n_m)
    beta = np.where(at, BETA_S, nodes.beta_s)
    same = nodes.select(slice(None), kn_n_m=kn, ks_n_m=ks, beta_s=beta)
    scene = replace(scene, nodes=same)
    scene.notes.update(critical_step_s=critical_step(scene))
    got = in_yade(
        "studies.building.tests.complete_cases",
        "beside_w1",
        config={**settings, "beta_s": BETA_S},
        job=job("CB", settings, scene),
        time_s=T.tolist(),
        ground=(1.5 * pulses()).tolist(),
    )
    assert [got[k]["status"] for k in ("CB", "W1")] == ["ok", "ok"], got
    assert got["W1"]["peak"] > 0.1
    assert got["CB"]["peak"] == pytest.approx(got["W1"]["peak"], rel=0.03)


@pytest.mark.yade
def test_curve_of_the_bonded_building_separates_and_resumes(tmp_path):
    """Weak bonds: the façade comes off and falls; a second start takes all from the journal."""
    settings = config(
        return_wall={"tension_mpa": 0.002, "cohesion_mpa": 0.002},
        complete={"max_runs": 2, "below": 1, "beyond": 1, "level_ratio": 0.5},
    )
    (tmp_path / "scene.json").write_text(json.dumps(job("CBc", settings)))
    (tmp_path / "plan.json").write_text(json.dumps({"start_g": 0.3, "ranges": []}))
    floor_motions.write(tmp_path / "motion.csv", T, pulses())
    words = ["ida", "--scene", "scene.json", "--motion", "motion.csv", "--record", "pulse"]
    words += ["--direction", "pos", "--plan", "plan.json", "--journal", "j.jsonl"]
    tables = []
    for name in ("one.csv", "two.csv"):
        done = run_study(*words, "--output", name, folder=tmp_path)
        assert done.returncode == 0, done.stderr
        tables.append((tmp_path / name).read_bytes())
        tables.append(done.stderr.count("run "))
    assert tables[0] == tables[2]
    assert tables[1] == 2
    assert tables[3] == 0
    rows = [line.split(",") for line in tables[0].decode().splitlines()[1:]]
    assert [row[6] for row in rows] == ["ok", "overturned"]
    assert len((tmp_path / "j.jsonl").read_text().splitlines()) == 2


# --- levels -----------------------------------------------------------------------------------

SETTINGS = {"level_ratio": 0.05, "below": 2, "beyond": 2, "max_runs": 40, "max_pga_g": 3.0}


def climbed(falls, start_g, ranges=(), **more):
    done = {}
    while (g := next_level(done, {**SETTINGS, **more}, start_g, ranges)) is not None:
        done[g] = "overturned" if falls(g) else "ok"
    return done


@pytest.mark.parametrize("collapse", [0.15, 0.199, 0.2, 0.201, 0.35])
def test_levels_bracket_a_threshold_within_one_ratio(collapse):
    done = climbed(lambda g: g >= collapse, 0.2)
    fell = sorted(g for g, s in done.items() if s == "overturned")
    stood = sorted(g for g, s in done.items() if s == "ok")
    assert fell[0] / stood[-1] < 1.051  # intensities are rounded
    assert len(fell) >= 2
    assert len(stood) >= 2
    assert len(done) < 16


def test_levels_find_a_gap_below_and_a_separate_range():
    """A collapse two levels below the first one found is found too, ranges are looked at."""
    done = climbed(lambda g: 0.198 < g < 0.201 or g > 0.215, 0.22)
    assert min(g for g, s in done.items() if s == "overturned") < 0.201
    done = climbed(lambda g: g > 0.199, 0.2, ranges=(0.203, 0.9))
    assert 0.203 in done
    assert 0.9 not in done


def test_levels_end():
    """At the largest intensity, at the number of runs, and whatever fails."""
    done = climbed(lambda g: False, 0.2, max_pga_g=0.5)
    assert max(done) == 0.5
    assert len(climbed(lambda g: False, 0.2, max_runs=3)) == 3
    done = {}
    while (g := next_level(done, SETTINGS, 0.2)) is not None:
        done[g] = "failed"
    assert max(done) == 3.0


def test_a_curve_begins_inside_the_first_range_of_the_scan():
    """The gap between two ranges and the second are looked at too; without a collapse, the end."""
    pga = 0.1 * 1.01 ** np.arange(120)
    fell = ((pga > 0.15) & (pga < 0.18)) | (pga > 0.2)

    def planned(fallen):
        status = np.where(fallen, "overturned", "ok")
        scan = {"pga_g": pga, "collapsed": fallen.astype(int), "status": status}
        return plan_of(pd.DataFrame(scan), spread=0.01, step=0.05, most=4)

    plan = planned(fell)
    assert plan["start_g"] == pytest.approx(1.05 * pga[pga > 0.15][0], abs=1e-3)
    assert plan["ranges"] == pytest.approx([0.19, 0.5 * (0.2 + pga[-1])], abs=0.004)
    assert planned(0 * fell) == {"start_g": pytest.approx(pga[-1], abs=1e-4), "ranges": []}
