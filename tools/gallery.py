"""Makes the pictures of docs/gallery.md again: runs the command beside each, shrinks what it made.

    python tools/gallery.py                    # all; `make gallery`
    python tools/gallery.py --only fig09_ida   # one
    python tools/gallery.py --no-run           # from the results there are

A picture is named after the last file its command asks for; the page is the only list of both.
"""

import argparse
import re
import shlex
import subprocess
import sys
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "gallery.md"
ENTRY = re.compile(r"^```sh\n(?P<command>.*?)^```\n+!\[[^\]]*\]\((?P<picture>[^)]+)\)", re.M | re.S)
WIDTH_PX = 900
LIMIT_BYTES = 2_000_000  # of all pictures together: they live in the repository


def entries(page=PAGE):
    """Pictures of the page, as (command, file it makes, picture)."""
    found = []
    for match in ENTRY.finditer(page.read_text("utf-8")):
        source = shlex.split(match["command"].replace("\\\n", " "))[-1]
        picture = page.parent / match["picture"]
        if picture.stem != Path(source).stem:
            raise ValueError(f"{page.name}: {match['picture']} stands below a command for {source}")
        found.append((match["command"], Path(source), picture))
    return found


def shrink(source, picture):
    """Save a picture as wide as a page, in the colours it was drawn with."""
    with Image.open(source) as image:
        image = image.convert("RGB")
        height = round(image.height * WIDTH_PX / image.width)
        image = image.resize((WIDTH_PX, height), Image.Resampling.LANCZOS)
        picture.parent.mkdir(exist_ok=True)
        image.save(picture, optimize=True)


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", nargs="*", help="names of pictures, without .png")
    parser.add_argument("--no-run", action="store_true", help="take the results there are")
    args = parser.parse_args()
    for command, source, picture in entries():
        if args.only and picture.stem not in args.only:
            continue
        if not args.no_run:
            print(command.strip(), file=sys.stderr)
            subprocess.run(["bash", "-euc", command], cwd=ROOT, check=True)
        shrink(ROOT / source, picture)
    total = sum(path.stat().st_size for path in (PAGE.parent / "pictures").iterdir())
    if total > LIMIT_BYTES:
        sys.exit(f"error: docs/pictures holds {total} bytes, more than {LIMIT_BYTES}")


if __name__ == "__main__":
    main()
