"""Closed forms against printed values, ODE solutions of the same problem and each other."""

import numpy as np
import pytest
import sliding_block as sliding
from hypothesis import given, settings
from hypothesis import strategies as st
from rocking.mechanics import closed_forms as cf
from scipy.integrate import solve_ivp

FACADE = {"h_m": 6.48, "b_m": 0.375}
SORRENTINO = (0.8, 0.11)


def linear_rocking(acceleration, alpha, p, end, breaks=(), theta0=0.0):
    """θ̈ = p²(θ − α + a/g) from uplift at t = 0; returns θ, θ̇ at `end`."""
    state, edges = np.array([theta0, 0.0]), [0.0, *breaks, end]
    for start, stop in zip(edges[:-1], edges[1:], strict=True):
        state = solve_ivp(
            lambda t, y: [y[1], p**2 * (y[0] - alpha + acceleration(t) / 9.81)],
            (start, stop),
            state,
            "DOP853",
            rtol=1e-11,
            atol=1e-14,
        ).y[:, -1]
    return state


# Free rocking ------------------------------------------------------------------------------------


def test_block_parameters():
    alpha, radius, p = cf.block(3.0, 4.0)
    assert (np.tan(alpha), radius) == pytest.approx((4.0 / 3.0, 2.5))
    # p² = mgR/I about the toe, I = (4/3)mR²
    assert p**2 == pytest.approx(9.81 * radius / (4.0 / 3.0 * radius**2))


@pytest.mark.parametrize("ratio", [0.01, 0.5, 0.99])
def test_quarter_period(ratio):
    """The block released at θ0 reaches θ = 0 at the quarter period."""
    alpha, _, p = cf.block(*SORRENTINO)
    end = cf.quarter_period(ratio, p)
    theta, _ = linear_rocking(lambda t: 0.0, alpha, p, end, theta0=ratio * alpha)
    assert theta == pytest.approx(0.0, abs=1e-8 * alpha)


def test_finite_quarter_period():
    """Equal to the ODE θ̈ = −p² sin(α − θ), and to the linearised form for a slender block."""
    h, b = 1.0, 0.5
    alpha, _, p = cf.block(h, b)
    hit = lambda t, y: y[0]  # noqa: E731
    hit.terminal = True
    solution = solve_ivp(
        lambda t, y: [y[1], -(p**2) * np.sin(alpha - y[0])],
        (0.0, 9.0),
        [0.6 * alpha, 0.0],
        "DOP853",
        events=hit,
        rtol=1e-12,
        atol=1e-14,
    )
    assert cf.quarter_period_finite(0.6, h, b) == pytest.approx(solution.t[-1], rel=1e-9)
    slender = cf.block(10.0, 0.01)
    expected = cf.quarter_period(0.6, slender.p_rad_s)
    assert cf.quarter_period_finite(0.6, 10.0, 0.01) == pytest.approx(expected, rel=1e-6)
    assert cf.quarter_period_finite(0.6, h, b) > 1.004 * cf.quarter_period(0.6, p)


@settings(max_examples=50, deadline=None)
@given(ratio=st.floats(0.01, 0.99), e=st.floats(0.1, 0.999), n=st.integers(1, 6))
def test_energy_ratio_and_observed_restitution_invert_each_other(ratio, e, n):
    amplitude = cf.amplitude_after_impacts(ratio, e, n)
    assert 0.0 < amplitude < ratio
    assert cf.restitution_observed(-amplitude, ratio, n) == pytest.approx(e, rel=1e-9)
    chained = cf.amplitude_after_impacts(cf.amplitude_after_impacts(ratio, e, n), e, 1)
    assert cf.amplitude_after_impacts(ratio, e, n + 1) == pytest.approx(chained, rel=1e-9)


def test_energy_ratio_is_a_ratio_of_potential_energies():
    """mgR(cos(α − θ) − cos α), nearly quadratic for a slender block."""
    alpha = cf.block(10.0, 0.05).alpha_rad
    energy = lambda t: np.cos(alpha - t * alpha) - np.cos(alpha)  # noqa: E731
    theta = np.array([0.1, 0.4, 0.8])
    assert cf.energy_ratio(theta) == pytest.approx(energy(theta) / energy(1.0), rel=1e-4)


def test_restitution():
    """Housner's value from the angular momentum about the new toe; eq. 3 of Sorrentino's wall."""
    alpha, radius, _ = cf.block(*SORRENTINO)
    before = radius**2 / 3.0 + radius**2 * np.cos(2 * alpha)  # about the new toe, per mass and ω
    after = 4.0 / 3.0 * radius**2
    assert cf.restitution_housner(alpha) == pytest.approx(before / after)
    assert cf.restitution_one_sided(alpha) == pytest.approx(-0.446, abs=5e-4)


# Damping -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("b", "h", "e", "expected"),
    [(0.11, 0.8, 1800, 0.000941), (0.25, 3.0, 4050, 0.000859), (0.375, 6.43, 1800, 0.00276)],
)
def test_equation_5(b, h, e, expected):
    assert cf.beta_one_sided(b, h, e) == pytest.approx(expected, rel=2e-3)


def test_rayleigh():
    omega = np.array([10.0, 40.0])
    assert cf.rayleigh_ratio(omega, 1.0, 0.0) == pytest.approx([0.05, 0.0125])
    base = cf.base_rocking_frequency(*SORRENTINO, 1750.0, 1.8e9)
    assert 1.0 / base == pytest.approx(0.00579, abs=5e-6)
    assert cf.rayleigh_ratio(base, 0.0, 1.0 / base) == pytest.approx(0.5)


# Pulses ------------------------------------------------------------------------------------------


def test_rectangular_threshold_separates_overturning_from_return():
    alpha, _, p = cf.block(**FACADE)
    x = 1.7
    t1 = cf.overturning_rectangular(x, p)
    for factor, overturns in ((1.001, True), (0.999, False)):
        end = factor * t1
        pulse = lambda t, end=end: x * alpha * 9.81 if t <= end else 0.0  # noqa: E731
        theta, _ = linear_rocking(pulse, alpha, p, 9.0 / p, breaks=(end,))
        assert (theta > 2 * alpha) == overturns
    assert cf.overturning_rectangular(1.0, p) == np.inf


@pytest.mark.parametrize(("ratio", "x_cr"), [(2.0, 1.8007), (3.0, 2.2939), (5.0, 3.2891)])
def test_half_sine_threshold(ratio, x_cr):
    alpha, _, p = cf.block(**FACADE)
    x = cf.overturning_half_sine(ratio)
    assert x == pytest.approx(x_cr, abs=5e-5)
    omega = ratio * p
    for factor, overturns in ((1.001, True), (0.999, False)):
        phi = np.arcsin(1.0 / (factor * x))
        length = (np.pi - phi) / omega
        pulse = lambda t, f=factor, phi=phi, end=length: (  # noqa: E731
            f * x * alpha * 9.81 * np.sin(omega * t + phi) if t <= end else 0.0
        )
        theta, _ = linear_rocking(pulse, alpha, p, length + 9.0 / p, breaks=(length,))
        assert (theta > 2 * alpha) == overturns


# Capacity curves ---------------------------------------------------------------------------------


def interlocking(theta, **changes):
    values = {"course_height_m": 0.324, "overlap_m": 0.125, "friction_deg": 30.0} | changes
    friction = np.tan(np.radians(values["friction_deg"]))
    bricks = cf.Interlocked(values["course_height_m"], values["overlap_m"], 0.375, friction)
    given = {**FACADE, "w_m": 4.4, "density_kg_m3": 1800.0, "bricks": bricks}
    return cf.capacity_interlocking(theta, **given, bound=values.get("bound", "upper"))


def test_interlocking_curve():
    """Values of the design, the bare limit, and what the friction adds, by virtual work."""
    theta = np.linspace(0.0, 0.06, 7)
    assert interlocking(0.0) == pytest.approx(0.276, abs=5e-4)
    assert interlocking(0.0, overlap_m=0.25) == pytest.approx(0.494, abs=5e-4)
    bare = cf.capacity_rigid(theta, **FACADE)
    assert interlocking(theta, friction_deg=0.0) == pytest.approx(bare, abs=1e-12)
    assert cf.capacity_rigid(0.0, **FACADE) == pytest.approx(0.058, abs=5e-4)
    upper, lower = interlocking(theta), interlocking(theta, bound="lower")
    assert upper[0] == lower[0]
    assert np.all(lower[1:-1] < upper[1:-1])
    assert np.all(lower >= bare - 1e-12)
    # every joint has slipped by its overlap: nothing is left of the friction
    assert interlocking(np.arcsin(0.125 / 0.3), bound="lower") == pytest.approx(
        cf.capacity_rigid(np.arcsin(0.125 / 0.3), **FACADE)
    )
    # work of the horizontal inertia force over the whole rotation, lower bound:
    # gravity's −W(R − h/2) plus friction work F_i v/2 a joint and wall
    end = cf.block(**FACADE).alpha_rad + 0.4
    weight = 1800 * 9.81 * 6.48 * 0.375 * 4.4
    t = np.linspace(0.0, end, 40001)
    lever = 3.24 * np.cos(t) + 0.1875 * np.sin(t)
    work = np.trapezoid(interlocking(t, bound="lower") * lever, t)
    i = np.arange(1, 20)
    force = np.tan(np.pi / 6) * 1800 * 9.81 * 0.375 * 0.125 * 0.324 * i
    y = 6.48 - 0.324 * i
    slip = np.minimum(y * np.sin(end), 0.125)
    friction = 2 * np.sum(force * (slip - slip**2 / 0.25))
    rise = 0.1875 * np.sin(end) + 3.24 * np.cos(end) - 3.24
    assert weight * work == pytest.approx(weight * rise + friction, rel=1e-6)


def test_compliant_base():
    """Against summed strips of springs, the stiff limit and the small-angle tip-over."""
    h, b, rho = 6.48, 0.375, 1800.0
    jkn = 1.8e9 / h
    s = (np.arange(20000) + 0.5) / 20000 * b  # strips, distance from the toe
    for theta in (1e-4, 3e-3, 0.02):
        target = rho * 9.81 * h * b / jkn
        low, high = 0.0, 0.1  # penetration of the toe that carries the weight
        for _ in range(80):
            toe = 0.5 * (low + high)
            total = np.maximum(0.0, toe - s * np.sin(theta)).mean() * b
            low, high = (toe, high) if total < target else (low, toe)
        pressure = np.maximum(0.0, toe - s * np.sin(theta))
        arm = b / 2 - (pressure @ s) / pressure.sum()
        expected = (arm * np.cos(theta) - h / 2 * np.sin(theta)) / (
            h / 2 * np.cos(theta) + b / 2 * np.sin(theta)
        )
        assert cf.capacity_compliant_base(theta, h, b, rho, jkn) == pytest.approx(
            expected, abs=1e-5
        )
    stiff = cf.capacity_compliant_base(np.array([0.01, 0.04]), h, b, rho, 1e8 * jkn)
    assert stiff == pytest.approx(cf.capacity_rigid(np.array([0.01, 0.04]), h, b), rel=1e-3)
    theta, peak = cf.tip_over_compliant_base(h, b, rho, jkn)
    q = rho * 9.81 * h * b / jkn
    assert theta == pytest.approx((np.sqrt(2 * q) / (3 * h)) ** (2 / 3), rel=0.01)
    near = cf.capacity_compliant_base(theta + np.array([-1e-4, 0.0, 1e-4]), h, b, rho, jkn)
    assert near[1] == pytest.approx(peak)
    assert near[1] >= near.max()
    assert np.isnan(cf.tip_over_compliant_base(h, b, rho, 1e-4 * jkn)[0])


# Sliding -----------------------------------------------------------------------------------------


def test_slip_behind_a_rectangular_pulse():
    dt, a, t1, mu = 0.01, 4.0, 0.2, 0.2
    ground = np.where(np.arange(200) < 20, a, 0.0)
    slip, velocity = sliding.sliding_response(ground, dt, mu)
    assert velocity[-1] == 0.0
    # 19 full steps and a linear drop over the twentieth: half a step less of pulse
    assert -slip[-1] == pytest.approx(sliding.slip_rectangular_pulse(a, t1 - dt / 2, mu), rel=0.02)
    refined = np.where(np.arange(20000) < 2000, a, 0.0)
    slip, _ = sliding.sliding_response(refined, dt / 100, mu)
    assert -slip[-1] == pytest.approx(sliding.slip_rectangular_pulse(a, t1, mu), rel=1e-3)
    assert sliding.slip_rectangular_pulse(1.0, 1.0, 0.2) == 0.0


def test_steady_harmonic_slip():
    omega, mu, a = 2 * np.pi, 0.1, 3.0
    time = np.arange(0, 40 * 2000 + 1) / 2000
    slip, _ = sliding.sliding_response(a * np.sin(omega * time), 1 / 2000, mu)
    swing = 0.5 * np.ptp(slip[-4000:])
    assert swing == pytest.approx(sliding.slip_harmonic(a, omega, mu), rel=1e-3)
    with pytest.raises(ValueError, match="0.537"):
        sliding.slip_harmonic(1.5, omega, mu)


@settings(max_examples=15, deadline=None)
@given(seed=st.integers(0, 1000), mu=st.sampled_from([0.05, 0.1, 0.3]))
def test_event_exact_sliding_converges_to_itself_under_a_stepped_scheme(seed, mu):
    """A crude stick–slip scheme with 400 parts a step approaches the event-exact slip."""
    dt, parts = 0.02, 400
    ground = np.random.default_rng(seed).normal(scale=2.0, size=60)
    slip, velocity = sliding.sliding_response(ground, dt, mu)
    fine = np.interp(np.arange(59 * parts + 1) / parts, np.arange(60), ground)
    s, v, step, limit = 0.0, 0.0, dt / parts, mu * 9.81
    history = [0.0]
    for k in range(fine.size - 1):
        a = 0.5 * (fine[k] + fine[k + 1])
        trial = v - a * step  # frictionless; friction then acts against it, at most to a stop
        new = np.sign(trial) * max(0.0, abs(trial) - limit * step)
        s, v = s + 0.5 * (v + new) * step, new
        history.append(s)
    scale = max(np.abs(slip).max(), 1e-3)
    assert np.abs(np.array(history)[::parts] - slip).max() < 5e-3 * scale


def test_sliding_does_not_depend_on_refinement():
    ground = np.random.default_rng(4).normal(scale=2.0, size=80)
    fine = np.interp(np.arange(79 * 7 + 1) / 7, np.arange(80), ground)
    coarse, _ = sliding.sliding_response(ground, 0.02, 0.1)
    refined, _ = sliding.sliding_response(fine, 0.02 / 7, 0.1)
    assert np.abs(coarse).max() > 1e-3
    assert refined[::7] == pytest.approx(coarse, abs=1e-12)
    # below the limit nothing moves
    still, _ = sliding.sliding_response(ground / np.abs(ground).max() * 0.97, 0.02, 0.1)
    assert np.all(still == 0.0)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: cf.block(-1.0, 1.0), "h_m"),
        (lambda: cf.quarter_period(1.0, 2.0), "theta0_over_alpha"),
        (lambda: interlocking(0.0, course_height_m=0.3), "course_height_m"),
        (lambda: interlocking(0.0, bound="middle"), "bound"),
        (lambda: sliding.sliding_response([0.0, np.inf], 0.01, 0.1), "finite"),
        (lambda: sliding.sliding_response([0.0, 1.0], 0.01, 0.0), "friction"),
    ],
)
def test_bad_input_is_named(call, message):
    with pytest.raises(ValueError, match=message):
        call()
