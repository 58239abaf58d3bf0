"""A building that yields in YADE: its sliders are the law, and W2's floors are W2m's masses."""

import numpy as np
import pytest
from rocking import Motion, history
from yade_process import in_yade, resolved

from smdof.chain import floor_motions
from tests.cases import yielding_cases
from yade_scripts.model import storeys, yielding
from yade_scripts.model.models import build_scene

MASS_KG = 66e3
T = np.arange(0.0, 2.5, 0.01)


def pulses():
    """Ground acceleration [m/s²], at rest at both ends."""
    ground = 2.5 * np.sin(2 * np.pi * T / 0.3) * np.exp(-(((T - 1.0) / 0.4) ** 2))
    ground[0] = ground[-1] = 0.0
    return ground


def config(fraction=0.2, **smdof):
    """Configuration of a building that yields at a fifth of its weight."""
    return resolved(
        return_wall={"building_mass_kg": MASS_KG},
        numerics={"step_fraction": fraction, "after_motion_s": 0.1},
        smdof={"base_shear_ratio": 0.2, **smdof},
    )


@pytest.mark.yade
@pytest.mark.parametrize("hardening", [0.0, 0.05])
def test_sliders_between_masses_are_the_bilinear_law(hardening):
    """Drift of every storey, all along, within 1 % of its peak by the chain's own march."""
    given = config(hardening=hardening)
    got = in_yade("twoway_cases", "chain_alone", config=given, ground=pulses().tolist(), dt_s=0.01)
    rows = np.array(got["rows"])
    fine = np.arange(0.0, T[-1], 0.0005)
    ground = np.interp(fine, T, pulses())
    chain = storeys.chain_of(given, 0.0005)
    start, at, drifts = None, 0, []
    for end in np.searchsorted(fine, rows[:, 0]):  # the drift where a sample is
        if end <= at:
            drifts.append(drifts[-1] if drifts else np.zeros(4))
            continue
        _, states = storeys.march(chain, ground[at : end + 1], [1.0], start)
        start, at = states[0], end
        drifts.append(start[8:].reshape(4, storeys.MEMORY)[:, storeys.DRIFT])
    found, expected = np.diff(rows[:, 1:], axis=1, prepend=0.0), np.array(drifts)
    assert np.abs(expected).max(axis=0)[0] > 2.0 * chain.storeys.yield_m[0]
    off = np.abs(found - expected).max(axis=0)
    assert np.all(off < 0.01 * np.abs(expected).max())


@pytest.mark.yade
def test_a_very_heavy_yielding_building_is_one_that_drives():
    """At 1e9 kg W2m, by sliders, has the peak of W2, by floor motions of the march; at 66 t not."""
    motion = floor_motions(0.5 * pulses(), 0.01, tail_s=0.5)
    columns = {"ground": motion.ground_m_s2.tolist()}
    columns |= {f"floor{j}": row.tolist() for j, row in enumerate(motion.floors_m_s2, 1)}
    runs = [("W2", None), ("W2m", 1e9), ("W2m", MASS_KG)]
    given = {"runs": runs, "time_s": motion.time_s.tolist(), "columns": columns}
    found = in_yade("twoway_cases", "shaken", config=config(0.1), **given)
    assert [run["status"] for run in found] == ["ok"] * 3, found
    driven, heavy, real = (run["peak"] for run in found)
    assert heavy == pytest.approx(driven, rel=0.01)
    assert abs(real / driven - 1.0) > 0.02
    elastic = resolved(**{"numerics": {"step_fraction": 0.1, "after_motion_s": 0.1}})
    (other,) = in_yade("twoway_cases", "shaken", config=elastic, **{**given, "runs": runs[:1]})
    assert abs(driven / other["peak"] - 1.0) > 0.05


@pytest.mark.parametrize(
    "wrong", [{"loops": "peak_oriented"}, {"loss_drift_ratio": 0.004}, {"loops": "flag"}]
)
def test_loops_that_no_slider_has_are_refused(wrong):
    job = {**config(**wrong), "model": "W2m", "beta_s": 0.002}
    with pytest.raises(ValueError, match="smdof.loops.*expected bilinear and null"):
        build_scene(job)
    assert build_scene({**job, "model": "W2"}).floors == []


@pytest.mark.yade
@pytest.mark.slow
@pytest.mark.parametrize(("model", "loops"), [("W2", "peak_oriented"), ("W2m", "bilinear")])
def test_both_solvers_have_the_same_peak(model, loops):
    """Of a history that repeats, before a building that yields from a third of its PGA on."""
    case, motion = yielding_cases.case(model, 0.04, loops), Motion.named("RRS228")
    own, other = (
        history(case, motion, "neg", 0.08, solver=solver).d_over_b for solver in ("planar", "yade")
    )
    assert other == pytest.approx(own, rel=0.005)
    elastic = case.varied({"smdof.base_shear_ratio": None})
    assert abs(history(elastic, motion, "neg", 0.08).d_over_b / own - 1.0) > 2e-3


def test_a_vertical_motion_has_no_direction():
    """The other way round the floors turn, and the vertical motion does not."""
    given = {**config(), "model": "W2"}
    time_s, ground = np.arange(0.0, 2.0, 0.001), np.interp(np.arange(0.0, 2.0, 0.001), T, pulses())
    columns = {"ground": ground, **{f"floor{j}": ground for j in range(1, 5)}, "vertical": ground}
    floors = yielding.of_case(given, time_s, columns)
    one, other = floors.at_all([1.5, -1.5])
    assert not one.scaled
    for name in columns:
        sign = 1.0 if name == "vertical" else -1.0
        assert other[name] == pytest.approx(sign * one[name], abs=1e-12)
