"""Where β comes from: the value given, the study's eq. 5, or this project's own regression.

The regression is a power law between dimensionless groups. A contact that is linear while
closed dissipates by ζ = βω/2, so β times a contact frequency is the natural unknown:

    β·ω_c = exp(c0) · Π x_i^c_i,      ω_c = √(jkn·r/(ρ·b))

with jkn the joint stiffness at the return walls, r their total thickness over the façade's
width, and ω_c the frequency of the façade's mass on its return walls. The coefficients, one set
for each `facade.base`, stand in `config/beta_law.json`, which the calibration study generates and a
person copies there.
"""

import json
import math
import warnings
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
import scipy

from rocking.mechanics import closed_forms
from rocking.shipped import shipped
from yade_scripts.lists import listed
from yade_scripts.model import base as bases
from yade_scripts.model.facade import joint_stiffness
from yade_scripts.model.facades import Facade

LAW_FILE = shipped("config/beta_law.json")
# the walls from which eq. 5 was regressed
EQ5_THICKNESS_M = (0.11, 0.30)
EQ5_MODULUS_MPA = (1800.0, 4050.0)


class CalibrationError(ValueError):
    """A calibration that cannot be done or used; the text is one line."""


class RangeWarning(UserWarning):
    """β was asked for outside the range in which its law was fitted."""


def groups(config: Mapping) -> dict[str, float]:
    """Dimensionless groups of a façade, by name, and its contact frequency `omega_c_rad_s`.

    Of sections facade and return_wall of a resolved configuration::

        slenderness        h/b
        return_wall_ratio  r = count·t_w/w
        stiffness_ratio    jkn of the return walls over jkn of the base
        base_stiffness     jkn_base/(ρ·g), which is E/(ρgh) unless stated: height over the
                           settlement under the own weight
        omega_c_rad_s      √(jkn·r/(ρ·b)) [rad/s], which makes β dimensionless
    """
    facade, wall = Facade.of(config["facade"]), config["return_wall"]
    h, b, density = facade.height_m, facade.thickness_m, facade.density_kg_m3
    base, back = joint_stiffness(config)
    ratio = wall["count"] * wall["thickness_m"] / facade.width_m
    return {
        "slenderness": h / b,
        "return_wall_ratio": ratio,
        "stiffness_ratio": back / base,
        "base_stiffness": base / (density * closed_forms.GRAVITY_M_S2),
        "omega_c_rad_s": math.sqrt(back * ratio / (density * b)),
    }


@dataclass(frozen=True)
class PowerLaw:
    """A fitted power law β·ω_c = exp(c0)·Π x_i^c_i."""

    names: tuple  # of the groups x_i, see `groups`
    coefficients: tuple  # c0, then the exponents
    covariance: tuple  # of the coefficients, by rows
    residual_std: float  # standard deviation of ln β about the law
    freedom: int  # degrees of freedom left by the fit
    ranges: dict  # smallest and largest value of every group among the fitted walls
    loo_error: float  # root mean square of the leave-one-out residuals of ln β

    def outside(self, values):
        """Return one line about the first group outside the fitted range, or None."""
        for name, (low, high) in self.ranges.items():
            value = values[name]
            if not low * (1 - 1e-9) <= value <= high * (1 + 1e-9):
                return f"{name} = {value:.4g} outside the fitted {low:.4g} to {high:.4g}"
        return None

    def predict(self, values, level=0.9):
        """β and the ends of its prediction band for a wall's `groups` [s], Student's t in ln β."""
        row = np.array([1.0, *(math.log(values[name]) for name in self.names)])
        mean = float(row @ np.array(self.coefficients))
        spread = math.sqrt(self.residual_std**2 + float(row @ np.array(self.covariance) @ row))
        half = float(scipy.stats.t.ppf(0.5 + 0.5 * level, self.freedom)) * spread
        omega = values["omega_c_rad_s"]
        return tuple(math.exp(mean + shift) / omega for shift in (0.0, -half, half))

    def along(self, configs):
        """β and the ends of its 90 % band [s] of several configurations, each of shape (n,)."""
        return np.array([self.predict(groups(config)) for config in configs]).T


def to_json(laws):
    """Text of the laws' file, with 9 significant digits; `laws` by the base they were fitted on."""
    text = json.dumps({base: asdict(law) for base, law in laws.items()})
    rounded = json.loads(text, parse_float=lambda digits: float(f"{float(digits):.9g}"))
    return json.dumps(rounded, indent=1) + "\n"


def fit_law(walls, betas_s, names):
    """Least-squares power law through fitted β [s] of walls (`groups` of each).

    Ordinary least squares of ln(β·ω_c) on ln x of the groups `names`. The leave-one-out residual of
    wall i is r_i/(1 − H_ii) with H the hat matrix, exactly what refitting without it would give. A
    CalibrationError for too few walls, a β that is not positive, or groups that do not vary
    independently.
    """
    betas = np.asarray(betas_s, float)
    if len(walls) != len(betas) or len(betas) < len(names) + 3:
        raise CalibrationError(
            f"regression of β: {len(betas)} walls, expected at least {len(names) + 3} "
            f"for {len(names)} groups"
        )
    if not (np.all(np.isfinite(betas)) and np.all(betas > 0.0)):
        raise CalibrationError("regression of β: expected positive, finite β for every wall")
    x = np.array([[1.0, *(math.log(w[name]) for name in names)] for w in walls])
    y = np.log(betas * np.array([w["omega_c_rad_s"] for w in walls]))
    if np.linalg.matrix_rank(x) < x.shape[1]:
        raise CalibrationError(f"regression of β: {listed(names)} do not vary independently")
    inverse = np.linalg.inv(x.T @ x)
    coefficients = inverse @ x.T @ y
    residual = y - x @ coefficients
    freedom = len(y) - x.shape[1]
    variance = float(residual @ residual) / freedom
    leverage = np.einsum("ij,jk,ik->i", x, inverse, x)
    loo = residual / (1.0 - leverage)
    every = [name for name in walls[0] if name != "omega_c_rad_s"]
    return PowerLaw(
        names=tuple(names),
        coefficients=tuple(map(float, coefficients)),
        covariance=tuple(tuple(map(float, row)) for row in variance * inverse),
        residual_std=math.sqrt(variance),
        freedom=freedom,
        ranges={n: (min(w[n] for w in walls), max(w[n] for w in walls)) for n in every},
        loo_error=float(np.sqrt(np.mean(loo**2))),
    )


def half_widths(law):
    """Half widths of the coefficients' 95 % confidence intervals (Student's t)."""
    factor = float(scipy.stats.t.ppf(0.975, law.freedom))
    return factor * np.sqrt(np.diag(np.array(law.covariance)))


def read_law(path=LAW_FILE, base=bases.STUDY):
    """Read the law that was fitted on a base; a CalibrationError where the file has none for it."""
    laws = read_laws(path)
    if base not in laws:
        raise CalibrationError(
            f"{path}: no law for facade.base = {base}; `snakemake calibration` with "
            f"calibration.base = {base} makes one, to be copied there"
        )
    return laws[base]


def read_laws(path=LAW_FILE):
    """Read the laws of a file, by the base they were fitted on; a CalibrationError without them."""
    try:
        data = json.loads(Path(path).read_text("utf-8"))
        laws = {base: PowerLaw(**law) for base, law in data.items()}
        for law in laws.values():
            sizes = len(law.coefficients), len(law.names)
            if sizes[0] != 1 + sizes[1] or not np.all(np.isfinite(law.coefficients)):
                raise ValueError("coefficients do not match the names")
    except OSError:
        raise CalibrationError(
            f"{path}: not found; `snakemake calibration` makes one, to be copied there"
        ) from None
    except (AttributeError, ValueError, TypeError) as error:
        raise CalibrationError(f"{path}: expected fitted laws of β ({error})") from None
    return laws


def beta_for(config: Mapping, law_file=LAW_FILE) -> float:
    """β [s] of a façade's contacts by the law that its resolved configuration chooses.

    `law_file` has the coefficients of `fitted`. A RangeWarning outside the range of the walls
    behind eq. 5 or behind the fitted law; a CalibrationError where eq. 5 gives no positive β, for a
    free-standing façade with either, or without a usable law file.
    """
    beta, outside = _beta(config, law_file)
    for line in outside:
        warnings.warn(line, RangeWarning, stacklevel=2)
    return beta


def beta_and_range(config: Mapping, law_file=LAW_FILE) -> tuple[float, str]:
    """β as `beta_for`, and in one line what lies outside the range of its law; else nothing."""
    beta, outside = _beta(config, law_file)
    return beta, "; ".join(outside)


def _beta(config: Mapping, law_file) -> tuple[float, list[str]]:
    """β, and a line for each value outside the range of its law."""
    damping, facade = config["damping"], Facade.of(config["facade"])
    if damping["law"] == "value":
        return float(damping["beta_s"]), []
    if facade.is_free:
        raise CalibrationError(
            f"config: damping.law = {damping['law']}: expected value with facade.sides = two, "
            "since both laws describe impacts against return walls"
        )
    if damping["law"] == "eq5":
        b, e_mpa = facade.thickness_m, facade.e_mpa
        beta = closed_forms.beta_one_sided(b, facade.height_m, e_mpa)
        if not beta > 0.0:
            raise CalibrationError(
                f"config: damping.law = eq5: β = {beta:.3g} s for thickness_m = {b:g}, "
                f"e_mpa = {e_mpa:g}; expected a wall for which eq. 5 is positive"
            )
        outside = [
            f"damping.law = eq5: {name} = {value:g}, and eq. 5 was fitted to walls of {low:g} to "
            f"{high:g} {unit}"
            for name, unit, value, (low, high) in (
                ("thickness_m", "m", b, EQ5_THICKNESS_M),
                ("e_mpa", "MPa", e_mpa, EQ5_MODULUS_MPA),
            )
            if not low <= value <= high
        ]
        return beta, outside
    law, values = read_law(law_file, facade.base), groups(config)
    problem = law.outside(values)
    return law.predict(values)[0], [f"damping.law = fitted: {problem}"] if problem else []
