"""What a command line says and Snakemake does not do: told before the plan, or mended after it."""

import sys

ONCE = {"--config": ("--config", "-C"), "--configfile": ("--configfile", "--configfiles")}


def fault(words=None):
    """Say in one line which option stands twice; empty where none does.

    Of these options Snakemake takes the last alone, without a word of the values that it leaves.
    `words` are the command line, unless given this process's.
    """
    words = list(sys.argv if words is None else words)
    words = words[: words.index("--")] if "--" in words else words
    for name, spelt in ONCE.items():
        count = sum(word.partition("=")[0] in spelt for word in words)
        if count > 1:
            return (
                f"{name} stands {count} times, and Snakemake takes the last alone: give all behind "
                f"one {name}, apart by blanks"
            )
    return ""


def pass_through(dag):
    """Let a run go on behind a rule of `--until` where another one of them lies behind it.

    Snakemake counts nothing as ready behind such a rule, and stops with "Out of jobs" before the
    second. What lies behind the last of them has left the plan by then.
    """
    dag.untilrules.clear()
    dag.untilfiles.clear()
