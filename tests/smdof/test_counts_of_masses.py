"""How many masses a chain may have."""

import pytest

from smdof.chain import shear_chain


@pytest.mark.parametrize("count", [0, -1, 2.5])
def test_a_chain_of_no_whole_number_of_masses_is_refused(count):
    with pytest.raises(ValueError, match="n_dof|masses"):
        shear_chain(count, 0.3)


@pytest.mark.parametrize("count", [1, 2, 4.0])
def test_a_whole_number_is_taken_as_it_is_written(count):
    assert shear_chain(count, 0.3) is not None
