"""The command line that commands share: the words of a case, what they name, its progress lines."""

import argparse
import sys

from yade_scripts.commands.search import collapse_bounds
from yade_scripts.commands.tables import read_curve
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


def parser(doc, *words, **own):
    """Parser of a command, described by the first line of its documentation.

    `words` are required options of WORDS, `own` those of this command alone, with what each is.
    """
    made = argparse.ArgumentParser(description=doc.splitlines()[0])
    for word, text in ({word: WORDS[word] for word in words} | own).items():
        choices = tuple(SIGNS) if word == "direction" else None
        made.add_argument(f"--{word}", required=True, choices=choices, help=text)
    return made


def opened(args):
    """Scene file, and time and accelerations of the motion, that `--scene` and `--motion` name."""
    return read_case(args.scene), *floor_motions.read(args.motion)


def progress(name):
    """Return what prints progress under a name, a line a call."""
    return lambda text: print(f"[{name}]", text, file=sys.stderr, flush=True)


def add_intensity(parser):
    """Let --pga state an intensity, or --collapse name an IDA table that has it."""
    parser.add_argument("--pga", type=float, help="intensity [g]")
    parser.add_argument("--collapse", help="IDA table: the lowest intensity that overturned")


def intensity(args):
    """Intensity that the options of `add_intensity` say [g].

    ValueError of a table of which nothing overturned, and if both options or neither is stated.
    """
    if (args.pga is None) == (args.collapse is None):
        raise ValueError("expected either --pga or --collapse")
    if args.collapse is None:
        return args.pga
    status, _ = read_curve(args.collapse)
    collapse = collapse_bounds(status)[1]
    if collapse is None:
        raise ValueError(f"{args.collapse}: expected at least one run that overturned")
    return collapse
