"""What a command line says in vain, told before anything is planned."""

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
