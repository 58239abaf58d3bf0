"""Says where configuration files cannot be read: `python -m rocking.configuration FILE…`.

Snakemake reads them before the workflow has a word, and of a fault in the YAML it names neither
file nor line.
"""

import sys

from rocking.configuration.files import check_files
from rocking.configuration.schema import ConfigError


def main(paths):
    """Print the first fault in one line; return the exit status."""
    if not paths or any(path.startswith("-") for path in paths):
        print("usage: python -m rocking.configuration FILE…", file=sys.stderr)
        return 2
    try:
        check_files(paths, empty=False)
    except ConfigError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
