"""W3: geometry and weights of the assembly; joint forces and capacity against statics in YADE."""

import functools
import io

import numpy as np
import pandas as pd
import pytest
from rocking.pushover import closed_form, friction_moment_ratio, joint_forces, theta_of
from yade_process import in_yade, resolved

from yade_scripts.engine.faces import BITS, Faces
from yade_scripts.model import floor_motions, interlocking, models
from yade_scripts.model.stiffness import assemble, critical_step

COURSES = 10
SMALL = dict(course_height_m=0.648, lower_courses=0)  # half as many courses, twice as high
MOTIONS = {name: np.arange(3.0) for name in ("ground", "floor1", "floor2", "floor3", "floor4")}


def job(**w3):
    config = resolved(w3={**SMALL, **w3}, numerics=dict(nodes_thickness=5))
    return {**config, "model": "W3", "beta_s": 0.00276}


def scene_of(**w3):
    return models.build_scene(job(**w3))


def test_masses_are_those_of_the_masonry():
    scene = scene_of()
    facade, w3, wall = (job()[k] for k in ("facade", "w3", "return_wall"))
    bricks = [b for b in scene.blocks if " brick " in b.name]
    headers = [b for b in scene.blocks if " header " in b.name]
    area = facade["density_kg_m3"] * wall["thickness_m"] * facade["height_m"]
    assert np.isclose(sum(b.mass_kg for b in headers), 0.5 * area * w3["overlap_m"])
    rest = area * w3["brick_length_m"] - 0.5 * area * w3["overlap_m"]
    assert np.isclose(sum(b.mass_kg for b in bricks), rest)
    half = scene.blocks[scene.index("façade")].mass_kg
    assert np.isclose(half, 0.5 * area / wall["thickness_m"] * 0.375 * facade["width_m"])


def test_inertia_of_an_angled_brick_by_quadrature():
    """Brick and the half brick on its rear, integrated over a fine grid."""
    scene = scene_of()
    brick = next(b for b in scene.blocks if b.name == "wall brick 1")
    y, z = np.meshgrid(-(np.arange(400) + 0.5) / 400 * 0.25, (np.arange(400) + 0.5) / 400 * 1.296)
    solid = (z < 0.648) | (y < -0.125)
    dm = brick.mass_kg / solid.sum()
    centre = np.array([y[solid].mean(), z[solid].mean()])
    assert np.allclose(centre, brick.centre_m[1:], atol=1e-3)
    about_x = dm * ((y[solid] - centre[0]) ** 2 + (z[solid] - centre[1]) ** 2).sum()
    assert np.isclose(about_x, brick.inertia_kg_m2[0], rtol=2e-3)


def test_motion_between_floors_is_linear_in_height():
    data = job()
    data["return_wall"]["motion"] = "interpolated"
    scene = models.build_scene(data)
    columns = {name: np.full(3, float(i)) for i, name in enumerate(MOTIONS)}
    found = floor_motions.motion_columns(scene, columns)
    assert scene.notes["motions"]
    for name in scene.notes["motions"]:
        z = float(name.split()[1])
        assert np.allclose(found[name], z / (6.48 / 4)), name
    with pytest.raises(ValueError, match="floor4"):
        floor_motions.motion_columns(scene, {k: v for k, v in columns.items() if k != "floor4"})


@pytest.mark.parametrize(
    ("change", "word"),
    [
        ({"course_height_m": 0.5}, "course_height_m"),
        ({"overlap_m": 0.25}, "overlap_m"),
        ({"header_joint": "glued"}, "header_joint"),
    ],
)
def test_impossible_geometry_is_refused_by_key(change, word):
    data = job()
    data["w3"] = {**data["w3"], **change}
    with pytest.raises(ValueError, match=word) as error:
        interlocking.interlocking_scene(data, 0.00276)
    assert "\n" not in str(error.value)


def test_half_model_has_half_of_every_matrix():
    """By symmetry: half the mass and stiffness, hence the same critical step."""
    half, full = scene_of(), scene_of(half_model=False)
    assert np.isclose(critical_step(half), critical_step(full), rtol=1e-6)
    facade = [assemble(s) for s in (half, full)]
    k = [m.dense()[0][:3, :3] for m in facade]  # the façade's own freedoms come first
    assert np.allclose(2.0 * k[0], k[1])


def test_faces_that_share_a_mask_bit_never_meet():
    """20 courses twice: more faces than bits. No node of one face comes near another's box."""
    data = job(half_model=False, course_height_m=0.324)
    scene = interlocking.interlocking_scene(data, 0.00276)
    faces = Faces(scene)
    assert len(faces.nodes_of) > BITS
    assert len(set(faces.bit.values())) <= BITS
    position = scene.nodes.position_m
    for key, nodes in faces.nodes_of.items():
        centre, half, axes = faces.shape(key, 0.0)
        for other, others in faces.nodes_of.items():
            if other == key or faces.bit[other] != faces.bit[key]:
                continue
            outside = np.abs((position[others] - centre) @ axes) - half
            assert (outside.max(axis=1) > 0.2).all()
        assert len(nodes)


# In YADE: few courses and a short, quick push, since only statics is asked for.


@functools.cache
def pushed(rule, overlap_m=0.125, half=True):
    data = job(header_joint=rule, overlap_m=overlap_m, half_model=half)
    data["numerics"]["nodes_thickness"] = 9
    result = in_yade("w3_cases", "push_case", job=data)
    forces = joint_forces(pd.read_csv(io.StringIO(result["forces"])), data)
    return np.array(result["curve"]), forces, data


def mean_capacity(curve, low=0.04, high=0.06):
    part = curve[(curve[:, 0] > low) & (curve[:, 0] < high)]
    return part[:, 1].mean()


@pytest.mark.yade
@pytest.mark.parametrize("overlap_m", [0.125, 0.0625])
def test_hinged_headers_give_the_kinematic_capacity(overlap_m):
    """Each joint carries the weight above it; λ is the kinematic one on the compliant base."""
    curve, forces, data = pushed("hinged", overlap_m)
    ratio = friction_moment_ratio(forces)
    ratio = ratio[(ratio.index > 0.02) & (ratio.index < 0.055)]
    assert np.all(np.abs(ratio - 1.0) < 0.12)
    upper, lower, shift = closed_form(np.array([0.05]), data, "W3")
    found = mean_capacity(curve) - shift[0]
    # λ less the block's own share scales with the friction moment that was measured
    own = np.tan(np.arctan2(0.375, 6.48) - theta_of(0.05, data["facade"]))
    expected = own + (upper[0] - own) * ratio.mean()
    assert abs(found / expected - 1.0) < 0.03
    if overlap_m == 0.125:  # half a brick: header and half brick share the weight evenly
        assert lower[0] * 0.93 < found < upper[0] * 1.02


@pytest.mark.yade
def test_a_header_that_lifts_the_column_wedges():
    """Headers that are part of the façade lift what stands on them: friction feeds on itself."""
    stiff, forces, _ = pushed("rigid")
    free, _, _ = pushed("hinged")
    assert mean_capacity(stiff) > 2.0 * mean_capacity(free)
    assert friction_moment_ratio(forces).iloc[-1] > 2.0


@pytest.mark.yade
def test_full_model_gives_the_curve_of_the_half_model():
    half, full = pushed("hinged")[0], pushed("hinged", half=False)[0]
    assert np.allclose(half[:, 0], full[:, 0], atol=1e-5)
    assert np.abs(half[:, 1] - full[:, 1]).max() < 1e-3


@pytest.mark.yade
def test_peaks_at_the_default_step_are_those_at_half_of_it():
    """Below collapse d/b changes by less than 2 % with half the step."""
    data = job()
    data["return_wall"]["motion"] = "interpolated"  # these floors drift; the wall's foot does not
    t = np.linspace(0.0, 2.4, 241)
    ground = 1.2 * np.where(t < 1.6, np.sin(2.0 * np.pi * t / 0.8), 0.0)
    columns = {f"floor{j}": ((1.0 + 0.1 * j) * ground).tolist() for j in range(1, 5)}
    step = data["w3"]["step_fraction"]
    (status, peak), (_, finer) = in_yade(
        "w3_cases",
        "shake_case",
        job=data,
        fractions=[step, 0.5 * step],
        time_s=t.tolist(),
        columns={"ground": ground.tolist(), **columns},
    )
    assert status == "ok"
    assert 0.2 < finer < 0.9  # it rocks and stands
    assert peak == pytest.approx(finer, rel=0.02)
