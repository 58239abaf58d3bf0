"""Side views: a block turned about its centre, a façade that leans over its toe."""

import numpy as np
import pytest
from studies.shared import drawings

from yade_scripts.model.facade import FACADE
from yade_scripts.model.scene import Block

ANGLE = 0.3


def block(name, centre, size):
    return Block(name, centre, size, 1.0, (1.0, 1.0, 1.0), free="")


def test_an_outline_is_the_near_face_of_the_drawn_box():
    centre, size = np.array([0.0, 1.0, 3.0]), np.array([0.2, 0.4, 2.0])
    box = drawings.corners(centre, size, 2.0, 2.0)[:4]
    turned = drawings.turned(box, centre, ANGLE) + (0.0, 0.5, -0.25)
    found = drawings.outline(centre, size, (0.5, -0.25, ANGLE))
    order = [0, 1, 2, 3]  # lower inner, lower outer, upper outer, upper inner
    np.testing.assert_allclose(found[order], turned[:, 1:], atol=1e-12)


def test_a_leaning_facade_stands_on_its_toe_and_takes_level_headers_along():
    b, h = 0.4, 6.0
    facade = block(FACADE, (0.0, 0.5 * b, 0.5 * h), (7.0, b, h))
    shape = drawings.outline(facade.centre_m, facade.size_m, drawings.leaning(facade, ANGLE, b))
    np.testing.assert_allclose(shape[1], (b, 0.0), atol=1e-12)  # lower outer corner
    top = shape[2]
    np.testing.assert_allclose(top, (b + h * np.sin(ANGLE), h * np.cos(ANGLE)))
    header = block("wall 1 header 3", (0.0, 0.1, 2.0), (0.2, 0.25, 0.08))
    dy, dz, angle = drawings.leaning(header, ANGLE, b)
    assert (dy, dz, angle) == (pytest.approx(2.0 * np.sin(ANGLE)), 0.0, 0.0)
    assert drawings.leaning(block("wall 1 brick 2", (0, 0, 1), (1, 1, 1)), ANGLE, b) == (0, 0, 0)
