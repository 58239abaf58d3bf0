"""What leans on the inside of Snakemake is left out where that is not as it is known."""

from types import SimpleNamespace

import pytest
from rocking.runtime import interrupts, progress, terminal, warm
from rocking.runtime.fallback import expect_parameters, left_out_if_unknown
from snakemake.script import PythonScript

RULE = SimpleNamespace(name="ida", norun=False)
JOB = SimpleNamespace(rule=RULE, wildcards_dict={}, params=SimpleNamespace())


def dag(**more):
    """A DAG of one job that waits."""
    return SimpleNamespace(needrun_jobs=lambda: [JOB], **more)


@pytest.mark.parametrize(
    "lean",
    [
        lambda: warm.serve(SimpleNamespace(dag=SimpleNamespace())),
        lambda: progress.tasks_of(SimpleNamespace(dag=SimpleNamespace())),
        lambda: progress.tasks_of(SimpleNamespace(dag=dag(), scheduler=SimpleNamespace())),
        lambda: progress.tasks_of(
            SimpleNamespace(dag=dag(finished=lambda job: False), scheduler=SimpleNamespace())
        ),
        lambda: interrupts.heed(SimpleNamespace()),
        lambda: terminal.thin_out(SimpleNamespace()),
    ],
    ids=["scripts", "progress", "finished", "running", "interrupts", "terminal"],
)
def test_without_what_it_leans_on_it_is_left_out_with_a_line(lean, capsys):
    before = PythonScript.execute_script
    with left_out_if_unknown("something"):
        lean()
    assert capsys.readouterr().err.startswith("warning: without something: Snakemake differs")
    assert PythonScript.execute_script is before


def test_other_faults_are_not_hidden():
    with pytest.raises(ValueError, match="ours"), left_out_if_unknown("something"):
        raise ValueError("ours")


def test_parameters_that_differ_are_named():
    expect_parameters(lambda self, fname: None, "self", "fname")
    with pytest.raises(TypeError, match="takes self, path"):
        expect_parameters(lambda self, path: None, "self", "fname")
