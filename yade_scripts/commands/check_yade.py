"""Entry point: say in one line whether this Python can run YADE scenes."""

import argparse
import sys

from yade_scripts.engine import adapter
from yade_scripts.files import write_atomic


def main(arguments=None):
    """Load YADE, check its classes, and write its version; return the exit status."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--output", help="file that receives the version")
    args = parser.parse_args(arguments)
    adapter.load_yade()
    from yade import config

    line = f"YADE {config.version}, Python {sys.version.split()[0]}\n"
    if args.output:
        write_atomic(args.output, line)
    print(line, end="", file=sys.stderr)
    return 0
