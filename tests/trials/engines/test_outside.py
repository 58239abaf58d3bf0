"""What comparisons with outside engines share: the monitored point of a rigid façade."""

import math
from dataclasses import replace

import numpy as np
import pytest
from yade_process import resolved

from tests.trials.engines.outside import Peak
from yade_scripts.model.facade import facade_scene


@pytest.mark.parametrize("angle", [-0.05, 0.0, 0.08])
@pytest.mark.parametrize(("arm", "start"), [(0.0, 0.0), (0.1, 0.02)])
def test_the_top_of_a_turned_facade(angle, arm, start):
    """A rotation about x takes the centroid's arm (y, z) to (y cos − z sin, …): d is the top's way
    from its place at the start of the scene, over the thickness; 1 ends the run."""
    scene = facade_scene(resolved(), "W1", 0.0)
    b, at = scene.thickness_m, scene.index(scene.monitor)
    scene.monitor_point_m = tuple(np.add(scene.monitor_point_m, (0.0, arm, 0.0)))
    scene.blocks[at] = replace(scene.blocks[at], displacement_m=(0.0, start, 0.0))
    peak = Peak(scene)
    block = scene.blocks[at]
    y, z = np.subtract(scene.monitor_point_m, block.centre_m)[1:]
    assert z > 0.0
    turned = complex(y, z) * complex(math.cos(angle), math.sin(angle))
    way = 0.1 + turned.real - y + block.displacement_m[1]
    assert peak.add(0.1, angle) == (abs(way) >= b)
    assert peak.value == pytest.approx(abs(way) / b)
    before = peak.value
    assert not peak.add(0.0, 0.0) or before >= 1.0
    assert peak.value == before  # the largest so far
    assert peak.add(1.1 * b, 0.0)
    assert peak.status == "overturned"
    assert peak.add(math.nan, 0.0)
    assert peak.status == "failed"
