"""W3 as the study words it: cut return bricks, and every inclined plane against statics."""

import math

import numpy as np
import pytest
from yade_process import in_yade, resolved

from yade_scripts.model import models
from yade_scripts.model.split_bricks import lowest_edge, polygon_moments

T, V, L, H, RHO = 0.375, 0.125, 0.25, 0.324, 1800.0


def job(model="W3", **w3):
    config = resolved(w3=w3, numerics=dict(nodes_thickness=5))
    return {**config, "model": model, "beta_s": 0.00276}


def scene_of(model="W3", **w3):
    return models.build_scene(job(model, **w3))


def joint(scene, name):
    """Rows of the nodes of one joint."""
    return np.flatnonzero(scene.nodes.joint == scene.joints.index(name))


def test_polygon_moments_of_a_triangle():
    """Right triangle with legs a, b: A = ab/2, second moments A a²/18 and A b²/18."""
    for turn in (1, -1):
        area, centre, second = polygon_moments([(1.0, 2.0), (4.0, 2.0), (1.0, 8.0)][::turn])
        assert area == pytest.approx(9.0)
        assert centre == pytest.approx([2.0, 4.0])
        assert second == pytest.approx([9.0 * 9.0 / 18.0, 9.0 * 36.0 / 18.0])


def test_parts_of_a_cut_brick_make_up_the_brick():
    """Mass, centroid and inertia about x of rear and front together are those of the whole."""
    whole, cut = scene_of(header_joint="bonded"), scene_of(header_joint="study")
    one = whole.blocks[whole.index("wall brick 3")]
    parts = [cut.blocks[cut.index(f"wall brick 3{end}")] for end in ("", " front")]
    mass = np.array([p.mass_kg for p in parts])
    centre = np.array([p.centre_m for p in parts])
    assert mass.sum() == pytest.approx(one.mass_kg)
    joint_centre = mass @ centre / mass.sum()
    assert joint_centre == pytest.approx(np.array(one.centre_m))
    own = sum(p.inertia_kg_m2[0] for p in parts)
    steiner = mass @ ((centre - joint_centre)[:, 1:] ** 2).sum(axis=1)
    assert own + steiner == pytest.approx(one.inertia_kg_m2[0])
    # the plane runs from (−v, top) to (−v + H tan s, bottom): a trapezium of known area
    area = 0.5 * H * (V + V - H * math.tan(math.radians(15.0)))
    assert mass[1] == pytest.approx(RHO * T * area)


@pytest.mark.parametrize("inclination", [0.0, 5.0, 15.0])
def test_bed_of_a_cut_brick_keeps_the_area_of_the_overlap(inclination):
    scene = scene_of(header_joint="study", split_inclination_deg=inclination)
    names = [name for name in scene.joints if name.startswith("wall bed 2 ")]
    area = sum(scene.nodes.area_m2[joint(scene, name)].sum() for name in names)
    assert area == pytest.approx(T * V)
    assert len(names) == (2 if inclination == 0.0 else 4)


@pytest.mark.parametrize(
    ("rule", "name", "raised"),
    [
        ("hinged", "wall header joint 2", "façade"),
        ("study", "wall brick 3 plane", "wall brick 3 front"),
    ],
)
def test_what_rises_with_the_facade_opens_the_inclined_plane(rule, name, raised):
    """Opening rate n·(u_a − u_b) as the outward part rises by 1, and as it moves out by 1."""
    scene = scene_of(header_joint=rule)
    nodes, rows = scene.nodes, joint(scene, name)
    sign = np.where(nodes.a[rows] == scene.index(raised), 1.0, -1.0)
    slope = math.radians(15.0 if rule == "study" else 45.0)
    assert sign * nodes.normal[rows, 2] == pytest.approx(math.sin(slope))
    assert sign * nodes.normal[rows, 1] == pytest.approx(math.cos(slope))


@pytest.mark.parametrize(
    ("rule", "name", "stress_pa", "length_m"),
    [
        ("hinged", "wall header joint 2", 0.07e6, H),
        ("study", "wall brick 3 plane", 0.07e6, H / math.cos(math.radians(15.0))),
        ("bonded", "wall header joint 4", 1.5e6, H),
        ("hinged", "wall header joint 4", 1.5e6, H),
    ],
)
def test_a_plane_holds_its_stress_times_its_area(rule, name, stress_pa, length_m):
    """0.07 MPa over 0.375 × 0.324 m are 8.5 kN, a tenth of half the façade."""
    scene = scene_of(header_joint=rule)
    rows = joint(scene, name)
    assert scene.nodes.tension_n[rows].sum() == pytest.approx(stress_pa * T * length_m)
    if rule != "hinged":  # cohesion of mortar and of brick
        shear = {"study": 0.1e6, "bonded": 2.0e6}[rule]
        assert scene.nodes.cohesion_n[rows].sum() == pytest.approx(shear * T * length_m)


def test_gauss_points_bend_like_the_plane():
    """Two Gauss points have the area and the second moment l³t/12 of the plane."""
    scene = scene_of(header_joint="study")
    rows = joint(scene, "wall brick 3 plane")
    place, area = scene.nodes.position_m[rows], scene.nodes.area_m2[rows]
    length = H / math.cos(math.radians(15.0))
    centre = area @ place / area.sum()
    assert centre[1] == pytest.approx(-V + 0.5 * H * math.tan(math.radians(15.0)))
    second = area @ ((place - centre)[:, 1:] ** 2).sum(axis=1)
    assert second == pytest.approx(T * length**3 / 12.0)
    # both lie on the plane: their distance along the normal is nil
    assert np.ptp(place @ scene.nodes.normal[rows[0]]) == pytest.approx(0.0, abs=1e-12)


def test_a_plane_that_misses_the_lower_bed_is_refused_by_key():
    with pytest.raises(ValueError, match=r"w3.split_inclination_deg = 22.*21.1") as error:
        scene_of(header_joint="study", split_inclination_deg=22.0)
    assert "\n" not in str(error.value)
    with pytest.raises(ValueError, match="W3m"):
        scene_of("W3m", header_joint="study")
    assert lowest_edge(0.3, 0.1, 0.0) == -0.1


@pytest.mark.yade
def test_a_cut_brick_lets_the_header_rise():
    """Pushed by 4 % of b: bonded headers wedge, cutting every brick above one eases it."""
    w3 = dict(course_height_m=0.648, split_inclination_deg=0.0, step_fraction=0.9)
    peak = {}
    for rule, courses in (("bonded", 0), ("study", 10)):
        data = job(header_joint=rule, lower_courses=courses, **w3)
        data["numerics"]["nodes_thickness"] = 5
        result = in_yade("w3_cases", "push_case", job=data, speed_m_s=0.4, reach=0.04)
        peak[rule] = max(force for _, force in result["curve"])
    assert peak["study"] < 0.8 * peak["bonded"]
