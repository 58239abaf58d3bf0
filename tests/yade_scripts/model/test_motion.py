import numpy as np
import pytest
from yade_process import resolved

from yade_scripts.model import floor_motions
from yade_scripts.model.facade import facade_scene
from yade_scripts.model.motion import SupportMotion, amplitude, numbers


def test_motions_of_one_time_axis_share_its_numbers():
    """What YADE keeps of every run is then kept once, whatever array the times come in."""
    table = np.column_stack([np.linspace(0.0, 30.0, 501), np.ones(501)])
    shared = numbers(table[:, 0])
    assert shared == table[:, 0].tolist()
    assert numbers(table[:, 0].copy()) is shared
    assert numbers(table[:-1, 0]) == shared[:-1]


def test_position_is_the_double_integral():
    """Up to 2 m/s² in a second, down in two: t³/3, then by the same rule; 3 m/s from then on."""
    motion = SupportMotion(np.array([0.0, 1.0, 3.0]), np.array([0.0, 2.0, 0.0]))
    expected = [0.0, 1.0 / 24.0, 1.0 / 3.0, 13.0 / 6.0, 5.0, 8.0]
    assert motion.position([0.0, 0.5, 1.0, 2.0, 3.0, 4.0]) == pytest.approx(expected)
    assert motion.peak_speed() == pytest.approx(3.0)


def test_a_motion_ends_at_zero():
    """One more sample where it does not, as far on as the one before."""
    motion = SupportMotion(np.array([0.0, 0.1]), np.array([0.0, 1.0]))
    assert motion.time_s == pytest.approx([0.0, 0.1, 0.2])
    assert motion.acceleration_m_s2.tolist() == [0.0, 1.0, 0.0]
    assert motion.duration_s == pytest.approx(0.2)


def test_amplitude_brings_the_peak_to_a_pga():
    """0.2 g over a peak of 4 m/s², in standard gravity; the mirror image has the other sign."""
    ground = np.array([0.5, -4.0, 2.0])
    assert amplitude(ground, "pos", 0.2) == pytest.approx(0.2 * 9.80665 / 4.0, rel=1e-6)
    assert amplitude(ground, "neg", 0.2) == -amplitude(ground, "pos", 0.2)


def test_a_scene_without_one_of_its_motions_is_refused():
    """W2 of four masses is not shaken by the motions of three."""
    scene = facade_scene(resolved(), "W2", 0.001)
    columns = {name: np.zeros(3) for name in ("ground", "floor1", "floor2", "floor3")}
    with pytest.raises(ValueError, match="the motion file has no column for floor4"):
        floor_motions.shaken(scene, columns)
    columns["floor4"] = columns["vertical"] = np.ones(3)
    assert floor_motions.shaken(scene, columns)[0].vertical == "vertical"


def test_floor_motions_are_read_as_they_were_written(tmp_path):
    t, columns = np.arange(4) / 3.0, {"ground": np.sin(np.arange(4)), "vertical": np.ones(4) / 7.0}
    floor_motions.write_columns(tmp_path / "whole.csv", t, columns, digits=17)
    time_s, found = floor_motions.read(tmp_path / "whole.csv")
    assert np.array_equal(time_s, t)
    assert all(np.array_equal(found[name], values) for name, values in columns.items())
