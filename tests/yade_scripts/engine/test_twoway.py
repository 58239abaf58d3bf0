"""Return walls with the building's mass: their chain, its limits, its energy."""

import numpy as np
import pytest
from rocking.collapse.scan import Screen
from yade_process import in_yade, resolved

from smdof.chain import floor_motions, shear_chain
from yade_scripts.model.chain import chain_links, chain_matrices
from yade_scripts.model.models import build_scene
from yade_scripts.model.scene import Block, NodeList, Scene
from yade_scripts.model.stiffness import assemble, critical_step

MASS_KG = 66e3
T = np.arange(0.0, 2.5, 0.01)


def chain_scene(smdof):
    """Masses on the ground, and the links between them."""
    n = smdof["n_dof"]
    blocks = [Block("ground", (0, 0, 0), (1, 1, 1), 1.0, (1, 1, 1), free="")]
    heights = np.arange(1.0, n + 1)
    for z in heights:
        blocks.append(Block(f"mass {z:g}", (0, 0, z), (1, 1, 1), MASS_KG / n, (1, 1, 1), free="y"))
    links = chain_links(smdof, MASS_KG, range(1, n + 1), heights)
    return Scene(blocks, [], NodeList().done(), "mass 1", (0, 0, 1), "ground", 1.0, links=links)


def pulses():
    """Ground acceleration [m/s²] that rocks the façade without felling it, at rest at both ends."""
    ground = 0.9 * np.where(T < 1.6, np.sin(2 * np.pi * T / 0.8), 0.0)
    ground[0] = ground[-1] = 0.0
    return ground


@pytest.mark.parametrize("n_dof", [1, 2, 4, 7])
@pytest.mark.parametrize("model", ["modal", "rayleigh"])
def test_links_are_the_chain(n_dof, model):
    """M, K from links are smdof's; the assembled C has smdof's damping in every mode."""
    smdof = {"n_dof": n_dof, "period_s": 0.27, "damping_ratio": 0.05, "damping_model": model}
    chain = shear_chain(n_dof, 0.27, MASS_KG)
    mass, stiffness = chain.matrices()
    got = assemble(chain_scene(smdof))
    k, c = got.dense()
    assert got.mass == pytest.approx(np.diag(mass))
    assert k == pytest.approx(stiffness, abs=1e-9 * k.max())
    values, phi = np.linalg.eigh(stiffness / mass[0, 0])
    modal = phi.T @ c @ phi / mass[0, 0]
    ratio = np.diag(modal) / (2.0 * np.sqrt(values))
    expected = chain.damping_ratios(0.05, model, (1, min(2, n_dof)))
    assert ratio == pytest.approx(expected, rel=1e-9)
    assert modal - np.diag(np.diag(modal)) == pytest.approx(0.0, abs=1e-9 * modal.max())


def test_dashpots_of_the_stated_matrix():
    """Four masses: rows of √K̂ as published for this chain, C = 2ζ√(km)·√K̂."""
    smdof = {"n_dof": 4, "period_s": 0.27, "damping_ratio": 0.05, "damping_model": "modal"}
    mass, stiffness, c = chain_matrices(smdof, MASS_KG)
    root = c / (2.0 * 0.05 * np.sqrt(-stiffness[0, 1] * mass[0, 0]))
    assert root[0] == pytest.approx([1.357, -0.391, -0.070, -0.034], abs=6e-4)
    assert root[3] == pytest.approx([-0.034, -0.104, -0.495, 0.862], abs=6e-4)


def test_links_bound_the_step():
    """One stiff mass: the critical step is that of its link, (2/ω)(√(1 + ζ²) − ζ)."""
    smdof = {"n_dof": 1, "period_s": 0.01, "damping_ratio": 0.05, "damping_model": "modal"}
    omega = 2.0 * np.pi / 0.01
    expected = 2.0 / omega * (np.sqrt(1.0 + 0.05**2) - 0.05)
    assert critical_step(chain_scene(smdof)) == pytest.approx(expected, rel=1e-9)


def test_a_two_way_wall_needs_a_mass():
    """One line that names the key; W3m also when its bricks weigh more than the building."""
    for model, mass in (("W2m", None), ("W3m", None), ("W3m", 1000.0)):
        job = {**resolved(return_wall={"building_mass_kg": mass}), "model": model, "beta_s": 0.002}
        with pytest.raises(ValueError, match="return_wall.building_mass_kg.*expected"):
            build_scene(job)


@pytest.mark.yade
def test_a_motion_that_begins_at_its_peak_finds_the_masses_at_rest():
    """Velocities live half a step before positions: wrong by a step there, the swing is 2 % off."""
    config = resolved(return_wall={"building_mass_kg": MASS_KG}, numerics={"step_fraction": 0.2})
    time_s = T[:120]
    ground = 2.0 * np.cos(2 * np.pi * time_s / 0.5) * np.exp(-((time_s / 0.4) ** 2))
    got = in_yade("twoway_cases", "chain_alone", config=config, ground=ground.tolist(), dt_s=0.01)
    rows = np.array(got["rows"])
    exact = floor_motions(ground, 0.01, refine=16)
    top = np.interp(rows[:, 0], exact.time_s, exact.relative_m[-1])
    assert np.abs(rows[:, 4] - top).max() < 0.005 * np.abs(top).max()


@pytest.mark.yade
def test_without_a_facade_the_masses_move_as_the_chain():
    """Displacement of every mass within 0.5 % of the modal solution's peak."""
    config = resolved(return_wall={"building_mass_kg": MASS_KG}, numerics={"step_fraction": 0.2})
    ground = 2.0 * np.sin(2 * np.pi * T / 0.3) * np.exp(-(((T - 1.0) / 0.4) ** 2))
    ground += np.sin(2 * np.pi * T / 0.06) * np.exp(-(((T - 1.2) / 0.3) ** 2))
    ground[0] = ground[-1] = 0.0
    got = in_yade("twoway_cases", "chain_alone", config=config, ground=ground.tolist(), dt_s=0.01)
    rows = np.array(got["rows"])
    exact = floor_motions(ground, 0.01, refine=16)
    for j in range(4):
        expected = np.interp(rows[:, 0], exact.time_s, exact.relative_m[j])
        assert np.abs(rows[:, 1 + j] - expected).max() < 0.005 * np.abs(expected).max()


def shaken(runs, rule, factor=1.0, fraction=0.1, **sections):
    """Peaks of runs (model, mass of the building [kg]) under the pulses, by one rule of motion."""
    motion = floor_motions(factor * pulses(), 0.01, tail_s=0.5)
    columns = {"ground": motion.ground_m_s2.tolist()}
    columns |= {f"floor{j}": row.tolist() for j, row in enumerate(motion.floors_m_s2, 1)}
    got = in_yade(
        "twoway_cases",
        "shaken",
        config=resolved(
            numerics={"step_fraction": fraction, "after_motion_s": 0.1},
            return_wall={"motion": rule},
            **sections,
        ),
        runs=runs,
        time_s=motion.time_s.tolist(),
        columns=columns,
    )
    assert [run["status"] for run in got] == ["ok"] * len(runs), got
    return [run["peak"] for run in got]


@pytest.mark.yade
def test_a_very_heavy_building_is_a_driven_one():
    """At 1e9 kg W2m and W2cm give the peaks of W2 and W2c within 0.5 %; at 66 t less."""
    runs = [("W2", None), ("W2m", 1e9), ("W2m", MASS_KG), ("W2c", None), ("W2cm", 1e9)]
    driven, heavy, real, bonded, heavy_bonded = shaken(runs, "top")
    assert driven > 0.05
    assert heavy == pytest.approx(driven, rel=0.005)
    assert abs(real / driven - 1.0) > 0.02
    assert heavy_bonded == pytest.approx(bonded, rel=0.005)


@pytest.mark.yade
@pytest.mark.parametrize(("model", "rule"), [("W2", "middle"), ("W3", "top")])
def test_limit_of_a_heavy_building_by_every_rule(model, rule):
    """The two-way model at 1e9 kg within 0.5 % of the driven one, whichever way walls follow."""
    driven, heavy = shaken([(model, None), (f"{model}m", 1e9)], rule, 2.2 if model == "W3" else 1.0)
    assert driven > 0.05
    assert heavy == pytest.approx(driven, rel=0.005)


@pytest.mark.yade
@pytest.mark.parametrize("rule", ["top", "middle"])
def test_planar_two_way_agrees_with_yade(rule):
    """W2m at 66 t well below collapse: the compiled solver's history within 1 %."""
    (planar,) = planar_peaks([1.0], rule)
    (yade,) = shaken([("W2m", MASS_KG)], rule)
    assert planar == pytest.approx(yade, rel=0.01)


FLOORS = [
    {"height_m": 6.48, "load_kn": 30.0, "arm_m": 0.12, "friction": 0.3, "mass_t": 5.0},
    {"height_m": 3.24, "load_kn": 20.0, "friction": 0.3},
]


@pytest.mark.yade
def test_floors_on_masses_that_feel_them():
    """W2m with two floors that slide, one with a mass, at 66 t: both solvers' peak within 1 %."""
    facade = {"floors": FLOORS}
    (planar,) = planar_peaks([2.0], "top", facade=facade)
    (yade,) = shaken([("W2m", MASS_KG, 2.0)], "top", fraction=0.2, facade=facade)
    (bare,) = planar_peaks([2.0], "top")
    assert planar == pytest.approx(yade, rel=0.01)
    assert 0.05 < planar < 0.8 * bare


@pytest.mark.yade
def test_medians_of_realisations_agree_with_the_planar_solver():
    """W2m on the way to collapse, realisations within ± 1 % of amplitude: medians within 5 %."""
    factors = 1.6 * np.linspace(0.99, 1.01, 5)
    planar = planar_peaks(factors, "top")
    yade = shaken([("W2m", MASS_KG, factor) for factor in factors.tolist()], "top")
    assert 0.3 < np.median(yade) < 1.0
    assert np.median(planar) == pytest.approx(np.median(yade), rel=0.05)


def planar_peaks(factors, rule, **sections):
    """Peak d/b of W2m by the compiled solver."""
    config = resolved(
        return_wall={"building_mass_kg": MASS_KG, "motion": rule},
        numerics={"nodes_thickness": 17, "nodes_per_block": 17, "after_motion_s": 0.1},
        **sections,
    )
    motion = floor_motions(pulses(), 0.01, tail_s=0.5)
    columns = {"ground": motion.ground_m_s2}
    screen = Screen({**config, "model": "W2m", "beta_s": 0.002}, motion.time_s, columns, "pos")
    pga_g = np.abs(motion.ground_m_s2).max() / 9.80665
    return screen.run(pga_g * np.array(factors), scatter=False)["d_over_b"].to_numpy()


def balanced(model, seconds, fraction, **sections):
    """Books of a run under the first seconds of the pulses."""
    n = round(seconds / 0.01)
    return in_yade(
        "accuracy_cases",
        "balanced",
        config=resolved(return_wall={"building_mass_kg": MASS_KG}, **sections),
        model=model,
        beta_s=0.002,
        time_s=T[:n].tolist(),
        columns={"ground": pulses()[:n].tolist()},
        fraction=fraction,
    )


@pytest.mark.yade
def test_energy_closes_with_the_chain_inside():
    """The residual stays below 1e-3 of what overturns the façade and falls with the step."""
    nodes = {"nodes_per_block": 3, "nodes_thickness": 3, "after_motion_s": 0.1}
    got = [balanced("W2m", 2.0, fraction, numerics=nodes) for fraction in (0.4, 0.1)]
    assert [run["status"] for run in got] == ["ok", "ok"]
    coarse, fine = (run["residual"] / run["overturning"] for run in got)
    assert fine < 1e-3
    assert coarse / fine > 4.0
    assert fine * got[1]["overturning"] < 1e-3 * got[1]["last"][1]
