"""Storeys that yield in the compiled solver: one law by two routes, energy, the elastic limit."""

import numpy as np
import pytest
from rocking import Case, Motion, collapse_curve, history
from rocking.collapse.curve import run_by
from rocking.collapse.scan import carried_masses
from rocking.solver import runs
from rocking.solver import storeys as compiled

from tests.cases import yielding_cases
from yade_scripts.model import storeys as plain
from yade_scripts.model.models import build_scene
from yade_scripts.model.motion import amplitude
from yade_scripts.model.registry import MODELS

FACTORS = (0.3, 1.0, -2.0, 2.0, 4.0)
FALLS = {"loss_drift_ratio": 0.002, "lost_drift_ratio": 0.006, "residual": 0.3}


@pytest.mark.parametrize("more", [{}, FALLS, {"unloading": 0.5}])
@pytest.mark.parametrize("law", plain.LAWS)
def test_both_routes_have_the_same_digits(law, more):
    """Numbers one by one, and lanes: floors and what is remembered."""
    case = yielding_cases.case(loops=law, **more)
    ground, step = yielding_cases.ground(3.0), 0.001
    chain = plain.chain_of(case, step)
    (floors, states), (lanes, ends) = (
        route.march(chain, ground, FACTORS) for route in (plain, compiled)
    )
    drifts = plain.largest_drift(states[-1])
    assert drifts.max() > 2.0 * chain.storeys.yield_m.max()  # it does yield
    assert lanes == pytest.approx(floors, abs=1e-9)
    assert ends == pytest.approx(states, abs=1e-9)


def test_a_march_goes_on_where_another_ended():
    """Two shocks, the second from what the first left once all is at rest, are the whole."""
    case, one = yielding_cases.case(loops="peak_oriented"), yielding_cases.ground(3.0)
    ground, middle = np.concatenate((one, np.zeros(9000), one)), 11000
    chain = plain.chain_of(case, 0.001)
    for route in (plain, compiled):
        whole, end = route.march(chain, ground, [2.0])
        _, state = route.march(chain, ground[: middle + 1], [2.0])
        second, last = route.march(chain, ground[middle:], [2.0], state[0])
        fresh, _ = route.march(chain, ground[middle:], [2.0])
        assert second[0] == pytest.approx(whole[0, :, middle:], abs=1e-6)
        assert last == pytest.approx(end, abs=1e-6)
        assert np.abs(fresh - second).max() > 0.1  # it starts damaged


@pytest.mark.parametrize("law", plain.LAWS)
def test_floors_come_to_rest_where_their_storeys_do(law):
    """Accelerations of floors integrate to the drifts that remain: walls do not wander off."""
    case = yielding_cases.case(ratio=0.08, loops=law)
    step, pulse = 0.001, np.sin(np.linspace(0.0, np.pi, 250))
    ground = np.concatenate((pulse, -0.5 * pulse, -0.5 * pulse, np.zeros(6000)))
    chain = plain.chain_of(case, step)
    floors, states = plain.march(chain, ground, [2.0])
    apart = floors[0] - 2.0 * ground
    speed = np.cumsum(step * apart, axis=1)
    place = step * speed.sum(axis=1)
    n = len(place)
    drift = states[0, 2 * n :].reshape(n, plain.MEMORY)[:, plain.DRIFT]
    peak = plain.largest_drift(states[0])
    assert peak[0] > 3.0 * chain.storeys.yield_m[0]
    assert np.diff(place, prepend=0.0) == pytest.approx(drift, abs=0.01 * peak.max())
    assert np.abs(speed[:, -1]).max() < 1e-3 * np.abs(speed).max()


@pytest.mark.parametrize("model", ["W2", "W2m"])
@pytest.mark.parametrize("loops", plain.LAWS)
def test_so_strong_a_building_is_the_elastic_one(model, loops):
    """V/W of 10: every digit."""
    motion = Motion.named("RRS228")
    how = {"search": "list", "settings": {"pga_g": [0.06, 0.1, 0.2]}}
    elastic, strong = (
        collapse_curve(yielding_cases.case(model, ratio, loops), motion, "neg", **how)
        for ratio in (None, 10.0)
    )
    assert strong.table[list(elastic.table)].equals(elastic.table)


@pytest.mark.slow
@pytest.mark.parametrize("courses", [0, 4])
@pytest.mark.parametrize("model", [name for name, kind in MODELS.items() if kind.scanned])
def test_so_strong_a_building_is_the_elastic_one_in_every_model(model, courses):
    """V/W of 10 of every model that the compiled solver has, whole and in courses."""
    keys = {"facade.courses": courses, "facade.courses_growth": 1.5 if courses else 1.0}
    if courses and not (MODELS[model].single_block and not MODELS[model].bonded):
        pytest.skip("a façade in one block alone")
    if model == "W3m":
        with pytest.raises(ValueError, match="bricks carry an elastic building"):
            yielding_cases.case(model, 10.0)
        return
    cases = [yielding_cases.case(model, ratio).varied(keys) for ratio in (None, 10.0)]
    motion = Motion.named("RRS228")
    elastic, strong = (
        run_by("planar", case, motion, "neg").run([0.06, 0.15], False) for case in cases
    )
    assert strong.equals(elastic)


@pytest.mark.parametrize("loops", plain.LAWS)
def test_energy_of_a_facade_that_pushes_a_yielding_building_closes(loops):
    """Input = stored + dashpots + friction + hysteresis, within 0.5 % of the largest input."""
    case = yielding_cases.case("W2m", 0.1, loops)
    screen = run_by("planar", case, Motion.named("RRS228"), "neg")
    (motions,), (factor,) = screen.shaking([0.15])
    how = {"carried": screen.carried, "step_s": screen.steps_s[0], "sample_s": 0.02}
    found = runs.history(screen.planes[0], motions, screen.numerics, factor, **how)
    stored = found.kinetic_j + found.potential_j + found.elastic_j
    left = found.input_j - (stored - stored[0]) - found.spent_j
    assert np.abs(left).max() < 5e-3 * np.abs(found.input_j).max()
    elastic = run_by("planar", yielding_cases.case("W2m", None), Motion.named("RRS228"), "neg")
    how["carried"] = elastic.carried
    other = runs.history(screen.planes[0], motions, screen.numerics, factor, **how)
    both = min(len(found.time_s), len(other.time_s))
    apart = np.abs(found.supports_m[:both] - other.supports_m[:both]).max()
    assert apart > 0.1 * np.abs(other.supports_m).max()


@pytest.mark.parametrize("loops", plain.LAWS)
def test_a_building_that_nothing_can_push_yields_as_the_chain_alone(loops):
    """W2 in one march, W2m of 1e10 kg, and W2 driven by the floors of the chain's own march."""
    motion = Motion.named("RRS228")
    one = yielding_cases.case("W2", 0.06, loops)
    other = yielding_cases.case("W2m", 0.06, loops)
    other = other.varied({"return_wall.building_mass_kg": 1e10})
    found = [history(case, motion, "neg", 0.08).d_over_b for case in (one, other)]
    assert found[1] == pytest.approx(found[0], rel=1e-3)
    time_s, columns = motion.columns(one)
    moved = columns.at(amplitude(columns["ground"], "neg", 0.08))
    assert not moved.scaled
    driving, still = Motion(floors=(time_s, dict(moved)), of_chain=True), yielding_cases.case()
    still = still.varied({"smdof.base_shear_ratio": None})
    driven = history(still, driving, "pos", 0.08).d_over_b
    assert driven == pytest.approx(found[0], rel=2e-3)
    elastic = history(still, motion, "neg", 0.08).d_over_b
    assert abs(found[0] / elastic - 1.0) > 1e-3


def test_storeys_that_slide_are_the_springs_of_the_scene():
    """Elastic part and slider of each storey add up to its stiffness; they give way at V_y."""
    case = yielding_cases.case("W2m", 0.2)
    scene = build_scene(case.sections)
    storeys = carried_masses(case.sections, build_scene({**case.sections, "model": "W2"})).storeys
    pairs = {frozenset((link.a, link.b)): link.stiffness_n_m for link in scene.links}
    assert len(scene.floors) == 4
    for k, floor in enumerate(scene.floors):
        whole = floor.stiffness_n_m + pairs[frozenset((floor.a, floor.b))]
        assert whole == pytest.approx(storeys.k_n_m[k])
        slides = (1.0 - storeys.hardening) * storeys.k_n_m[k] * storeys.yield_m[k]
        assert floor.capacity_n == pytest.approx(slides)


def test_a_squat_facade_that_pushes_its_building_gains_nothing_from_the_step():
    """With springs as they are at 0.46 of the stable step states alternated, and it fell."""
    about = {
        "facade.height_m": 5.15,
        "facade.thickness_m": 0.395,
        "facade.width_m": 5.3,
        "facade.courses": 4,
        "facade.courses_growth": 1.5,
        "return_wall.building_mass_kg": 42797.0,
        "smdof.period_s": 0.198,
        "smdof.base_shear_ratio": 0.282,
        "smdof.loops": "origin_oriented",
    }
    case = Case.configured("W2m", about).calibrated()
    peaks = []
    for share in (1.0, 0.5):
        screen = run_by("planar", case, Motion.named("AQV_NS"), "neg")
        screen.steps_s = [share * step for step in screen.steps_s]
        peaks.append(screen.run([0.5334], False)["d_over_b"].item())
    assert peaks[0] == pytest.approx(peaks[1], rel=0.02)
    assert max(peaks) < 1.0
