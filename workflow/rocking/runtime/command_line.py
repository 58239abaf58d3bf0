"""What a command line says and Snakemake does not do: told before the plan, or mended after it."""

import sys

ONCE = {"--config": ("--config", "-C"), "--configfile": ("--configfile", "--configfiles")}


def fault(check, words=None):
    """Say in one line which option, or key of a value, stands twice; empty where none does.

    Snakemake takes the last of them alone, without a word of the values that it leaves. `check`
    takes the text of a value and its name, and raises a ValueError of one line; `words` are the
    command line, unless given this process's.
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
    within = False
    for word in words:
        if word.startswith("-"):
            within = word.partition("=")[0] in ONCE["--config"]
            word = word.partition("=")[2]
        key, _, value = word.partition("=")
        if within and value[:1] in ("{", "["):
            try:
                check(value, f"--config {key}")
            except ValueError as error:
                return str(error)
    return ""


def pass_through(kind):
    """Let a plan go on behind a rule of `--until` where another one of them lies behind it.

    Snakemake counts nothing as ready behind such a rule, and stops with "Out of jobs" before the
    second. What lies behind the last of them has left the plan once its targets are set. `kind` is
    the class of its plans.
    """
    set_targets = kind.set_until_jobs

    def set_and_forget(dag):
        set_targets(dag)
        dag.untilrules.clear()
        dag.untilfiles.clear()

    kind.set_until_jobs = set_and_forget
