"""The lumped-mass chain against closed forms, an independent ODE solver and its own energy."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import cumulative_trapezoid, solve_ivp
from scipy.linalg import eigh

from smdof import (
    Chain,
    common_grid,
    floor_motions,
    power_spectrum,
    response_spectrum,
    shear_chain,
    weighted_mean_error,
)
from smdof.oscillator import oscillator_response, refine_linear


def noise(samples=400, seed=1):
    """Band-limited random acceleration that starts and ends at zero."""
    values = np.random.default_rng(seed).normal(size=samples)
    values = np.convolve(values, np.hanning(9), mode="same")
    return values * np.sin(np.linspace(0.0, np.pi, samples)) ** 2


# Modes ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("model", ["modal", "rayleigh"])
def test_damping_matrix_damps_each_mode_by_its_ratio(model):
    """φᵀCφ = 2ζω on the diagonal and nothing beside it, with φᵀMφ = 1; one mass: c = 2ζωm."""
    chain = Chain((2.0, 3.0, 1.0), (50.0, 40.0, 30.0))
    mass, stiffness = chain.matrices()
    values, phi = eigh(stiffness, mass)
    zeta = chain.damping_ratios(0.05, model)
    found = phi.T @ chain.damping_matrix(0.05, model) @ phi
    assert found == pytest.approx(np.diag(2.0 * zeta * np.sqrt(values)), abs=1e-12)
    one = Chain((2.0,), (50.0,)).damping_matrix(0.05)
    assert one[0, 0] == pytest.approx(2.0 * 0.05 * 5.0 * 2.0)


def test_four_masses_have_the_published_modes():
    chain = shear_chain(4, 0.27)
    assert chain.stiffness_n_m[0] / chain.mass_kg[0] == pytest.approx(4489.8, abs=0.05)
    assert chain.periods_s() == pytest.approx([0.270, 0.0938, 0.0612, 0.0499], abs=5e-5)
    assert chain.modes()[1][:, 0] == pytest.approx([0.431, 0.810, 1.091, 1.241], abs=5e-4)


@pytest.mark.parametrize(
    ("n", "top"), list(zip(range(1, 6), [1.000, 1.171, 1.220, 1.241, 1.252], strict=True))
)
def test_first_mode_at_the_top(n, top):
    assert shear_chain(n, 0.27).modes()[1][-1, 0] == pytest.approx(top, abs=5e-4)


@pytest.mark.parametrize("n", [1, 2, 5, 12])
def test_modes_follow_the_closed_form(n):
    """ω_j = 2√(k/m) sin((2j − 1)π/(4n + 2)); participation and effective mass sum to 1."""
    chain = shear_chain(n, 0.31, total_mass_kg=7.0)
    j = np.arange(1, n + 1)
    root = np.sqrt(chain.stiffness_n_m[0] / chain.mass_kg[0])
    omega, participation = chain.modes()
    assert omega == pytest.approx(2.0 * root * np.sin((2 * j - 1) * np.pi / (4 * n + 2)), rel=1e-9)
    assert participation.sum(axis=1) == pytest.approx(np.ones(n), abs=1e-9)
    assert chain.effective_mass_ratio().sum() == pytest.approx(1.0, abs=1e-12)
    assert sum(chain.mass_kg) == pytest.approx(7.0)


def test_rayleigh_gives_the_ratio_at_its_two_modes_and_keeps_modes_uncoupled():
    chain = Chain((3.0, 1.0, 2.0), (900.0, 700.0, 400.0))
    zeta = chain.damping_ratios(0.05, "rayleigh", (1, 3))
    assert zeta[[0, 2]] == pytest.approx([0.05, 0.05], rel=1e-12)
    assert zeta[1] < 0.05
    alpha, beta = chain.rayleigh(0.05, (1, 3))
    mass, stiffness = chain.matrices()
    omega, shares = chain.modes()
    damping = shares.T @ (alpha * mass + beta * stiffness) @ shares
    modal_mass = np.diag(shares.T @ mass @ shares)
    assert damping == pytest.approx(np.diag(2.0 * zeta * omega * modal_mass), abs=1e-9)
    assert shear_chain(1, 0.3).damping_ratios(0.05, "rayleigh") == pytest.approx([0.05])


# Time integration ------------------------------------------------------------------------------


@pytest.mark.parametrize("model", ["modal", "rayleigh"])
def test_chain_agrees_with_an_independent_solver(model):
    """Physical matrices M, C, K in solve_ivp against the modal recurrence."""
    chain = Chain((3.0, 1.0, 2.0), (900.0, 700.0, 400.0))
    dt, ground = 0.02, noise(150)
    mass, stiffness = chain.matrices()
    omega, shares = chain.modes()
    if model == "rayleigh":
        alpha, beta = chain.rayleigh()
        damping = alpha * mass + beta * stiffness
    else:
        phi = shares / np.sqrt(np.diag(shares.T @ mass @ shares))
        damping = mass @ phi @ np.diag(2.0 * 0.05 * omega) @ phi.T @ mass
    inverse = np.diag(1.0 / np.diag(mass))
    state, history = np.zeros(6), [np.zeros(6)]
    for left, right in zip(ground[:-1], ground[1:], strict=True):

        def rate(t, y, left=left, right=right):
            a = left + (right - left) * t / dt
            return np.concatenate((y[3:], -inverse @ (damping @ y[3:] + stiffness @ y[:3]) - a))

        state = solve_ivp(rate, (0.0, dt), state, "DOP853", rtol=1e-12, atol=1e-14).y[:, -1]
        history.append(state)
    history = np.array(history).T
    motion = floor_motions(ground, dt, chain=chain, damping_model=model, refine=1)
    assert motion.relative_m == pytest.approx(history[:3], abs=1e-11)
    assert motion.relative_m_s == pytest.approx(history[3:], abs=1e-10)
    absolute = -inverse @ (damping @ history[3:] + stiffness @ history[:3])
    assert motion.floors_m_s2 == pytest.approx(absolute, abs=1e-9)


@settings(max_examples=25, deadline=None)
@given(
    n=st.integers(1, 5),
    refine=st.integers(2, 17),
    dt=st.sampled_from([0.002, 0.005, 0.01, 0.05]),
    seed=st.integers(0, 99),
)
def test_refining_the_step_changes_nothing_at_the_record_instants(n, refine, dt, seed):
    ground = noise(200, seed)
    coarse = floor_motions(ground, dt, shear_chain(n, 0.27), refine=1)
    fine = floor_motions(ground, dt, shear_chain(n, 0.27), refine=refine)
    scale = np.abs(coarse.floors_m_s2).max()
    assert np.abs(fine.floors_m_s2[:, ::refine] - coarse.floors_m_s2).max() < 1e-10 * scale
    scale = np.abs(coarse.relative_m).max()
    assert np.abs(fine.relative_m[:, ::refine] - coarse.relative_m).max() < 1e-10 * scale


def test_energy_balance():
    """Input work −∫m a_g u̇ = kinetic + spring + dissipated, with an undamped and a damped chain."""
    chain = shear_chain(3, 0.27)
    mass, stiffness = chain.matrices()
    for zeta in (0.0, 0.05):
        m = floor_motions(noise(), 0.01, chain=chain, damping_ratio=zeta, refine=200)
        omega, shares = chain.modes()
        phi = shares / np.sqrt(np.diag(shares.T @ mass @ shares))
        modal_v = phi.T @ mass @ m.relative_m_s
        kinetic = 0.5 * np.einsum("it,ij,jt->t", m.relative_m_s, mass, m.relative_m_s)
        spring = 0.5 * np.einsum("it,ij,jt->t", m.relative_m, stiffness, m.relative_m)
        power_in = -(np.diag(mass) @ m.relative_m_s) * m.ground_m_s2
        power_out = (2.0 * zeta * omega) @ modal_v**2
        work = cumulative_trapezoid(power_in, m.time_s, initial=0.0)
        lost = cumulative_trapezoid(power_out, m.time_s, initial=0.0)
        residual = np.abs(work - lost - kinetic - spring).max()
        assert residual < 1e-5 * np.abs(work).max()
        assert (lost[-1] > 0.1 * np.abs(work).max()) == (zeta > 0.0)


def test_free_decay_has_the_logarithmic_decrement():
    zeta, omega = 0.05, 2.0 * np.pi / 0.27
    period = 2.0 * np.pi / (omega * np.sqrt(1.0 - zeta**2))
    q, _ = oscillator_response(np.zeros(1001), period / 100, omega, zeta, q0_m=0.01)
    decrement = np.log(q[0:900:100] / q[100:1000:100])
    assert decrement == pytest.approx(2.0 * np.pi * zeta / np.sqrt(1.0 - zeta**2), rel=1e-9)


def test_harmonic_steady_state_matches_transmissibility():
    """|a_abs|/|a_g| = √((1 + (2ζr)²)/((1 − r²)² + (2ζr)²)), r = ω/ω₀."""
    zeta, dt = 0.05, 0.27 / 400
    time = np.arange(0, 40 * 400) * dt
    for ratio in (0.5, 1.0, 2.0):
        frequency = ratio / 0.27
        sine = np.sin(2 * np.pi * frequency * time)
        motion = floor_motions(sine, dt, shear_chain(1, 0.27), refine=1)
        late = motion.floors_m_s2[0, -800:]
        expected = np.sqrt(
            (1 + (2 * zeta * ratio) ** 2) / ((1 - ratio**2) ** 2 + (2 * zeta * ratio) ** 2)
        )
        assert late.max() == pytest.approx(expected, rel=1e-3)


def test_slow_ramp_is_static():
    """Storey shears carry the masses above: k(u_i − u_{i−1}) = −a Σ_{j≥i} m_j."""
    ground = np.append(np.linspace(0.0, 1.0, 4001), np.ones(2000))
    chain = shear_chain(4, 0.27)
    motion = floor_motions(ground, 0.01, chain=chain, refine=1)
    drift = np.diff(motion.relative_m[:, -1], prepend=0.0)
    above = np.cumsum(chain.mass_kg[::-1])[::-1]
    assert drift == pytest.approx(-above / np.array(chain.stiffness_n_m), rel=1e-9)
    assert motion.floors_m_s2[:, -1] == pytest.approx(np.ones(4), rel=1e-9)


def test_integrated_floor_motion_does_not_drift():
    """Twice-integrated floor minus ground acceleration is the relative displacement.

    The straight lines between samples are what drives a support, so this bounds
    its position error: O(step²), here below 0.3 % of the peak drift, and four
    times smaller at half the step.
    """
    errors = []
    for refine in (None, 22):
        m = floor_motions(noise(), 0.01, shear_chain(4, 0.27), refine=refine, tail_s=10.0)
        difference = m.floors_m_s2 - m.ground_m_s2
        step = m.time_s[1]
        velocity = cumulative_trapezoid(difference, dx=step, initial=0.0)
        # exact integral of a velocity whose acceleration is linear within a step
        gain = velocity[:, :-1] * step + step**2 * (
            difference[:, :-1] / 3.0 + difference[:, 1:] / 6.0
        )
        position = np.concatenate((np.zeros((4, 1)), np.cumsum(gain, axis=1)), axis=1)
        errors.append(np.abs(position - m.relative_m).max() / np.abs(m.relative_m).max())
        peak = np.abs(m.relative_m_s).max()
        assert np.abs(velocity - m.relative_m_s).max() < 3e-3 * peak
        assert np.abs(velocity[:, -1]).max() < 1e-4 * peak  # at rest after the tail
    assert m.refine == 22
    assert errors[0] < 3e-3
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.15)


def test_output_step_and_tail():
    shortest = shear_chain(4, 0.27).periods_s()[-1]
    m = floor_motions(noise(), 0.01, shear_chain(4, 0.27), tail_s=1.0)
    assert m.refine == np.ceil(0.01 / (shortest / 50))
    assert m.time_s[1] <= shortest / 50
    assert m.time_s[-1] == pytest.approx(3.99 + 0.01 + 1.0)
    assert np.abs(m.floors_m_s2[:, -1]).max() < 0.5 * np.abs(m.floors_m_s2).max()
    # a record that ends away from zero falls to it linearly within one record step
    m = floor_motions([0.0, 2.0], 0.1, shear_chain(1, 0.5), refine=10, tail_s=0.2)
    assert m.ground_m_s2[10:21] == pytest.approx(np.linspace(2.0, 0.0, 11))
    assert np.all(m.ground_m_s2[20:] == 0.0)


def test_refine_linear_keeps_samples_exactly():
    values = noise(50)
    assert np.array_equal(refine_linear(values, 7)[::7], values)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: shear_chain(0, 0.27), "n_dof"),
        (lambda: shear_chain(2, -1.0), "period_s"),
        (lambda: Chain((1.0, 2.0), (1.0,)), "one stiffness a mass"),
        (lambda: Chain((1.0, -2.0), (1.0, 1.0)), r"mass_kg\[1\]"),
        (lambda: floor_motions([0.0, np.nan, 0.0], 0.01), "sample 1"),
        (lambda: floor_motions([0.0], 0.01), "at least 2"),
        (lambda: floor_motions([0.0, 1.0], 0.0), "step must be positive"),
        (lambda: floor_motions([0.0, 1.0], 0.1, refine=0), "refine"),
        (lambda: floor_motions([0.0, 1.0], 0.1, tail_s=-1.0), "tail_s"),
        (lambda: floor_motions([0.0, 1.0], 0.1, damping_ratio=1.0), "damping ratios"),
        (lambda: floor_motions([0.0, 1.0], 0.1, damping_model="none"), "damping_model"),
        (
            lambda: floor_motions([0.0, 1.0], 0.1, damping_model="rayleigh", rayleigh_modes=(1, 9)),
            "rayleigh_modes",
        ),
        (lambda: response_spectrum([0.0, 1.0], 0.1, [-1.0]), "periods_s"),
        (lambda: power_spectrum([0.0, 1.0], 0.1, method="fft"), "method"),
    ],
)
def test_bad_input_is_named(call, message):
    with pytest.raises(ValueError, match=message):
        call()


# Spectra -----------------------------------------------------------------------------------------


def test_response_spectrum_limits_and_chain_agree():
    """Rigid: PGA. Soft: Sd → peak ground displacement. n = 1 chain: the same numbers."""
    # second differences: velocity and displacement of the ground end at zero
    dt, ground = 0.01, np.pad(np.diff(np.pad(noise(600, 3), 4), 2), 1)
    # the exact displacement of a piecewise-linear acceleration, as a limit to meet
    velocity = cumulative_trapezoid(ground, dx=dt, initial=0.0)
    gain = velocity[:-1] * dt + dt**2 * (ground[:-1] / 3 + ground[1:] / 6)
    displacement = np.abs(np.cumsum(gain)).max()
    spectrum = response_spectrum(ground, dt, [0.0, 0.005, 0.27, 4e4], damping_ratio=0.05)
    assert spectrum.sa_m_s2[0] == np.abs(ground).max()
    assert spectrum.psa_m_s2[1] == pytest.approx(np.abs(ground).max(), rel=0.02)
    motion = floor_motions(ground, dt, shear_chain(1, 0.27), refine=4, tail_s=0.5)
    assert spectrum.sa_m_s2[2] == pytest.approx(np.abs(motion.floors_m_s2).max(), rel=2e-3)
    assert spectrum.sd_m[3] == pytest.approx(displacement, rel=1e-4)
    undamped = response_spectrum(ground, dt, [0.1, 0.5, 2.0], damping_ratio=0.0)
    assert undamped.sa_m_s2 == pytest.approx(undamped.psa_m_s2, rel=1e-12)


def test_response_spectrum_of_a_rectangular_pulse():
    """Sd = (2a/ω²) for pulses longer than T/2, (2a/ω²) sin(πt_d/T) for shorter ones."""
    dt, duration = 1e-4, 0.2
    ground = np.where(np.arange(0, 5001) * dt <= duration, 1.0, 0.0)
    periods = np.array([0.1, 0.3, 0.6, 1.0, 3.0])
    omega = 2 * np.pi / periods
    factor = np.where(duration > periods / 2, 2.0, 2.0 * np.sin(np.pi * duration / periods))
    spectrum = response_spectrum(ground, dt, periods, damping_ratio=0.0)
    assert spectrum.sd_m == pytest.approx(factor / omega**2, rel=1.5e-3)


def test_power_spectrum_keeps_the_mean_square_and_finds_a_sine():
    dt, ground = 0.005, noise(4000, 5)
    full = power_spectrum(ground, dt, method="periodogram")
    step = full.frequency_hz[1]
    assert full.power_m2_s3.sum() * step == pytest.approx(np.mean(ground**2), rel=1e-12)
    time = np.arange(8000) * dt
    welch = power_spectrum(3.0 * np.sin(2 * np.pi * 3.7 * time), dt)
    assert welch.frequency_hz[np.argmax(welch.power_m2_s3)] == pytest.approx(3.7, abs=0.051)
    area = welch.power_m2_s3.sum() * welch.frequency_hz[1]
    assert area == pytest.approx(4.5, rel=0.01)


def test_welch_windows_its_segments_with_hann():
    """A sine on a line: A²/2 spread by the noise bandwidth 3/2 of Hann; half way between two
    lines its leakage falls like the sixth power of the distance, not the second."""
    dt, line = 0.005, 0.1
    time = np.arange(8000) * dt
    on = power_spectrum(2.0 * np.sin(2 * np.pi * 4.0 * time), dt).power_m2_s3
    assert on.max() == pytest.approx(2.0 / (1.5 * line), rel=1e-3)
    off = power_spectrum(2.0 * np.sin(2 * np.pi * 4.05 * time), dt)
    far = np.interp(6.0, off.frequency_hz, off.power_m2_s3)
    assert far < 1e-6 * off.power_m2_s3.max()  # a rectangular window leaves 7e-4


# Weighted mean error -----------------------------------------------------------------------------


def test_wme_of_known_curves():
    x = np.linspace(0.0, 2.0, 2001)
    y = np.sin(np.pi * x)
    assert weighted_mean_error(x, y, y) == 0.0
    assert weighted_mean_error(x, y, np.zeros_like(y)) == pytest.approx(1.0)
    assert weighted_mean_error(x, y, 1.3 * y) == pytest.approx(0.3)
    assert weighted_mean_error(x, y, -y) == pytest.approx(2.0)
    # ∫₀²|0.5 dx| / ∫₀²|sin πx| dx = 1/(4/π)
    assert weighted_mean_error(x, y, y + 0.5) == pytest.approx(np.pi / 4, rel=1e-5)


@settings(max_examples=30, deadline=None)
@given(scale=st.floats(1e-3, 1e3), stretch=st.floats(1e-3, 1e3), seed=st.integers(0, 50))
def test_wme_does_not_depend_on_units(scale, stretch, seed):
    rng = np.random.default_rng(seed)
    x = np.cumsum(rng.uniform(0.1, 1.0, 60))
    y, other = rng.normal(size=(2, 60))
    expected = weighted_mean_error(x, y, other)
    assert weighted_mean_error(stretch * x, scale * y, scale * other) == pytest.approx(expected)


def test_common_grid_keeps_every_sample_and_refuses_disjoint_curves():
    x, y1, y2 = common_grid([0, 1, 2], [0, 1, 0], [0.5, 1.5, 3.0], [2, 4, 1])
    assert x == pytest.approx([0.5, 1.0, 1.5, 2.0])
    assert y1 == pytest.approx([0.5, 1.0, 0.5, 0.0])
    assert y2 == pytest.approx([2.0, 3.0, 4.0, 3.0])
    x, _, _ = common_grid([0, 1, 2], [0, 1, 0], [0, 3], [0, 1], x_range=(0.25, 1.5))
    assert (x[0], x[-1]) == (0.25, 1.5)
    with pytest.raises(ValueError, match="do not overlap"):
        common_grid([0, 1], [0, 1], [1, 2], [0, 1])
    with pytest.raises(ValueError, match="share only"):
        common_grid([0, 2], [0, 1], [1, 3], [0, 1], x_range=(0, 2))
    with pytest.raises(ValueError, match="increase"):
        common_grid([0, 0, 1], [0, 1, 2], [0, 1], [0, 1])
    with pytest.raises(ValueError, match="zero everywhere"):
        weighted_mean_error([0, 1], [0, 0], [1, 1])
