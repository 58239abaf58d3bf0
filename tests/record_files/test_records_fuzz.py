"""A few hundred damaged files; `python tests/trials/fuzz_readers.py` reads 100,000."""

import pytest

from tests.trials.fuzz_readers import run


@pytest.mark.parametrize("seed", [11, 12])
def test_damaged_files_are_refused_or_read_right(seed):
    tally, _ = run(300, seed)
    assert sum(tally.values()) == 300
    # The damage is real, and not all of it fatal.
    assert sum(n for outcome, n in tally.items() if "refused" in outcome) > 100
    assert tally["record read"] > 10
