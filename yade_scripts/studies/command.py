"""The command line that studies share: the words of a case, what they name, its progress lines."""

import argparse
import sys

from yade_scripts.files import read_json
from yade_scripts.model import floor_motions
from yade_scripts.model.motion import SIGNS

CURVE = ("scene", "motion", "record", "direction")  # what one model, record and direction needs
WORDS = {
    "scene": "scene file (JSON)",
    "motion": "floor motions (CSV)",
    "record": "name",
    "direction": "of the record along the outward normal",
    "curve": "finished IDA table (CSV)",
    "journal": "finished runs (JSON lines)",
}


def parser(doc, *words, **own):
    """Parser of a study.

    Parameters
    ----------
    doc : str
        The study's documentation, whose first line describes it.
    words
        Required options of WORDS.
    own
        Required options of this study alone, with what each of them is.
    """
    made = argparse.ArgumentParser(description=doc.splitlines()[0])
    for word, text in ({word: WORDS[word] for word in words} | own).items():
        choices = tuple(SIGNS) if word == "direction" else None
        made.add_argument(f"--{word}", required=True, choices=choices, help=text)
    return made


def listed(path, what, keys):
    """Cases or tests of a file: a list of objects, each with all of `keys`.

    Raises
    ------
    ValueError
        One line naming the file, and the one that lacks a key.
    """
    rows = read_json(path)
    if not isinstance(rows, list) or not rows:
        raise ValueError(f"{path}: expected a list of {what}s")
    for number, row in enumerate(rows, 1):
        missing = [key for key in keys if key not in row]
        if missing:
            raise ValueError(f"{path}: {what} {number} has no {', '.join(missing)}")
    return rows


def opened(args):
    """Scene file, and time and accelerations of the motion, that `--scene` and `--motion` name."""
    return read_json(args.scene), *floor_motions.read(args.motion)


def teller(name):
    """Return what prints progress under a name, a line a call."""
    return lambda text: print(f"[{name}]", text, file=sys.stderr, flush=True)


def speaker(case, args):
    """Return what prints a case's progress, a line a call."""
    return teller(f"{case['model']} {args.record} {args.direction}")
