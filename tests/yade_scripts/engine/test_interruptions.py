"""Interrupted YADE runs end, leave nothing, and do not hinder the next; hundreds under load:
tests/trials/interruptions/trials.py."""

import pytest

from tests.trials.interruptions.trials import trials

pytestmark = pytest.mark.yade


@pytest.mark.parametrize("model", ["W1", "W2c", "W3"])
@pytest.mark.parametrize("kind", ["Ctrl-C", "error", "SIGTERM", "orphan"])
def test_an_interrupted_run_ends_and_the_next_one_runs(kind, model):
    assert trials(3 if kind in ("Ctrl-C", "error") else 1, 1, [kind], [model]) == []
