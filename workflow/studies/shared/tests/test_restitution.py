"""Impacts, rebounds and e_exp on histories whose restitution is known by construction."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from rocking.mechanics import closed_forms
from studies.shared import restitution
from studies.shared.restitution import e_exp, e_one_sided, misfit, rebounds

P = 4.27  # 1/s, of a wall 0.8 m high


def rocking(theta0, e, bounces, dt=5e-4, *, contact_s=0.004, dip=0.01, two_sided=False):
    """Linearised rocking θ/α = 1 − (1 − θn)cosh(pt) from maximum to maximum, velocity times e.

    Between two bounces lies a contact of length `contact_s`, with θ down to −dip (one-sided).
    Returns time, θ/α and the exact impact times.
    """
    times, values, impacts, t, side = [], [], [], 0.0, 1.0
    peak, half = theta0, False
    for n in range(bounces + 1):
        quarter = closed_forms.quarter_period(peak, P)
        start = -quarter if half else 0.0
        local = np.arange(0.0, quarter - start, dt) + start
        times.append(t + local - start)
        values.append(side * (1.0 - (1.0 - peak) * np.cosh(P * local)))
        t += quarter - start
        impacts.append(t)
        peak = float(closed_forms.amplitude_after_impacts(theta0, e, n + 1))
        half = True
        if two_sided:
            side = -side
            continue
        local = np.arange(dt, contact_s, dt)
        times.append(t + local)
        values.append(-dip * np.sin(math.pi * local / contact_s))
        t += contact_s
    time, value = np.concatenate(times), np.concatenate(values)
    keep = np.concatenate(([True], np.diff(time) > 1e-9))
    return time[keep], value[keep], np.array(impacts)


@pytest.mark.parametrize("peak_s", [0.03, 0.11, 0.2])
def test_a_maximum_between_uneven_samples_is_that_of_their_parabola(peak_s):
    """Three samples of θ = 2 − 5 (t − t_p)² at uneven times give its vertex to the last digits."""
    time = np.array([-0.4, 0.0, 0.1, 0.35, 0.9])
    values = 2.0 - 5.0 * (time - peak_s) ** 2
    found = restitution._vertex(time, values, 2)
    assert found == pytest.approx((peak_s, 2.0), rel=1e-12)


@pytest.mark.parametrize("e", [0.3, 0.446, 0.7])
@pytest.mark.parametrize("two_sided", [False, True])
def test_known_restitution_is_recovered(e, two_sided):
    time, theta, impacts = rocking(0.5, e, 4, two_sided=two_sided)
    found = rebounds(time, theta, sides="two" if two_sided else "one")
    assert found.release == pytest.approx(0.5, rel=1e-6)
    assert e_exp(found) == pytest.approx([e] * 3, rel=2e-4)
    assert found.impact_time_s[:3] == pytest.approx(impacts[:3], abs=5e-4)
    assert found.peak[:3] == pytest.approx(
        closed_forms.amplitude_after_impacts(0.5, e, np.arange(1, 4)), rel=1e-3
    )


@settings(max_examples=40, deadline=None)
@given(
    theta0=st.floats(0.3, 0.9),
    e=st.floats(0.35, 0.9),
    dt=st.floats(1e-4, 8e-4),
    dip=st.floats(1e-3, 0.05),
)
def test_recovery_does_not_depend_on_sampling_or_contact(theta0, e, dt, dip):
    time, theta, _ = rocking(theta0, e, 4, dt, dip=dip)
    assert e_exp(rebounds(time, theta)) == pytest.approx([e] * 3, rel=2e-3)


def test_rattling_in_the_contact_is_no_impact():
    """A ripple of 5e-5 α during the contact belongs to that contact."""
    time, theta, _ = rocking(0.5, 0.5, 3, dip=0.0)
    rattle = theta + np.where(np.abs(theta) < 1e-12, 5e-5 * np.sin(2 * math.pi * 700.0 * time), 0.0)
    assert e_exp(rebounds(time, rattle)) == pytest.approx([0.5] * 3, rel=1e-3)
    # the same ripple counts once it exceeds the stated smallest rebound
    assert len(rebounds(time, rattle, smallest=1e-5)) > 3


def test_missing_impacts_are_nan_and_never_invented():
    time, theta, _ = rocking(0.5, 0.5, 1)
    found = rebounds(time, theta)
    assert len(found) == 1
    first, second, third = e_exp(found)
    assert first == pytest.approx(0.5, rel=1e-3)
    assert math.isnan(second)
    assert math.isnan(third)
    assert math.isnan(misfit(e_exp(found), 0.446))


def test_overdamped_return_has_no_impact():
    """A wall that creeps to rest from the outside has no rebound at all."""
    time = np.linspace(0.0, 2.0, 2001)
    assert len(rebounds(time, 0.5 * np.exp(-4.0 * time))) == 0
    assert np.all(np.isnan(e_exp(rebounds(time, 0.5 * np.exp(-4.0 * time)))))


def test_a_history_cut_while_rising_has_no_rebound_there():
    time, theta, impacts = rocking(0.5, 0.6, 3)
    quarter = closed_forms.quarter_period(
        float(closed_forms.amplitude_after_impacts(0.5, 0.6, 2)), P
    )
    keep = time < impacts[1] + 0.004 + 0.5 * quarter  # half way up to the second rebound
    assert len(rebounds(time[keep], theta[keep])) == 1


def test_a_history_cut_during_the_first_fall_has_no_impact():
    time, theta, _ = rocking(0.5, 0.6, 3)
    assert len(rebounds(time[:50], theta[:50])) == 0


def test_release_from_the_other_side():
    time, theta, _ = rocking(0.5, 0.6, 3, two_sided=True)
    mirrored = e_exp(rebounds(time, -theta, sides="two"))
    assert mirrored == pytest.approx(e_exp(rebounds(time, theta, sides="two")), rel=1e-12)


@pytest.mark.parametrize(
    ("time", "theta", "text"),
    [
        ([0, 1], [0.5, 0.4], "at least 3"),
        ([0, 1, 2], [0.5, np.nan, 0.1], "finite"),
        ([0, 2, 1], [0.5, 0.4, 0.1], "ascending"),
        ([0, 1, 2], [0.0, 0.4, 0.1], "release"),
        ([0, 1, 2], [-0.5, 0.4, 0.1], "release"),
    ],
)
def test_refusals(time, theta, text):
    with pytest.raises(ValueError, match=text):
        rebounds(time, theta)


def test_misfit_is_zero_inside_the_ranges_and_grows_outside():
    e = 0.446
    assert misfit([0.68 * e, 0.80 * e, e], e) == pytest.approx(0.0, abs=1e-12)
    # one impact off by 0.03: √(0.03²/3)
    assert misfit([0.75 * e, 0.80 * e, e], e) == pytest.approx(0.03 / math.sqrt(3.0))
    assert misfit([0.61 * e, 0.80 * e, e], e) == pytest.approx(0.03 / math.sqrt(3.0))
    for second in (0.71, 0.89):
        assert misfit([0.68 * e, second * e, e], e) == pytest.approx(0.03 / math.sqrt(3.0))
    assert misfit([[0.68, 0.8, 1.0], [0.68, 0.8, 0.9]], 1.0) == pytest.approx(
        [0.0, 0.1 / math.sqrt(3.0)]
    )


def test_target_of_the_validation_wall():
    assert e_one_sided(0.8, 0.11) == pytest.approx(0.446, abs=5e-4)
