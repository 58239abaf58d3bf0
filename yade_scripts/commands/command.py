"""The command line that commands share: the words of a case, what they name, its progress lines."""

import argparse
import sys

from yade_scripts.files import read_case
from yade_scripts.model import floor_motions
from yade_scripts.model.motion import SIGNS

CURVE = ("scene", "motion", "record", "direction")  # what one model, record and direction needs
WORDS = {
    "scene": "case file (JSON)",
    "motion": "floor motions (CSV)",
    "record": "name",
    "direction": "of the record along the outward normal",
    "curve": "finished IDA table (CSV)",
    "journal": "finished runs (JSON lines)",
}


def parser(doc, *words, **options):
    """Parser of a command, described by the first line of its documentation.

    `words` are required options of WORDS, `options` those of this command alone, with what each is.
    """
    made = argparse.ArgumentParser(description=doc.splitlines()[0])
    for word, text in ({word: WORDS[word] for word in words} | options).items():
        choices = tuple(SIGNS) if word == "direction" else None
        made.add_argument(f"--{word}", required=True, choices=choices, help=text)
    return made


def opened(args):
    """Scene file, and time and accelerations of the motion, that `--scene` and `--motion` name."""
    return read_case(args.scene), *floor_motions.read(args.motion)


def progress(name):
    """Return what prints progress under a name, a line a call."""
    return lambda text: print(f"[{name}]", text, file=sys.stderr, flush=True)
