"""Entry point: say in one line whether this Python can run YADE scenes."""

import argparse
import sys
from pathlib import Path

if __package__ in (None, ""):
    sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from yade_scripts import engine
from yade_scripts.journal import write_atomic


def main(argv=None):
    """Load YADE, check its classes, and write its version; return the exit status."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--output", help="file that receives the version")
    args = parser.parse_args(argv)
    try:
        engine.load_yade()
    except engine.EngineError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    from yade import config

    line = f"YADE {config.version}, Python {sys.version.split()[0]}\n"
    if args.output:
        write_atomic(args.output, line)
    print(line, end="", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
