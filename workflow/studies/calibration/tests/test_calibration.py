"""Laws of β: eq. 5 against the printed values, the regression against data made from a law."""

import copy
import json
import math
import warnings

import numpy as np
import pytest
from rocking.mechanics import beta as cal
from rocking.mechanics import closed_forms
from study_cases import study_settings


def facade(**keys):
    wall = keys.pop("return_wall", {})
    return study_settings(
        {
            "facade": {"height_m": 0.8, "thickness_m": 0.11, "width_m": 1.0, **keys},
            "return_wall": {"thickness_m": 0.11, **wall},
            "damping": {"law": "fitted"},
        }
    )


def with_law(config, law, **keys):
    config = copy.deepcopy(config)
    config["damping"] = {"law": law, "beta_s": 0.00276, **keys}
    return config


def test_value_and_eq5():
    config = facade()
    assert cal.beta_for(with_law(config, "value", beta_s=0.0031)) == 0.0031
    # b/384 − E/5.6e6 + 0.00074 and the exponent by hand
    expected = (0.11 / 384 - 1800 / 5.6e6 + 0.00074) * math.exp(0.8 / 0.11 * 4772 / 1.2e5)
    assert cal.beta_for(with_law(config, "eq5")) == pytest.approx(expected, rel=1e-12)


def test_eq5_outside_its_walls():
    with pytest.warns(cal.RangeWarning, match="thickness_m = 0.375"):
        assert cal.beta_for(with_law(study_settings({}), "eq5")) == pytest.approx(0.00276, rel=0.01)
    with pytest.raises(cal.CalibrationError, match="positive"):
        cal.beta_for(with_law(facade(e_mpa=7000.0), "eq5"))


def test_free_standing_has_no_law():
    config = study_settings({"facade": {"sides": "two"}, "models": ["W1"]})
    with pytest.raises(cal.CalibrationError, match="expected value"):
        cal.beta_for(with_law(config, "fitted"))


TRUE = {"c0": -1.3, "slenderness": 0.4, "return_wall_ratio": -0.25}


def synthetic_walls():
    walls = []
    for h_over_b in (5.0, 8.0, 12.0, 16.0):
        for t_w in (0.05, 0.11, 0.2):
            for e_mpa in (1800.0, 4050.0):
                config = facade(
                    height_m=0.11 * h_over_b, e_mpa=e_mpa, return_wall={"thickness_m": t_w}
                )
                walls.append(cal.groups(config))
    betas = [
        math.exp(TRUE["c0"])
        * w["slenderness"] ** TRUE["slenderness"]
        * w["return_wall_ratio"] ** TRUE["return_wall_ratio"]
        / w["omega_c_rad_s"]
        for w in walls
    ]
    return walls, np.array(betas)


def test_regression_recovers_a_law_exactly():
    walls, betas = synthetic_walls()
    law = cal.fit_law(walls, betas, ["slenderness", "return_wall_ratio"])
    assert law.coefficients == pytest.approx(
        (TRUE["c0"], TRUE["slenderness"], TRUE["return_wall_ratio"]), abs=1e-9
    )
    assert law.loo_error < 1e-9


def test_leave_one_out_equals_refitting():
    walls, betas = synthetic_walls()
    noisy = betas * np.exp(np.random.default_rng(3).normal(0.0, 0.2, len(betas)))
    names = ["slenderness", "return_wall_ratio"]
    errors = []
    for i in range(len(noisy)):
        rest = [w for j, w in enumerate(walls) if j != i]
        law = cal.fit_law(rest, np.delete(noisy, i), names)
        errors.append(math.log(noisy[i] / law.predict(walls[i])[0]))
    expected = math.sqrt(np.mean(np.square(errors)))
    assert cal.fit_law(walls, noisy, names).loo_error == pytest.approx(expected, rel=1e-9)


def test_band_covers_new_walls_at_its_level():
    """Of many new walls drawn from the law with its scatter, 90 % lie in the 90 % band.

    The scatter that the fits tell has no bias: the mean of 200 of s² with 21 degrees of freedom.
    """
    walls, betas = synthetic_walls()
    rng = np.random.default_rng(11)
    names, inside, total, scatter = ["slenderness", "return_wall_ratio"], 0, 0, []
    for _ in range(200):
        noise = np.exp(rng.normal(0.0, 0.2, len(betas)))
        law = cal.fit_law(walls, betas * noise, names)
        scatter.append(law.residual_std**2)
        for i in (0, 9, 23):
            _, low, high = law.predict(walls[i], level=0.9)
            inside += low < betas[i] * math.exp(rng.normal(0.0, 0.2)) < high
            total += 1
    # binomial: three standard deviations of 600 draws, correlated in threes
    assert inside / total == pytest.approx(0.9, abs=0.06)
    assert np.mean(scatter) == pytest.approx(0.2**2, rel=3.0 * math.sqrt(2.0 / 21.0 / 200.0))


def test_groups_scale_out_of_similar_walls():
    """Walls that are geometrically similar, with E ∝ length, have the same groups."""
    one = cal.groups(facade())
    two = cal.groups(
        facade(
            height_m=1.6,
            thickness_m=0.22,
            width_m=2.0,
            e_mpa=3600.0,
            return_wall={"thickness_m": 0.22},
        )
    )
    for name in one:
        if name != "omega_c_rad_s":
            assert two[name] == pytest.approx(one[name], rel=1e-12)
    assert one["stiffness_ratio"] == pytest.approx(2.0)  # E/(h/2) of the back over E/h
    # jkn·r/(ρb): jkn equal, b doubled
    assert one["omega_c_rad_s"] / two["omega_c_rad_s"] == pytest.approx(math.sqrt(2.0))


def test_refusals():
    walls, betas = synthetic_walls()
    with pytest.raises(cal.CalibrationError, match="at least 4"):
        cal.fit_law(walls[:3], betas[:3], ["slenderness"])
    with pytest.raises(cal.CalibrationError, match="independently"):
        cal.fit_law(walls, betas, ["slenderness", "stiffness_ratio"])
    with pytest.raises(cal.CalibrationError, match="positive"):
        cal.fit_law(walls, -betas, ["slenderness"])


def test_law_file(tmp_path):
    walls, betas = synthetic_walls()
    law = cal.fit_law(walls, betas, ["slenderness", "return_wall_ratio"])
    path = tmp_path / "law.json"
    path.write_text(cal.to_json({"study": law}))
    config = facade()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        beta = cal.beta_for(config, path)
    assert beta == pytest.approx(law.predict(cal.groups(config))[0], rel=1e-7)
    far = facade(return_wall={"thickness_m": 0.5})
    with pytest.warns(cal.RangeWarning, match="return_wall_ratio = 1 outside"):
        cal.beta_for(far, path)
    with pytest.raises(cal.CalibrationError, match="not found"):
        cal.beta_for(config, tmp_path / "none.json")
    column = copy.deepcopy(config)
    column["facade"]["base"] = "column"
    with pytest.raises(cal.CalibrationError, match="no law for facade.base = column"):
        cal.beta_for(column, path)
    path.write_text(cal.to_json({"column": law}))
    assert cal.beta_for(column, path) == beta
    path.write_text(json.dumps({"names": []}))
    with pytest.raises(cal.CalibrationError, match="expected fitted laws"):
        cal.beta_for(config, path)


def test_largest_beta_of_the_study():
    """1/ω of the base-rocking mode of the Sorrentino wall: 0.0058 s in the study."""
    omega = closed_forms.base_rocking_frequency(0.8, 0.11, 1750.0, 1.8e9)
    assert 1.0 / omega == pytest.approx(0.0058, rel=0.005)
