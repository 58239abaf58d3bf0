"""What rules declare, looked at as a whole before anything is planned."""

import re
from pathlib import Path

_NAME = re.compile(r"{\w+")
_CONSTRAINT = re.compile(r"{(\w+),[^{}]*}")


def made_twice(rules):
    """Say in one line which file two rules make; empty where every file has one.

    Names of wildcards do not count, what they may be does. `rules` are Snakemake's, each with name,
    output and snakefile.
    """
    makers: dict = {}
    for rule in rules:
        for path in map(str, rule.output):
            first = makers.setdefault(_NAME.sub("{", path), rule)
            if first is not rule:
                path = _CONSTRAINT.sub(lambda match: f"{{{match[1]}}}", path)
                return (
                    f"{_named(rule)} makes {path}, which {_named(first)} makes already; "
                    "expected another name for it"
                )
    return ""


def _named(rule):
    """A rule and its file; of one that a study declares by a function, the study's folder."""
    study = dict(rule.params.items()).get("study")
    place = f"studies/{study}" if study else "/".join(Path(rule.snakefile).parts[-2:])
    return f"rule {rule.name} ({place})"
