"""Ties: their law, their statics against closed forms, and YADE against the compiled solver."""

import math

import numpy as np
import pytest
from both_solvers import BETA_S, FEW, agreed, pulses
from rocking.configuration.config import ConfigError
from rocking.solver.plane import to_plane
from rocking.solver.runs import Motions, history
from study_cases import study_settings
from yade_process import resolved

from yade_scripts.model.facade import facade_scene
from yade_scripts.model.facades import Rods
from yade_scripts.model.scene import TIE
from yade_scripts.model.stiffness import assemble

G = 9.80665


def tied(*rows, model="W1", **sections):
    """Configuration and scene of a façade with ties."""
    facade = {**sections.pop("facade", {}), "ties": list(rows)}
    config = resolved(facade=facade, **sections)
    return config, facade_scene(config, model, BETA_S)


def outward(config, scene, time_s, pull_m_s2):
    """History under an inertia force outward of m·pull."""
    return history(to_plane(scene), Motions(time_s, -pull_m_s2), config["numerics"], sample_s=0.01)


ROW = {"height_m": 6.0, "count": 2, "diameter_mm": 16.0, "length_m": 4.0}


def test_a_row_of_rods():
    """Two rods of 16 mm, 4 m: A = 201.06 mm², k = 2·2e11·A/L = 20.106 MN/m, F = 2·235·A = 94.50 kN.

    Steel snaps at 5 % of 4 m; an anchor of 30 kN each gives way at 60 kN, 2.984 mm.
    """
    (row,) = resolved(facade={"ties": [ROW]})["facade"]["ties"]
    assert Rods(**row).rod == pytest.approx((20.106e6, 94.50e3, 0.2), rel=1e-4)
    weak = Rods(**{**row, "anchor_kn": 30.0}).rod
    assert weak == pytest.approx((20.106e6, 60e3, 2.984e-3), rel=1e-3)


@pytest.mark.parametrize("anchor_kn", [None, 12.0])
def test_static_capacity(anchor_kn):
    """Largest λ of a rigid façade with a tie, moments about the toe turned by θ:

    λ W R cos(α − θ) = W R sin(α − θ) + T × arm, T = min(k e, F): a push held at 0.99 of the
    peak is borne, at 1.01 it fells.
    """
    row = {**ROW, "count": 1, "diameter_mm": 10.0, "anchor_kn": anchor_kn}
    config, scene = tied(row, facade={"e_mpa": 1e5}, numerics=FEW)
    f = config["facade"]
    h, b = f["height_m"], f["thickness_m"]
    weight = f["density_kg_m3"] * h * b * f["width_m"] * G
    k, force, snap = Rods(**config["facade"]["ties"][0]).rod
    theta = np.linspace(1e-5, 0.02, 20001)
    y = -b * np.cos(theta) + row["height_m"] * np.sin(theta)  # of the tie's end, from the toe
    z = b * np.sin(theta) + row["height_m"] * np.cos(theta)
    run, rise = y + b + row["length_m"], z - row["height_m"]
    length = np.hypot(run, rise)
    e = length - row["length_m"]
    pull = np.where(e <= snap * (1.0 + 1e-9), np.minimum(k * e, force), 0.0)
    back = pull * (z * run - y * rise) / length
    alpha, radius = math.atan2(b, h), 0.5 * math.hypot(h, b)
    resisting = weight * radius * np.sin(alpha - theta) + back
    peak = np.max(resisting / (weight * radius * np.cos(alpha - theta)))
    assert peak > 1.2 * math.tan(alpha)
    time_s = np.linspace(0.0, 40.0, 4001)
    for share, status in ((0.99, "ok"), (1.01, "overturned")):
        slow = peak * share * G * 0.5 * (1.0 - np.cos(np.pi * np.minimum(time_s / 10.0, 1.0)))
        assert outward(config, scene, time_s, slow).status == status


def test_a_taut_tie_is_a_bonded_node():
    """A tie that never yields, and a node that holds tension alone: the same swing."""
    row = {**ROW, "diameter_mm": 6.0, "yield_mpa": 5000.0, "count": 1}
    config, scene = tied(row)
    tie = scene.ties[0]
    free = resolved(facade={"ties": []})
    bare = facade_scene(free, "W1", BETA_S)
    nodes = bare.nodes
    extra = {
        "a": 1, "b": 2, "joint": len(bare.joints), "position_m": [0.0, 0.0, ROW["height_m"]],
        "normal": [0.0, 1.0, 0.0], "area_m2": 1.0, "kn_n_m": tie.stiffness_n_m,
        "ks_n_m": tie.stiffness_n_m, "beta_s": 0.0, "friction_rad": 0.0, "gap_m": 0.0,
        "tension_n": 1e12, "cohesion_n": 0.0, "kind": TIE,
    }  # fmt: skip
    for name, value in extra.items():
        column = getattr(nodes, name)
        setattr(nodes, name, np.concatenate([column, np.array([value], column.dtype)]))
    bare.joints.append("bonded node")
    t, ground = pulses(3.0)
    one, other = (outward(free, s, t, ground) for s in (scene, bare))
    assert one.status == other.status == "ok"
    assert one.peak_d_over_b > 0.01
    assert one.peak_d_over_b == pytest.approx(other.peak_d_over_b, rel=0.01)


CASES = {
    "yields": ({**ROW, "count": 1, "diameter_mm": 10.0, "slack_mm": 5.0}, "W2", 1.5),
    "snaps": ({**ROW, "count": 1, "diameter_mm": 10.0, "anchor_kn": 15.0}, "W1", 1.0),
}


@pytest.mark.yade
@pytest.mark.parametrize("name", CASES)
def test_yade_and_the_compiled_solver(name):
    """Peak d/b within 1 %, and YADE's energy balance closes with the tie's losses in them."""
    row, model, amplitude = CASES[name]
    config, scene = tied(row, model=model, numerics=FEW)
    planar, got = agreed(config, scene, model, amplitude, 0.1)
    k, force, snap = Rods(**config["facade"]["ties"][0]).rod
    lost = got["last"][7]  # by yielding and snapping
    if name == "snaps":
        assert planar.broken == 1
        assert lost == pytest.approx(0.5 * force * snap, rel=5e-3)
    else:
        assert planar.broken == 0
        assert lost > 0.5 * force**2 / k


def test_matrices_hold_the_tie():
    """K of the scene file and of the plane: k at the height of the tie, about the centroid."""
    _, bare = tied()
    config, scene = tied(ROW)
    k, _, _ = Rods(**config["facade"]["ties"][0]).rod
    row = np.array([1.0, 0.0, -(ROW["height_m"] - 0.5 * config["facade"]["height_m"])])
    gain = assemble(scene).dense()[0] - assemble(bare).dense()[0]
    assert gain == pytest.approx(k * np.outer(row, row), rel=1e-9, abs=1e-6 * k)


@pytest.mark.parametrize(
    ("facade", "models", "message"),
    [
        ({"ties": [{"height_m": 7.0}]}, ["W1"], r"facade.ties\[1\].height_m = 7.*at most"),
        ({"ties": [{"height_m": 6.0, "slack_mm": -1.0}]}, ["W1"], r"ties\[1\].*slack_mm = -1"),
        ({"ties": [{"diameter_mm": 10.0}]}, ["W1"], r"ties\[1\].height_m: missing"),
        ({"ties": [{"height_m": 6.0, "elongation": 1e-4}]}, ["W1"], "elongation.*strain at yield"),
        ({"ties": [{"height_m": 6.0}]}, ["W3"], "W3.*expected no facade.ties"),
        ({"ties": [{"height_m": 6.0, "diametre_mm": 9}]}, ["W1"], "unknown key"),
    ],
)
def test_impossible_ties(facade, models, message):
    """One line with key, value and what was expected."""

    with pytest.raises(ConfigError, match=message):
        study_settings({"facade": facade, "models": models})
