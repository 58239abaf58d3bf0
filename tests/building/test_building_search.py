"""The search for the study's building: variants, modes under a load, readings of the periods."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from rocking.building.case import (
    PAPER_PERIODS_S,
    build_model,
    mass_behind_facade,
    panel_areas,
    read_plan,
    translation_mode,
    twist_mode,
)
from rocking.building.loads import LoadedModes
from rocking.building.modes import Modes, Solver
from rocking.building.search import (
    PlanVariant,
    evaluate,
    fitted,
    loaded,
    modes_of_study,
    not_dominated,
    reached,
    refine,
    sample,
    variant,
)
from rocking.configuration import config

from yade_scripts.model.building.plan import PlanError, plan_from_dict

BUILDINGS = Path(__file__).parents[2] / "config" / "buildings"
COARSE = 6.0


@pytest.fixture(scope="module")
def settings():
    return config.resolve({})["building"]


@pytest.fixture(scope="module")
def plan():
    return read_plan(BUILDINGS / "case_study_open_facades.yaml")


@pytest.fixture(scope="module")
def chosen():
    return PlanVariant(0.94, 0.94, 0.94, 1.0, 1.0, 0.0, 1800.0)


@pytest.fixture(scope="module")
def models(settings, plan, chosen):
    return loaded(settings, chosen.plan(plan), COARSE)


def made_up(period_s, mass_y, inertia_z, inertia_x=None):
    """Modes of which only periods and effective ratios are known."""
    ratio = np.zeros((len(period_s), 6))
    ratio[:, 1], ratio[:, 5] = mass_y, inertia_z
    ratio[:, 3] = 0.0 if inertia_x is None else inertia_x
    omega = 2.0 * np.pi / np.array(period_s)
    return Modes(omega, np.empty(0), np.empty(0), ratio, np.empty(0), np.empty(0))


def test_plain_variant_is_the_plan_itself(plan, chosen):
    for was, now in zip(plan.walls, chosen.plan(plan).walls, strict=True):
        assert now.thickness_m == was.thickness_m
        for a, b in zip(was.openings, now.openings, strict=True):
            assert b.from_start_m == pytest.approx(a.from_start_m)
            assert b.width_m == pytest.approx(a.width_m)


def test_openings_keep_their_middle_and_narrow_ones_are_bricked_up(plan, chosen):
    other = replace(chosen, opening_left_m=1.3, opening_right_m=0.05).plan(plan)
    left, right = (plan.wall(n).openings for n in ("left", "right"))
    for was, now in zip(left, other.wall("left").openings, strict=True):
        assert now.width_m == pytest.approx(1.3)
        assert now.from_start_m + now.width_m / 2 == pytest.approx(
            was.from_start_m + was.width_m / 2
        )
    assert right
    assert other.wall("right").openings == ()


@pytest.mark.parametrize("corner", [-0.36, 0.3, 0.6])
def test_corners_weigh_what_stands_or_is_cut_off(settings, corner):
    """Four corners of 0.36 m by 6.48 m: 2.333 m³ a metre of façade."""
    solid = read_plan(BUILDINGS / "case_study_no_openings.yaml")
    bare, other = (
        build_model(settings, replace(solid, corner_m=c), "SBDEM", 0.0, COARSE).masonry_mass_kg
        for c in (0.0, corner)
    )
    assert other - bare == pytest.approx(4 * corner * 0.36 * 6.48 * 1800.0, rel=1e-9)


def test_a_corner_keeps_the_part_of_a_window_that_lies_in_it(settings, plan):
    """Windows start 0.44 m from the side wall: 0.74 m of façade has 0.30 m of each of 8 windows."""
    bare, other = (
        build_model(settings, replace(plan, corner_m=c), "SBDEM", 0.0, COARSE).masonry_mass_kg
        for c in (0.0, 0.74)
    )
    volume = 4 * 0.36 * (0.74 * 6.48 - 2 * 0.30 * 1.26)
    assert other - bare == pytest.approx(1800.0 * volume, rel=1e-9)


def test_a_looser_bond_lengthens_every_period(settings, plan):
    """Rayleigh: a smaller K with the same M has no higher frequency in any mode.

    Without its façades the building has no such joints, and keeps its periods.
    """

    def periods(model, bond):
        looser = replace(plan, facade_bond=bond)
        return Solver(build_model(settings, looser, model, 0.0, COARSE).scene).modes(8).period_s

    firm, loose = periods("CBDEM", 1.0), periods("CBDEM", 0.1)
    assert np.all(loose >= firm * (1.0 - 1e-9))
    assert loose[0] > 1.05 * firm[0]
    assert periods("SBDEM", 0.1) == pytest.approx(periods("SBDEM", 1.0), rel=1e-12)


@pytest.mark.parametrize("bond", [0.0, 1.5, "no"])
def test_a_bond_that_means_nothing_is_refused(bond):
    wall = {
        "name": "a",
        "start_m": [0, 0],
        "end_m": [1, 0],
        "thickness_m": 0.12,
        "height_m": 1.2,
    }
    with pytest.raises(PlanError, match="house: facade_bond must be above 0 and at most 1"):
        plan_from_dict({"name": "n", "walls": [wall], "facade_bond": bond}, "house")


def test_modes_under_a_load_equal_a_direct_solution(settings, plan):
    building = build_model(settings, plan, "CBDEM", 0.0, COARSE)
    load = 420.0
    solver = Solver(building.scene)
    added = {i: load * area for i, area in panel_areas(building).items()}
    direct = solver.modes(6, solver.mass_with(added))
    reduced = LoadedModes(building).modes(load)
    assert reduced.period_s[:6] == pytest.approx(direct.period_s, rel=1e-4)
    assert reduced.effective_ratio[:6] == pytest.approx(direct.effective_ratio, abs=2e-3)


def test_the_twist_turns_the_floor_about_the_vertical(settings):
    """Its panel moves less at its middle than half its length times its rotation about z."""
    whole = read_plan(BUILDINGS / "case_study.yaml")
    building = build_model(settings, whole, "CBDEM", 200.0, COARSE)
    modes = Solver(building.scene).modes(12)
    panel = building.scene.index(building.scene.monitor)
    length = building.scene.blocks[panel].size_m[1]

    def motion(mode):
        own = modes.dof[:, 0] == panel
        return dict(zip(modes.dof[own, 1], np.abs(modes.phi[own, mode]), strict=True))

    twist, along = motion(twist_mode(modes)), motion(translation_mode(modes))
    assert length / 2 * twist[5] > 5 * max(twist[0], twist[1], length / 2 * twist[3])
    assert along[1] > 5 * max(along[0], length / 2 * along[5])


def test_mass_behind_the_facade_is_the_building_less_one_wall(settings):
    """The front façade fills the space between the side walls: ρ h t (w − 2 t)."""
    whole = read_plan(BUILDINGS / "case_study.yaml")
    given = {**settings, "coarsening": COARSE}
    blocks = build_model(given, whole, "CBDEM", 200.0).scene.blocks
    wall = next(w for w in whole.walls if w.facade)
    width = np.hypot(*np.subtract(wall.end_m, wall.start_m)) - 2.0 * wall.thickness_m
    facade = settings["density_kg_m3"] * wall.height_m * wall.thickness_m * width
    complete = sum(block.mass_kg for block in blocks if block.free)
    behind = mass_behind_facade(given, whole, 200.0)
    assert complete - behind == pytest.approx(facade, rel=1e-3)


def test_the_two_readings_of_made_up_modes():
    modes = made_up([1.0, 0.3, 0.2, 0.1], [0.01, 0.3, 0.5, 0.1], [0.0, 0.6, 0.3, 0.0], [0, 0, 0, 1])
    assert modes_of_study(modes, "mass") == (2, 1)
    assert modes_of_study(modes, "order") == (1, 2)
    assert modes_of_study(made_up([0.3, 0.2], [0.9, 0.01], [0.0, 0.9]), "order") is None


def test_side_walls_alone_turn_slower_than_they_sway(settings):
    """Two springs 2a apart, mass of radius r: T_rz/T_y = r/a, above 1 while r > a.

    Walls as half-height cantilever lumps: r² = (a² + 6²/12) for the masonry; the floor's own
    radius is 2.1 m. So SBDEM without corners cannot turn faster than it sways, as it does in
    the study.
    """
    solid = read_plan(BUILDINGS / "case_study_no_openings.yaml")
    modes = Solver(build_model(settings, solid, "SBDEM", 1000.0, COARSE).scene).modes(12)
    # out of plane the walls are weak but not free of stiffness: the bound is approached from below
    ratio = modes.period_s[twist_mode(modes)] / modes.period_s[translation_mode(modes)]
    assert ratio > PAPER_PERIODS_S["SBDEM", "rz"] / PAPER_PERIODS_S["SBDEM", "y"] + 0.15


def test_the_load_is_fitted_and_the_errors_are_those_of_the_periods(models):
    row = fitted(models, "mass")
    assert row["cbdem_y_s"] == pytest.approx(0.25, abs=1e-5)
    direct = models["SBDEM"].modes(row["load_kg_m2"])
    assert row["sbdem_rz_s"] == direct.period_s[twist_mode(direct)]
    stated = {"cbdem_y": 0.25, "sbdem_y": 0.27, "cbdem_rz": 0.16, "sbdem_rz": 0.17}
    errors = [abs(row[f"{name}_s"] - period) for name, period in stated.items()]
    assert row["largest_error_s"] == pytest.approx(max(errors))


def test_the_coupled_plan_has_the_four_periods_in_their_order_alone(settings):
    """Within 0.01 s at the standard brick; here with one six times coarser, hence 0.02 s.

    Its SBDEM's first mode has less than half of the mass that its second has along y.
    """
    rows = evaluate(settings, read_plan(BUILDINGS / "case_study_coupled.yaml"), COARSE)
    assert rows["order"]["largest_error_s"] < 0.02
    assert rows["order"]["sbdem_y_mass_y"] < rows["order"]["sbdem_rz_mass_y"]
    assert rows["mass"]["largest_error_s"] > 0.08


def test_a_variant_that_cannot_be_built_is_left_out(settings, plan, chosen):
    assert evaluate(settings, replace(chosen, opening_left_m=3.0).plan(plan), COARSE) == {}


def test_the_sample_fills_its_ranges_and_repeats():
    places = sample(64, 7)
    assert np.array_equal(places, sample(64, 7))
    assert places.min() >= 0.0
    assert places.max() <= 1.0
    assert np.all(np.histogram(places[:, 0], 8, (0, 1))[0] == 8)  # a Sobol net is even
    ranges = dict.fromkeys(PlanVariant.__dataclass_fields__, (1.0, 3.0)) | {
        "facade_bond": (0.01, 1.0)
    }
    middle = variant(ranges, [0.5] * 7)
    assert middle.opening_left_m == pytest.approx(2.0)
    assert middle.facade_bond == pytest.approx(0.1)


def test_refinement_descends_inside_the_cube():
    goal = np.array([0.9, 0.2, 1.2])  # the last is out of reach: 0.04 is the least at its bound

    def score(place):
        assert np.all((place >= 0.0) & (place <= 1.0))
        return float(np.sum((place - goal) ** 2))

    assert score(refine(score, np.full(3, 0.5), 200)) == pytest.approx(0.04, abs=0.003)


def test_front_of_errors():
    errors = [[1, 4], [2, 2], [4, 1], [3, 3], [2, 2]]
    assert not_dominated(errors).tolist() == [True, True, True, False, True]


def test_a_variant_is_reached_by_its_complete_building_and_best_by_all_four_periods():
    columns = [f"{model.lower()}_{kind}_s" for model, kind in PAPER_PERIODS_S]
    exact = np.array(list(PAPER_PERIODS_S.values()))
    off = 1e-3 * np.array([[1, 1, 1, 1], [2, 1, 1, 1], [0, 9, 0, 0], [20, 0, 0, 0]])
    met, best = reached(pd.DataFrame(exact + off, columns=columns), 0.01)
    assert met.tolist() == [True, True, True, False]  # the last misses CBDEM's translation
    assert best.tolist() == [True, False, True, False]  # the second is bettered by the first
