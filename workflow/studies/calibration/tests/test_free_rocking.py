"""Free rocking in YADE: against the closed form, an independent solver and the reference table."""

import json
import math
import warnings

import numpy as np
import pytest
from reference_solver import Wall, simulate
from rocking.mechanics import beta, closed_forms
from studies.calibration import free_rocking as study
from studies.shared.restitution import e_exp, read_archive, rebounds
from yade_process import in_yade, resolved, run_study

pytestmark = pytest.mark.yade

WALL = {"height_m": 0.8, "thickness_m": 0.11, "width_m": 1.0, "density_kg_m3": 1750.0}
BETA = 0.000125
# First and second rebound θ/α by nodes across b and up h, released at θ0/α = 0.5: YADE, and a
# planar solver with the same nodes. The table states neither friction nor shear stiffness.
TABLE = {
    3: ((0.182, 0.076), (0.182, 0.076)),
    5: ((0.186, 0.078), (0.186, 0.079)),
    9: ((0.186, 0.079), (0.185, 0.079)),
}
CONVENTION = {"base_deg": 35.0, "back_deg": 0.0, "shear": 0.7}


def case(
    name,
    nodes,
    fraction,
    *,
    base_deg=30.0,
    back_deg=30.0,
    shear=0.33,
    betas=(BETA,),
    limit_s=1.2,
    **facade,
):
    config = resolved(
        models=["W1"],
        facade={**WALL, "friction_deg": base_deg, "shear_stiffness_ratio": shear, **facade},
        return_wall={"thickness_m": 0.11, "friction_deg": back_deg},
        numerics={"nodes_thickness": nodes, "nodes_height": nodes, "step_fraction": fraction},
    )
    return {
        "id": name,
        "config": {key: config[key] for key in study.SECTIONS},
        "model": "W1",
        "release_ratio": 0.5,
        "beta_s": list(betas),
        "limit_s": limit_s,
    }


def run(cases, folder):
    """Run cases as the workflow does; returns the process and the archive's path."""
    (folder / "cases.json").write_text(json.dumps(cases))
    done = run_study(
        "walls",
        "--list",
        folder / "cases.json",
        "--output",
        folder / "histories.npz",
    )
    return done, folder / "histories.npz"


def rebounds_of(histories):
    return {h["id"]: rebounds(h["time_s"], h["theta_over_alpha"]).peak[:2] for h in histories}


def distance(value, printed):
    """Relative distance from the interval that rounds to the printed three decimals."""
    nearest = np.clip(value, printed - 5e-4, printed + 5e-4)
    return np.abs(value - nearest) / printed


STEPS = (0.05, 0.02, 0.015)  # of the critical step; rebounds scatter by ±1 % above


@pytest.fixture(scope="module")
def table_rebounds():
    """Rebounds by node count and step with dashpots as YADE's law has them, like the table's."""
    found = {}
    for n in TABLE:
        config = case("", n, 0.1, **CONVENTION)["config"]
        histories = in_yade(
            "facade_cases",
            "rebound_histories",
            config=config,
            beta_s=BETA,
            ratio=0.5,
            limit_s=1.2,
            fractions=STEPS,
        )
        alpha = math.atan2(WALL["thickness_m"], WALL["height_m"])
        for fraction, (t, theta) in histories.items():
            found[n, float(fraction)] = rebounds(np.array(t), np.array(theta) / alpha).peak[:2]
    return found


@pytest.mark.xdist_group("rebounds")
@pytest.mark.parametrize("rebound", [0, 1], ids=["first", "second"])
@pytest.mark.parametrize("column", [0, 1], ids=["yade", "planar"])
@pytest.mark.parametrize("nodes", list(TABLE))
@pytest.mark.parametrize("step", STEPS)
def test_reference_table(table_rebounds, nodes, column, rebound, step):
    """Every value of the table within 1 % of its rounding, with a back face that does not rub.

    The corrected dashpots of an ordinary run give up to 1.5 % more, nearer to the independent
    solver (next test); 0.0794 instead of the table's 0.078 is the largest such difference.
    """
    found = table_rebounds[nodes, step][rebound]
    assert distance(found, TABLE[nodes][column][rebound]) < 0.01


@pytest.mark.parametrize("convention", [CONVENTION, {}], ids=["table", "default"])
def test_independent_solver_with_the_same_nodes(tmp_path, convention):
    """YADE and the planar solver, which share no code, agree within 1 % on both rebounds.

    By the law that YADE ships; with spring and dashpot within μN together the second rebound of
    this wall, whose dashpots are strong, is 1.1 % lower.
    """
    keys = {"base_deg": 30.0, "back_deg": 30.0, "shear": 0.33, **convention}
    wall = Wall(
        0.8,
        0.11,
        1.0,
        1750.0,
        1.8e9,
        beta_s=BETA,
        return_thickness_m=0.22,
        shear_ratio=keys["shear"],
        base_friction_deg=keys["base_deg"],
        back_friction_deg=keys["back_deg"],
        nodes_base=5,
        nodes_up=5,
        bounded=False,
    )
    expected = simulate(wall, duration_s=0.9, theta0_over_alpha=0.5, tolerance=1e-5).rebounds()
    fractions = (0.02, 0.015)
    done, archive = run([case(f"{f}", 5, f, **convention) for f in fractions], tmp_path)
    assert done.returncode == 0, done.stderr
    mean = np.mean(list(rebounds_of(read_archive(archive)).values()), axis=0)
    assert mean == pytest.approx(expected[:2], rel=0.01)


def test_quarter_period_in_the_rigid_limit(tmp_path):
    """acosh(1/(1 − θ0/α))/p, approached from the compliant side as the base stiffens."""
    p = closed_forms.block(0.8, 0.11).p_rad_s
    stiff = {f"{k:g}": k for k in (2.25e9, 1e11, 1e12)}
    done, archive = run(
        [case(name, 5, 0.2, limit_s=0.36, base_stiffness_pa_m=k) for name, k in stiff.items()],
        tmp_path,
    )
    assert done.returncode == 0, done.stderr
    times = []
    for history in read_archive(archive):
        t, theta = history["time_s"], history["theta_over_alpha"]
        i = np.flatnonzero(theta <= 0.0)[0]
        times.append(t[i - 1] + (t[i] - t[i - 1]) * theta[i - 1] / (theta[i - 1] - theta[i]))
    error = np.array(times) / closed_forms.quarter_period(0.5, p) - 1.0
    assert abs(error[-1]) < 0.005
    finite = np.array(times) / closed_forms.quarter_period_finite(0.5, 0.8, 0.11) - 1.0
    assert abs(finite[-1]) < 0.002
    # a soft base moves the pivot inwards: the fall is earlier, and less so as it stiffens
    assert finite[0] < finite[1] < finite[2] + 5e-4


def test_more_damping_less_rebound_and_no_invented_impacts(tmp_path):
    betas = [0.0002, 0.0004, 0.0008, 0.0058]
    done, archive = run([case("wall", 5, 0.05, betas=betas)], tmp_path)
    assert done.returncode == 0, done.stderr
    histories = read_archive(archive)
    assert [h["beta_s"] for h in histories] == betas
    found = [rebounds(h["time_s"], h["theta_over_alpha"]) for h in histories]
    first = [f.peak[0] for f in found[:3]]
    assert np.all(np.diff(first) < 0.0)
    # ζ = 0.5 in base rotation alone: the wall comes to rest against the return walls
    assert len(found[3]) < 3
    assert math.isnan(e_exp(found[3])[2])
    assert all(h["status"] == "ok" for h in histories)


def test_same_cases_same_bytes(tmp_path):
    archives = []
    for name in "ab":
        (tmp_path / name).mkdir()
        done, archive = run([case("wall", 3, 0.1, limit_s=0.5)], tmp_path / name)
        assert done.returncode == 0, done.stderr
        archives.append(archive.read_bytes())
    assert archives[0] == archives[1]


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"beta_s": [-1.0]}, "beta_s between 0 and 1"),
        ({"beta_s": []}, "beta_s between 0 and 1"),
        ({"release_ratio": 1.0}, "θ0/α must lie in"),
        ({"model": "W9"}, "unknown façade model"),
        ({"limit_s": None}, "limit_s"),
    ],
)
def test_bad_cases_stop_in_one_line(tmp_path, change, text):
    done, archive = run([{**case("wall", 3, 0.1), **change}], tmp_path)
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1
    assert done.stderr.startswith("error: ")
    assert text in done.stderr
    assert not archive.exists()


def test_missing_key_is_named(tmp_path):
    broken = case("wall", 3, 0.1)
    del broken["limit_s"]
    done, _ = run([broken], tmp_path)
    assert done.returncode == 1
    assert "wall 1 has no limit_s" in done.stderr


@pytest.mark.slow
@pytest.mark.parametrize("base", ["study", "column"])
def test_committed_law_predicts_a_wall_it_has_not_seen(base, tmp_path):
    """A wall between those of the study, fitted anew, lies in the law's 95 % prediction band."""
    settings = {**resolved()["calibration"], "base": base}
    config = study.batch_wall(settings, 0.2, 2600.0, 9.0, 0.3)
    one = study.wall_case("new", config, 0.5, study.beta_grid(config), role="test")
    done, archive = run([one], tmp_path)
    assert done.returncode == 0, done.stderr
    wall = study.evaluate([one], read_archive(archive))[0]
    fit = study.best_fit(wall["beta_s"], wall["e"] / wall["e_1sr"])
    law, groups = beta.read_law(base=base), beta.groups(config)
    assert law.outside(groups) is None
    _, low, high = law.predict(groups, level=0.95)
    assert low < fit["beta_s"] < high


@pytest.mark.slow
def test_fit_is_the_same_within_one_percent_with_twice_the_nodes_and_half_the_step(tmp_path):
    settings = resolved()["calibration"]
    finer = {
        "nodes_thickness": 2 * settings["nodes_thickness"] - 1,
        "nodes_height": 2 * settings["nodes_height"] - 1,
        "step_fraction": 0.5 * settings["step_fraction"],
    }
    cases = []
    for name, numerics in (("default", {}), ("finer", finer)):
        config = study.batch_wall(settings, 0.11, 1800.0, 0.8 / 0.11, 0.22, **numerics)
        betas = study.beta_grid(config)[1:4]  # the fit lies between them
        cases.append(study.wall_case(name, config, 0.5, betas, role="test"))
    done, archive = run(cases, tmp_path)
    assert done.returncode == 0, done.stderr
    default, fine = (
        study.best_fit(wall["beta_s"], wall["e"] / wall["e_1sr"])
        for wall in study.evaluate(cases, read_archive(archive))
    )
    assert default["beta_s"] == pytest.approx(fine["beta_s"], rel=0.01)
    assert default["single_s"] == pytest.approx(fine["single_s"], rel=0.01)


@pytest.mark.parametrize("base", ["study", "column"])
@pytest.mark.parametrize(
    "sections",
    [
        {"facade": {}},
        {"facade": {**WALL, "e_mpa": 1800.0}, "return_wall": {"thickness_m": 0.11}},
        {
            "facade": {
                "height_m": 3.0,
                "thickness_m": 0.25,
                "width_m": 3.0,
                "e_mpa": 4050.0,
                "density_kg_m3": 1810.0,
            },
            "return_wall": {"thickness_m": 0.25},
        },
    ],
    ids=["façade", "Sorrentino", "Shawa"],
)
def test_committed_law_covers_the_walls_of_the_study(sections, base):
    sections = {**sections, "facade": {**sections["facade"], "base": base}}
    config = resolved(**sections, damping={"law": "fitted"})
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert 1e-4 < beta.beta_for(config) < 1e-2
