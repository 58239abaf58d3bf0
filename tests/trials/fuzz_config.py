"""Random configurations: each resolves, or is refused in one line. Nothing else may happen.

    python tests/trials/fuzz_config.py --count 100000 --seed 1

Three kinds by turns: near-valid ones (schema keys with values around their limits), mutated ones
(misspelt keys, wrong types, hostile text), and text mutated from the shipped files and parsed as
YAML, the way a user's file would come in.
"""

import argparse
import collections
import datetime
import random
import sys
import traceback
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "workflow"))

from rocking.configuration import config as module  # noqa: E402
from rocking.configuration import files  # noqa: E402
from rocking.configuration import schema as config_schema  # noqa: E402

HOSTILE = [
    "../../etc/passwd",
    "/tmp/x",
    "a/b",
    "..",
    ".",
    ".hidden",
    "-rf",
    "; rm -rf .",
    "$(id)",
    "`id`",
    "a\nb",
    "a\0b",
    "a\x1b[31m",
    "é",
    "\ud800",
    "x" * 5000,
    "{run}",
    "{{run}}",
    "%s",
    "nan",
    "inf",
    "1e999",
    "1_000",
    "٣",
    "0x10",
    "1e-3",
    " 7 ",
    "",
    "~",
    "null",
    "true",
    "on",
    "all",
    "a,b",
    ",",
    "!!python/object/apply:os.system ['id']",
    "<<",
    "run",
    "facade.height_m",
    "..facade",
    "facade.",
]
ODD = [
    None,
    True,
    False,
    0,
    -1,
    1,
    2**62,
    2**63,
    -(2**70),
    10**5000,
    0.0,
    -0.0,
    1e-300,
    1e308,
    -1e308,
    float("nan"),
    float("inf"),
    [],
    {},
    [[]],
    [{}],
    {"": 1},
    {None: 1},
    {1: 2},
    {(1, 2): 3},
    b"x",
    {1, 2},
    (1, 2),
    datetime.date(2024, 5, 17),
    datetime.datetime(2024, 5, 17, 1, 2),
    1j,
    object(),
    [1, "a", None],
    [0.1] * 3000,
    [None] * 30000,
    "x",
]


def value_near(schema, rng):
    """A value about the limits of a schema, often one that fits."""
    if "anyOf" in schema:
        return value_near(rng.choice(schema["anyOf"]), rng)
    if "enum" in schema:
        return rng.choice(schema["enum"])
    kinds = schema.get("type", "string")
    kind = rng.choice(kinds) if isinstance(kinds, list) else kinds
    if kind in ("number", "integer"):
        bounds = ("minimum", "exclusiveMinimum", "maximum", "exclusiveMaximum")
        edges = [schema[k] for k in bounds if k in schema] or [1.0]
        number = rng.choice([rng.choice(edges), rng.choice(edges) * 0.5, rng.uniform(0, 3)])
        number = int(number) if kind == "integer" else number
        return rng.choice([number, number, str(number)])
    if kind == "array":
        count = rng.choice([schema.get("minItems", 1), schema.get("maxItems", 3), 2])
        return [value_near(schema.get("items", {}), rng) for _ in range(min(count, 20))]
    if kind == "object":
        return {k: value_near(p, rng) for k, p in schema.get("properties", {}).items()}
    return {"null": None, "boolean": rng.random() < 0.5}.get(kind, rng.choice(["a", "main", "W1"]))


def near_valid(rng):
    """Some keys of some sections, with a grid or scenarios now and then."""
    properties = config_schema.whole()["properties"]
    out = {}
    for name in rng.sample(sorted(properties), rng.randint(0, 4)):
        part = properties[name]
        keys = sorted(part.get("properties", {}))
        chosen = rng.sample(keys, min(len(keys), rng.randint(0, 3)))
        inner = {k: value_near(part["properties"][k], rng) for k in chosen}
        out[name] = inner if keys else value_near(part, rng)
    leaves = list(config_schema.leaves(config_schema.whole()))
    if rng.random() < 0.3:
        out["grid"] = {
            p: [value_near(s, rng) for _ in range(rng.randint(1, 3))]
            for p, s in rng.sample(leaves, rng.randint(1, 2))
        }
    if rng.random() < 0.3:
        out["scenarios"] = {
            name: {p: value_near(s, rng) for p, s in rng.sample(leaves, 2)}
            for name in rng.sample(["a", "b", "tall", "../x"], 2)
        }
        out["scenario"] = rng.choice([None, "all", "a", "a,b", ["a"], 3])
    return out


def mutate(value, rng, depth=0):
    """Replace, rename, drop or nest parts of a configuration at random."""
    if rng.random() < 0.12 or depth > 6:
        return rng.choice([rng.choice(ODD), rng.choice(HOSTILE)])
    if isinstance(value, dict):
        out = {}
        for key, item in value.items():
            name = key
            if rng.random() < 0.15:
                name = rng.choice(
                    [_misspell(str(key), rng), rng.choice(HOSTILE), rng.randint(0, 9)]
                )
            out[name] = mutate(item, rng, depth + 1)
        if rng.random() < 0.05:
            out[rng.choice(["a", "facade"])] = out  # a cycle
        return out
    if isinstance(value, list):
        return [mutate(v, rng, depth + 1) for v in value] * rng.choice([0, 1, 1, 2])
    return value


def _misspell(text, rng):
    i = rng.randint(0, max(len(text) - 1, 0))
    return rng.choice([text[:i] + text[i + 1 :], text[:i] + "x" + text[i:], text.upper(), text * 2])


def from_text(rng, texts):
    """A shipped file after random edits of its text."""
    text = rng.choice(texts)
    for _ in range(rng.randint(1, 6)):
        i, j = sorted(rng.randint(0, len(text)) for _ in range(2))
        piece = rng.choice(
            [
                text[i : min(j, i + 20)],
                ":",
                "\n",
                "  ",
                "- ",
                "{",
                "]",
                "&a ",
                "*a",
                "<<: ",
                "-",
                "1e9",
                ".inf",
                "#",
                "'",
                "!!int ",
            ]
        )
        text = text[:i] + piece + text[min(j, i + rng.randint(0, 10)) :]
    return text


def attempt(given):
    """Outcome of one configuration; AssertionError says which promise was broken."""
    try:
        if isinstance(given, str):
            files.check_text(given, "own.yaml")
            given = yaml.safe_load(given)
        runs = module.expand_scenarios(given)
    except config_schema.ConfigError as error:
        text = str(error)
        assert text.startswith("config: "), text[:200]
        assert text.isprintable(), f"not one printable line: {text[:200]!r}"
        assert len(text) < 2000, f"{len(text)} characters: {text[:200]}"
        return "refused"
    for name, one in runs.items():
        assert name == one["run"]
        assert "/" not in name
        assert not name.startswith((".", "-"))
        assert module.resolve(one) == one, "a resolved configuration does not resolve to itself"
        module.relevant(one, *one)
    return "resolved"


def fuzz(count, seed):
    """Try `count` configurations; return the number of each outcome and the first failure."""
    rng = random.Random(seed)
    shipped = [ROOT / "config" / "config.yaml", *sorted((ROOT / "config" / "scenarios").glob("*"))]
    texts = [path.read_text("utf-8") for path in shipped]
    outcomes = collections.Counter()
    for trial in range(count):
        given = from_text(rng, texts) if trial % 3 == 2 else near_valid(rng)
        if trial % 3 == 1:
            given = mutate(given, rng)
        try:
            outcomes[attempt(given)] += 1
        except Exception:
            return outcomes, f"trial {trial} of seed {seed}\n{traceback.format_exc(limit=-6)}"
    return outcomes, None


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    counts, failure = fuzz(given.count, given.seed)
    print(", ".join(f"{n} {outcome}" for outcome, n in sorted(counts.items())))
    if failure:
        sys.exit(failure)
