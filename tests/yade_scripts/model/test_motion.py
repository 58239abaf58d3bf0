import numpy as np

from yade_scripts.model.motion import numbers


def test_motions_of_one_time_axis_share_its_numbers():
    """What YADE keeps of every run is then kept once, whatever array the times come in."""
    table = np.column_stack([np.linspace(0.0, 30.0, 501), np.ones(501)])
    shared = numbers(table[:, 0])
    assert shared == table[:, 0].tolist()
    assert numbers(table[:, 0].copy()) is shared
    assert numbers(table[:-1, 0]) == shared[:-1]
