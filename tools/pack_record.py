"""Packs what was measured, page by page, into docs/record.tar.xz, and lists it in docs/record.md.

    .venv/bin/python tools/pack_record.py            # pages of docs/log into the record
    .venv/bin/python tools/pack_record.py --unpack   # and out of it, to write on

A page of docs/log is a topic: its first line is a title, a section is one measurement. Packing adds
pages or replaces those of the same name, takes them out of docs/log, and leads links to them to the
topic in docs/record.md. The same pages give the same bytes.
"""

import argparse
import io
import lzma
import re
import tarfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
LOG, RECORD, PAGE = (
    ROOT / "docs" / "log",
    ROOT / "docs" / "record.tar.xz",
    ROOT / "docs" / "record.md",
)
LINK = re.compile(r"\]\(((?:[\w./-]*/)?)log/(\w+)\.md(?:#[^)\s]*)?\)")
INTRO = """\
# What was measured, case by case

<!-- Written by `python tools/pack_record.py`. -->

Pages say what a number means. The measurements behind them are one compressed record,
`docs/record.tar.xz`, a page a topic. Nothing in it is needed to use the workflow. Each number
holds for the code that made it. To read it:

```sh
tar xf docs/record.tar.xz -C /tmp     # /tmp/record/accuracy.md and the others
```

To add to it, unpack it with `python tools/pack_record.py --unpack`, write, and pack it again.
"""


def packed():
    """Pages of the record by name; none where there is no record."""
    if not RECORD.exists():
        return {}
    with tarfile.open(RECORD) as archive:
        names = [member.name for member in archive.getmembers()]
        return {Path(name).name: archive.extractfile(name).read().decode() for name in names}


def pack(pages):
    """Write the record of pages by name."""
    made = io.BytesIO()
    with tarfile.open(fileobj=made, mode="w", format=tarfile.USTAR_FORMAT) as archive:
        for name in sorted(pages):
            content = pages[name].encode()
            member = tarfile.TarInfo(f"record/{name}")
            member.size, member.mode = len(content), 0o644
            archive.addfile(member, io.BytesIO(content))
    RECORD.write_bytes(lzma.compress(made.getvalue(), preset=9))


def listed(pages):
    """Text of docs/record.md: topics, and what each has."""
    lines = [INTRO]
    for name in sorted(pages):
        text = pages[name]
        lines += [f"## {Path(name).stem}", ""]
        lines += [f"- {title}" for title in re.findall(r"(?m)^##+ (.+)$", text)] or ["-"]
        lines += [""]
    return "\n".join(lines)


def led_here(path):
    """Lead a page's links to docs/log to the topic in docs/record.md."""
    text = path.read_text("utf-8")
    new = LINK.sub(
        lambda m: f"]({m[1]}record.md" + ("" if m[2] == "README" else f"#{m[2]}") + ")", text
    )
    if new != text:
        path.write_text(new, "utf-8")


def main():
    """Pack, or unpack."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--unpack", action="store_true", help="write the pages to docs/log")
    given = parser.parse_args()
    pages = packed()
    if given.unpack:
        LOG.mkdir(exist_ok=True)
        for name, text in pages.items():
            (LOG / name).write_text(text, "utf-8")
        return
    for path in sorted(LOG.glob("*.md")):
        if path.name != "README.md":
            pages[path.name] = path.read_text("utf-8")
        path.unlink()
    if LOG.is_dir() and not any(LOG.iterdir()):
        LOG.rmdir()
    pack(pages)
    PAGE.write_text(listed(pages), "utf-8")
    for path in (
        *ROOT.glob("*.md"),
        *ROOT.glob("docs/*.md"),
        *ROOT.glob("workflow/studies/*/*.md"),
    ):
        led_here(path)


if __name__ == "__main__":
    main()
