"""Writes the pages of the configuration from the schemas, docs/targets.md from the rules.

config/README.md says how to give values and names every key of the core; docs/keys/ has a page a
section. A study's targets and keys stand in keys.md of its folder.
`python -m docs.write_keys --check` finds drift.
"""

import argparse
import sys
from pathlib import Path

from rocking.configuration import schema as config_schema
from rocking.configuration import targets

README = Path(__file__).resolve().parents[1] / "config" / "README.md"
EXAMPLES = README.parent / "scenarios"
KEYS = README.parents[1] / "docs" / "keys"
WRITTEN = "<!-- Written by `python -m docs.write_keys` from workflow/schemas/; edit those. -->"

INTRO = """\
# Configuration

<!-- Written by `python -m docs.write_keys` from workflow/schemas/; edit those. -->

`config/config.yaml` holds what differs from the defaults below; an empty one runs what is
recommended: the elastic wall in courses, and a building that yields. A
misspelt key is refused by name with the nearest right one, a value out of range with its unit. The
complete configuration of each run, defaults included, is saved beside its results.

## Changing values

On the command line, a section's keys go in braces; what is not named keeps its value:

```sh
snakemake --cores 2 --config run=tall 'facade={height_m: 7.0}'
snakemake --cores 2 --config run=two records=GMN_NS,IS113_Lo directions=neg models=W1,W2
```

`run` names the folder, so the first command fills `results/tall/` and leaves `results/main/` as it
is. One file can be asked for as well; `--` ends the list that `--config` takes:

```sh
snakemake --cores 2 --config run=tall 'facade={height_m: 7.0}' -- results/tall/ida/W1/GMN_NS_neg.csv
```

For more than a few values write a file of your own and give it with `--configfile`; it is laid over
`config/config.yaml` section by section, and `--config` over both:

```sh
snakemake --cores 2 --configfile config/scenarios/own_facade.yaml
snakemake --cores 2 --configfile config/scenarios/own_facade.yaml --config 'damping={law: value}'
```

The 3DEC study is such a file, over which other values or another file may be laid:

```sh
snakemake --configfile config/scenarios/study.yaml --config run=low models=W1 'facade={height_m: 5}'
```

## Studies: several runs at once

| key | meaning |
|---|---|
| `grid` | Dotted keys with lists of values; a run `<run>-<key>_<value>-…` for each combination. |
| `scenarios` | Names with overrides under each; a run `<run>-<name>` for each. |
| `scenario` | Which of the scenarios to run: a name, a list, or `all` (the default). |

Every run is validated before anything is computed, and has its own folder. Three façade heights
and two dampings, `config/scenarios/heights_and_damping.yaml`, are:

```yaml
{example}```

```sh
snakemake --cores 2 --configfile config/scenarios/heights_and_damping.yaml
snakemake --cores 2 --configfile config/scenarios/buildings.yaml
snakemake --cores 2 --configfile config/scenarios/buildings.yaml --config scenario=stiff
snakemake --cores 2 --config run=walls 'grid={facade.thickness_m: [0.25, 0.375, 0.5]}'
```

`scenarios` and `grid` together give every scenario at every point of the grid.

## Notes on writing values

- Lists replace lists, they are not joined. Commas make a list on the command line.
- `null` means "derived": the meaning column says from what.
- A file with `__use_yte__: true` is a template, of which Snakemake would run expressions as
  Python. It is refused ([by what](../docs/robustness.md#configurations-from-others)).

## Every key, by section

A section's page has unit, default, allowed values and meaning of each key. The keys of a study
stand in its folder, `workflow/studies/<study>/keys.md`.

| section | what | keys |
|---|---|---|
"""


def render() -> str:
    """Return the text of config/README.md: how to override, then which keys a section has."""
    example = EXAMPLES / "heights_and_damping.yaml"
    text = INTRO.replace("{example}", example.read_text("utf-8"))
    for name, schema in of_folder(config_schema.FOLDER):
        keys = ", ".join(f"`{path}`" for path, _ in config_schema.leaves(schema))
        title = schema.get("title", name)
        title = title[0].upper() + title[1:]
        text += f"| [{_heading(name)}](../docs/keys/{_stem(name)}.md) | {title} | {keys} |\n"
    return text


def of_folder(folder: Path) -> list[tuple[str, dict]]:
    """Sections that the schemas of a folder describe, or add keys to: the top level first."""
    schemas = [
        (name, config_schema.read(path))
        for name, path in config_schema.files()
        if path.parent == folder
    ]
    return sorted(schemas, key=lambda section: section[0] != config_schema.TOP)


def sections() -> dict[str, str]:
    """Return the text of docs/keys/{section}.md by the file's name, a table of its keys."""
    pages = {}
    for name, schema in of_folder(config_schema.FOLDER):
        lines = [f"# {_heading(name)}: {schema.get('title', name).lower()}", "", WRITTEN, ""]
        pages[f"{_stem(name)}.md"] = "\n".join([*lines, *_keys(schema, HOW)]) + "\n"
    return pages


def studies() -> dict[Path, str]:
    """Return the text of keys.md of every study's folder: its targets, then its keys."""
    pages = {}
    for rules in sorted(config_schema.STUDIES.glob("*/rules.smk")):
        folder = rules.parent
        lines = [f"# `{folder.name}`: targets and keys", "", WRITTEN, ""]
        if there := targets.targets(study=folder.name):
            lines += ["| target | what it makes | costs |", "|---|---|---|"]
            lines += [
                f"| `{name}` | {target.makes} | {target.costs} |" for name, target in there.items()
            ]
        else:
            lines += ["No target: its files are asked for by name, as its rules say."]
        for name, schema in of_folder(folder):
            title = schema.get("title", name).lower()
            lines += ["", f"## `{name}`: {title}", "", *_keys(schema, HOW_STUDY)]
        pages[folder / "keys.md"] = "\n".join(lines) + "\n"
    return pages


HOW = "../../config/README.md"  # from a section's page
HOW_STUDY = "../../../config/README.md"


def _keys(schema: dict, how: str) -> list[str]:
    """Lines of a section: what it is, and a table of its keys."""
    lines = [" ".join(schema.get("description", "").split()), ""]
    lines += ['Units are SI unless the key\'s name says otherwise; "-" is dimensionless.']
    lines += [f"[How to give values]({how}).", ""]
    lines += ["| key | unit | default | allowed | meaning |", "|---|---|---|---|---|"]
    for path, part in config_schema.leaves(schema):
        lines.append(_row(path, part))
        entries = part.get("items", {})
        lines += [_row(f"{path}[].{key}", entry) for key, entry in config_schema.leaves(entries)]
    return lines


def _heading(name: str) -> str:
    return "Top level" if name == config_schema.TOP else f"`{name}`"


def _stem(name: str) -> str:
    return "top_level" if name == config_schema.TOP else name


def _row(path: str, schema: dict) -> str:
    default = schema.get("default", "stated")
    shown = default if isinstance(default, str) else _text(default)
    allowed = config_schema.expectation({k: v for k, v in schema.items() if k != "unit"})
    usual = {**schema, **schema.get("items", {})}.get("usual")
    allowed += (
        f"; usual {config_schema.show(usual[0])} to {config_schema.show(usual[1])}" if usual else ""
    )
    meaning = " ".join(schema.get("description", "").split())
    cells = [f"`{path}`", schema.get("unit", "-"), f"`{shown}`", allowed, meaning]
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def _text(value: object) -> str:
    if isinstance(value, list):
        return "[" + ", ".join(v if isinstance(v, str) else _text(v) for v in value) + "]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{k}: {_text(v)}" for k, v in value.items()) + "}"
    return value if isinstance(value, str) else config_schema.show(value)


def main(arguments: list[str] | None = None) -> int:
    """Write all pages, or with `--check` say which are out of date; return the exit status."""
    parser = argparse.ArgumentParser(prog="python -m docs.write_keys")
    parser.add_argument("--check", action="store_true", help="write nothing; exit 1 on drift")
    given = parser.parse_args(arguments)
    try:
        tables = targets.render(targets.PAGE.read_text("utf-8"))
    except ValueError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    pages = {README: render(), targets.PAGE: tables}
    pages |= {KEYS / name: text for name, text in sections().items()} | studies()
    wrong = [p for p, text in pages.items() if not p.is_file() or p.read_text("utf-8") != text]
    gone = [page for page in sorted(KEYS.glob("*.md")) if page not in pages]
    if not given.check:
        KEYS.mkdir(exist_ok=True)
        for page in wrong:
            page.write_text(pages[page], "utf-8")
        for page in gone:
            page.unlink()
        return 0
    for page in wrong + gone:
        where = f"{page.parent.name}/{page.name}"
        print(f"{where} is out of date; run python -m docs.write_keys")
    return 1 if wrong or gone else 0


if __name__ == "__main__":
    sys.exit(main())
