"""What a run says before and after its work: of a report without results, of a missing cluster."""

import logging

import pytest
from rocking.configuration.files import check_inline
from rocking.runtime import cluster, command_line, terminal


@pytest.fixture
def told():
    """Return what Snakemake's handlers let through of some messages."""
    logger, seen = logging.getLogger("rocking.test.terminal"), []
    handler = logging.Handler()
    handler.emit = lambda record: seen.append(record.getMessage())
    logger.handlers, logger.propagate = [handler], False
    terminal.name_targets(lambda: ["fragility", "risk"], logger, runs=["mine"])

    def of(*messages):
        for message in messages:
            logger.warning(message)
        return seen

    return of


def test_a_report_without_results_says_what_to_do_in_one_line(told):
    missing = [f"Missing metadata for file results/main/{n}.csv. Maybe metadata" for n in range(9)]
    unmade = "File results/main/figures/a.png marked for report but does not exist."
    (line,) = told(*missing, unmade)
    assert line.startswith("error: no report yet, results/main/figures/a.png is missing")
    assert "without --report" in line


def test_a_target_that_is_not_known_gets_the_nearest(told):
    said = "No rule to produce fragilty (if you use input functions make sure ...)."
    assert told(said) == ["No rule to produce fragilty: did you mean fragility?"]


def test_a_rule_of_many_files_as_a_target_is_told_in_one_line(told):
    said = "Target rules may not contain wildcards. Please specify concrete files or a rule \n…"
    (line,) = told(said)
    assert line.startswith("a rule of many files is no target")
    assert "targets: fragility, risk" in line


@pytest.mark.parametrize(
    ("path", "words"),
    [
        ("results/other/tables/records.csv", "its run is other, this command's mine: add --config"),
        ("results/mine/ida/*/A_neg.csv", "one file, without wildcards"),
        ("results/*/tables/records.csv", "one file, without wildcards"),
        ("results/mine/tables", "expected a file, or a target by its name"),
        ("results/mine/ida/W9/A_neg.csv", "of this run, model, record and direction"),
    ],
)
def test_a_path_that_nothing_makes_is_told_what_is_wrong_with_it(told, path, words):
    (line,) = told(f"No rule to produce {path} (if you use input functions make sure ...).")
    assert line.startswith(f"No rule to produce {path}: ")
    assert words in line


def test_an_option_of_which_snakemake_takes_the_last_alone_is_told():
    """The first --config would be left out without a word."""
    given = ["snakemake", "--cores", "1", "--config", "run=a", "--configfile", "own.yaml", "-n"]
    assert command_line.fault(
        check_inline, [*given, "--config", "facade={height_m: 7}"]
    ).startswith("--config stands 2 times")
    assert "--configfile stands 2 times" in command_line.fault(
        check_inline, [*given, "--configfiles=b.yaml"]
    )
    twice = "smdof={period_s: 0.3, period_s: 0.4}"
    for words in (["--config", "run=a", twice], ["-C", twice, "-n"], [f"--config={twice}"]):
        told = command_line.fault(check_inline, words)
        assert told == "config: --config smdof line 1: key 'period_s' stands twice"
    assert (
        command_line.fault(check_inline, ["--config", "smdof={n_dof: 010}", "models=[W1, W2]"])
        == ""
    )
    assert command_line.fault(check_inline, given) == ""
    assert command_line.fault(check_inline, [*given, "--", "--config"]) == ""


def without(*programs):
    return lambda name: None if name in programs else f"/usr/bin/{name}"


def test_a_cluster_that_is_not_there_is_said_before_anything_is_submitted():
    assert "sbatch is not on the path" in cluster.fault("slurm", without("sbatch"))
    assert cluster.fault("slurm", without("sacct")) == ""
    assert cluster.fault("local", without("sbatch", "sacct")) == ""


def test_a_slurm_without_accounts_is_told_which_options_serve():
    said = cluster.warning("slurm", ["snakemake"], without("sacct"))
    assert "--slurm-no-account --slurm-status-command squeue" in said
    assert cluster.warning("slurm", ["snakemake", "--slurm-no-account"], without("sacct")) == ""
    assert cluster.warning("slurm", ["snakemake"], without()) == ""
    assert cluster.warning("local", ["snakemake"], without("sacct")) == ""
