"""What a piece of return wall takes from the masses, by height."""

import pytest

from yade_scripts.model.wall_motion import motion_of, storey_of


@pytest.mark.parametrize(
    ("height_m", "floor"),
    [(0.0, 1), (0.7, 1), (1.49, 1), (1.51, 2), (2.9, 2), (5.9, 4), (6.0, 4)],
)
def test_a_piece_moves_with_the_mass_at_the_top_of_its_storey(height_m, floor):
    """Four storeys of 1.5 m: all of one, its upper half too, moves with the mass above it."""
    assert storey_of(height_m / 6.0, 4) == floor - 1
    assert motion_of("top", height_m, 6.0, 4, {}) == f"floor{floor}"


@pytest.mark.parametrize("height_m", [0.3, 1.2, 2.0, 2.9, 5.7])
def test_interpolation_is_exact_for_a_motion_that_grows_with_height(height_m):
    """Masses that move by j give a piece at z the motion n z/h; the storey's middle, j − 1/2."""
    moves = {"ground": 0.0, **{f"floor{j}": float(j) for j in range(1, 5)}}
    for rule, expected in (
        ("interpolated", 4.0 * height_m / 6.0),
        ("middle", storey_of(height_m / 6.0, 4) + 0.5),
    ):
        mixed = {}
        name = motion_of(rule, height_m, 6.0, 4, mixed)
        assert sum(mixed[name].values()) == pytest.approx(1.0)
        assert sum(w * moves[m] for m, w in mixed[name].items()) == pytest.approx(expected)
