"""Makes the pictures of docs/gallery.md again: runs the command beside each, shrinks what it made.

    python tools/gallery.py                    # all; `make gallery`
    python tools/gallery.py --only fig09_ida   # one
    python tools/gallery.py --no-run           # from the results there are
    python tools/gallery.py --results /tmp/x   # from those of a run with `--directory /tmp/x`
    python tools/gallery.py --drawn sequence   # a picture of another page was put there by hand
    python tools/gallery.py --drawn own=workflow/studies/own/figure.py  # a new one, by this file
    python tools/gallery.py --study results/study/figures  # those of docs/study.md; `make study`
    python tools/gallery.py --old              # which pictures are older than what draws them

A picture is named after the last file its command asks for; the page is the only list of both.
`drawn_by.json` beside the pictures, in `docs/pictures` and in a study's `pictures`, holds what
draws each of them, and the digest of that when it was drawn: of its script, and of the drawing
modules that the script imports. What computes is not in it, nor what all figures share, else every
change would make every picture old. `make docs` prints the list and goes on: some pictures take an
hour to draw, so a change lands before they are renewed.
"""

import argparse
import hashlib
import json
import re
import shlex
import subprocess
import sys
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT)]

from yade_scripts.lists import listed  # noqa: E402
from yade_scripts.sources import imports  # noqa: E402

PAGE = ROOT / "docs" / "gallery.md"
STUDY = ROOT / "docs" / "study.md"
DRAWN_BY = ROOT / "docs" / "pictures" / "drawn_by.json"
OF_STUDIES = sorted(ROOT.glob("workflow/studies/*/pictures/drawn_by.json"))
ENTRY = re.compile(r"^```sh\n(?P<command>.*?)^```\n+!\[[^\]]*\]\((?P<picture>[^)]+)\)", re.M | re.S)
WIDTH_PX = 900
LIMIT_BYTES = 6_000_000  # of all pictures together: they live in the repository
SHARED = {"__init__.py", "panels.py", "style.py"}  # by all figures, or nearly all


def entries(page=PAGE):
    """Pictures of the page, as (command, file it makes, picture)."""
    pictures = []
    for match in ENTRY.finditer(page.read_text("utf-8")):
        source = shlex.split(match["command"].replace("\\\n", " "))[-1]
        picture = page.parent / match["picture"]
        if picture.stem.removeprefix("study_") != Path(source).stem:
            raise ValueError(f"{page.name}: {match['picture']} stands below a command for {source}")
        pictures.append((match["command"], Path(source), picture))
    return pictures


def digest(script):
    """Digest of a script and of the modules of drawing that it imports itself, hex."""
    modules = {
        path
        for path in imports(script)
        if (path.parent.name == "figures" or path.stem.startswith("drawing"))
        and path.name not in SHARED
    }
    total = hashlib.sha256()
    for path in (script, *sorted(modules)):
        total.update(path.name.encode() + b"\0" + path.read_bytes())
    return total.hexdigest()


def old(drawn_by=DRAWN_BY):
    """Names of the pictures whose script, or module of drawing, has changed since they were drawn.

    Raises
    ------
    ValueError
        If a picture stands in the folder or in the file alone, or a script is gone.
    """
    known = json.loads(drawn_by.read_text("utf-8"))
    there = {path.name for path in drawn_by.parent.iterdir() if path != drawn_by}
    for name in sorted(there ^ set(known)):
        raise ValueError(f"{name}: expected in {drawn_by.parent.name}/ and in {drawn_by.name}")
    known = {name: about for name, about in known.items() if not of_gone(about["script"])}
    for name, about in known.items():
        if not (ROOT / about["script"]).is_file():
            raise ValueError(f"{drawn_by.name}: {name}: no script {about['script']}")
    return [
        name for name, about in known.items() if about["digest"] != digest(ROOT / about["script"])
    ]


def of_gone(script):
    """Whether a script is of a study whose folder was deleted."""
    tops, rest = Path(script).parts[:2], Path(script).parts[2:]
    return tops == ("workflow", "studies") and not ROOT.joinpath(*tops, rest[0]).is_dir()


def note(picture, script=None):
    """Keep that a picture was drawn by today's script, the one it had unless one is given."""
    drawn_by = picture.with_name(DRAWN_BY.name)
    known = json.loads(drawn_by.read_text("utf-8")) if drawn_by.is_file() else {}
    script = script or known.get(picture.name, {}).get("script")
    if script is None:
        stem = picture.stem
        sys.exit(f"error: {drawn_by.name} has no script for {stem}: --drawn {stem}=<script>")
    if not (ROOT / script).is_file():
        sys.exit(f"error: {picture.stem}={script}: no such file in the project")
    known[picture.name] = {"digest": digest(ROOT / script), "script": script}
    drawn_by.write_text(json.dumps(known, indent=1, sort_keys=True) + "\n", "utf-8")


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
    parser.add_argument("--results", type=Path, help="take those in this folder")
    parser.add_argument(
        "--drawn", nargs="*", help="pictures drawn by other means; name=script for new ones"
    )
    parser.add_argument("--old", action="store_true", help="list old pictures, draw none")
    parser.add_argument("--study", type=Path, help="renew those of the study's page from here")
    args = parser.parse_args()
    if args.study:
        names = re.findall(r"\(pictures/study_([^)]+)\)", STUDY.read_text("utf-8"))
        if missing := [name for name in names if not (args.study / name).is_file()]:
            sys.exit(f"error: {args.study}: no {listed(missing)}; make study makes them")
        for name in names:
            shrink(args.study / name, picture := DRAWN_BY.parent / f"study_{name}")
            note(picture)
        return
    if args.old:
        commands = {picture.name for _, _, picture in entries()}
        for drawn_by, name in [(d, n) for d in (DRAWN_BY, *OF_STUDIES) for n in old(d)]:
            stem = Path(name).stem
            how = f"make gallery ARGS='--only {stem}'"
            if name not in commands:
                how = f"the command on its page, then tools/gallery.py --drawn {stem}"
            if name not in commands and name.startswith("study_"):
                how = "make study"
            folder = drawn_by.parent.relative_to(ROOT)
            print(f"{folder}/{name} is older than what draws it; renew it: {how}")
        return
    for name, _, script in (word.partition("=") for word in args.drawn or ()):
        folders = [d.parent for d in (DRAWN_BY, *OF_STUDIES)]
        picture = next((p for folder in folders for p in folder.glob(f"{name}.*")), None)
        if picture is None:
            sys.exit(f"error: no picture {name} in docs/{DRAWN_BY.parent.name} or in a study's")
        note(picture, script)
    for command, source, picture in [] if args.drawn else entries():
        if args.only and picture.stem not in args.only:
            continue
        if not (args.no_run or args.results):
            print(command.strip(), file=sys.stderr)
            subprocess.run(["bash", "-euc", command], cwd=ROOT, check=True)
        shrink((args.results or ROOT) / source, picture)
        note(picture)
    total = sum(path.stat().st_size for path in DRAWN_BY.parent.iterdir())
    if total > LIMIT_BYTES:
        sys.exit(f"error: docs/pictures holds {total} bytes, more than {LIMIT_BYTES}")


if __name__ == "__main__":
    main()
