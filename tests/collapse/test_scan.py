"""Steps of the dense scan: short enough for what it marches, and different for realisations."""

import numpy as np
import pytest
from rocking import Case, Motion
from rocking.collapse.curve import run_by
from rocking.collapse.scan import COURSES_STEP, FIRM_STEP, SHORTER
from rocking.configuration.config import ConfigError
from rocking.records import Record
from rocking.solver import peaks
from study_cases import study_case


@pytest.mark.parametrize("mass_kg", [500.0, 77000.0])
def test_light_masses_that_carry_the_walls_get_the_steps_that_they_need(mass_kg):
    """Walls of W2m on a light and a heavy building: peaks of a quarter of the step, 0.1 %."""
    t = 0.01 * np.arange(160)
    pulse = Motion(Record("pulse", -np.sin(2.5 * np.pi * t) * (t < 0.8), 0.01, source="file"))
    given = {"return_wall.building_mass_kg": mass_kg, "smdof.tail_s": 1.0}
    case = study_case("W2m", given | {"numerics.after_motion_s": 3.0})
    screen = run_by("planar", case, pulse, "pos")
    for plane, step_s in zip(screen.planes, screen.steps_s, strict=True):
        motions, factors = screen.shaking([0.1, 0.15])
        usual, finer = (
            peaks(
                *(plane, motions, screen.numerics, factors),
                carried=screen.carried,
                step_s=share * step_s,
            ).d_over_b
            for share in (1.0, 0.25)
        )
        assert np.all(usual > 0.2)
        assert usual == pytest.approx(finer, rel=1e-3)


def test_realisations_of_courses_differ_in_step():
    """Their joints have no nodes that could: four steps, four answers, within a hundredth."""
    t = 0.01 * np.arange(160)
    pulse = Motion(Record("pulse", -np.sin(2.5 * np.pi * t) * (t < 0.8), 0.01, source="file"))
    courses = {"facade.courses": 3, "facade.courses_growth": 1.5, "numerics.after_motion_s": 3.0}
    screen = run_by("planar", study_case("W2", courses), pulse, "pos")
    same = screen.run([0.12] * 8, scatter=True)
    assert same["step_factor"].tolist() == 2 * list(SHORTER)
    peak = same["d_over_b"].to_numpy()
    assert np.unique(peak).size == len(SHORTER)
    assert peak == pytest.approx(peak.mean(), rel=0.01)
    assert screen.run([0.12] * 4, scatter=False)["d_over_b"].nunique() == 1


def test_courses_before_walls_that_stand_firm_take_a_shorter_step():
    """The ground's (W1), driven ones (W2), those of a building that does not feel the façade."""
    t = 0.01 * np.arange(20)
    pulse = Motion(Record("pulse", np.sin(2.5 * np.pi * t), 0.01, source="file"))

    def step_s(model, mass_kg=64e3):
        facade = {"facade.courses": 4, "facade.courses_growth": 1.5}
        case = study_case(model, facade | {"return_wall.building_mass_kg": mass_kg})
        return run_by("planar", case, pulse, "pos").steps_s[0]

    shorter = step_s("W2m") * FIRM_STEP / COURSES_STEP
    firm = [step_s("W1"), step_s("W2"), step_s("W2m", 1e6)]
    assert firm == pytest.approx([shorter] * 3)
    assert FIRM_STEP < COURSES_STEP


def test_a_façade_that_stands_in_courses_and_not_in_one_block_is_shaken():
    """Doors and a thrust: on E/h it falls by itself; its courses take their step all the same."""
    door = {"z_m": 0.0, "width_m": 2.6, "height_m": 3.0}
    facade = {
        "height_m": 12.8,
        "thickness_m": 0.65,
        "top_thickness_m": 0.45,
        "width_m": 11.0,
        "e_mpa": 1400.0,
        "openings": [{**door, "x_m": -3.2}, {**door, "x_m": 0.0}, {**door, "x_m": 3.2}],
        "thrusts": [{"height_m": 3.4, "force_kn": 12.0}],
    }
    case = Case.configured("W1", {"facade": {**facade, "courses": 4}})
    with pytest.raises(ConfigError, match="falls by itself"):
        Case.configured("W1", {"facade": {**facade, "courses": 0}})
    motion = Motion.sampled(np.sin(np.arange(0.0, 2.0, 0.01)), 0.01, name="sine")
    screen = run_by("planar", case, motion, "pos")
    assert screen.run([0.01], scatter=False)["status"].tolist() == ["ok"]
