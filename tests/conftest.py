"""What all tests share: an end for every process, one thread in each, long tests first."""

import functools
import gc
import os
import signal
import subprocess

import pytest

LIMIT_S = 800.0  # of a subprocess whose test states none; below the limit of a test

# what runs in YADE ends with the tests that started it
os.environ["ROCKING_RUN_PID"] = str(os.getpid())

# there is a process a core: threads of BLAS beside them would wait for each other, busily
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# a shell starts what is in its background with SIGINT ignored, which every process here would
# inherit: no run that a test interrupts would notice
signal.signal(signal.SIGINT, signal.default_int_handler)

# `timeout` given at a call wins
subprocess.run = functools.partial(subprocess.run, timeout=LIMIT_S)


@pytest.fixture(scope="session")
def undisturbed(tmp_path_factory):
    """An undisturbed run of a small study, made once for what is disturbed, moved or repeated."""
    from tests.trials.faults import trials, workspace

    return trials.Bench(tmp_path_factory.mktemp("undisturbed"), workspace.FIGURES)


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(items):
    """Long tests first, so that no core waits for one that another began last.

    Tests marked `xdist_group` stay on one core: what they share is made once. pytest-xdist up to
    3.8 writes the group where pytest 9.2 no longer looks (pytest-xdist's issue 1386).
    """
    for item in items:
        if (grouped := vars(item).get("_nodeid")) not in (None, item.nodeid):
            item._id = type(item.id).parse(grouped)
    weight = {"slow": 2, "yade": 1}
    items.sort(key=lambda test: -sum(weight.get(mark.name, 0) for mark in test.iter_markers()))


def pytest_collection_finish():
    """What was imported and collected is no garbage: it is looked through no more."""
    gc.freeze()
