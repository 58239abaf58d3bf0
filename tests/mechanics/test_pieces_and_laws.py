"""Pieces of a mechanism between their heights, and laws of β that are refused."""

import json

import pytest
from plain_facade import PlainFacade, overturning, two_blocks
from rocking.mechanics import beta


def test_pieces_lie_between_hinge_and_top():
    """For drawings: what turns about the base, and the two blocks of a span, each on its path."""
    (one,) = overturning(PlainFacade(6.0, 0.6, 100e3)).pieces
    assert one[:2] == (0.0, 6.0)
    lower, upper = two_blocks(PlainFacade(6.0, 0.6, 100e3), 3.5).pieces
    assert (lower[:2], upper[:2]) == ((0.0, 3.5), (3.5, 6.0))
    meet = [piece[2]((0.0, 3.5))(0.05) for piece in (lower, upper)]
    assert [y.real for y, _ in meet] == pytest.approx([meet[0][0].real] * 2)
    held = upper[2]((0.6, 6.0))
    assert held(0.05)[0].real == pytest.approx(0.6)


@pytest.mark.parametrize("place", [0, 1, -1])
def test_a_law_with_one_coefficient_that_is_no_number_is_refused(tmp_path, place):
    laws = json.loads(beta.LAW_FILE.read_text("utf-8"))
    path = tmp_path / "law.json"
    path.write_text(json.dumps(laws))
    assert set(beta.read_laws(path)) == set(laws)
    name = next(iter(laws))
    laws[name]["coefficients"][place] = float("nan")
    path.write_text(json.dumps(laws))
    with pytest.raises(beta.CalibrationError, match="expected fitted laws"):
        beta.read_laws(path)
