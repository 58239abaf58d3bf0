"""A faulty schema ends in one line that names its file and key."""

import pytest
from rocking.configuration import schema
from rocking.configuration.config import resolve
from rocking.configuration.schema import ConfigError

A = "properties:\n  a: {{type: number, default: 1.0{}}}\n"
FAULTS = {
    "type": ("properties: {a: {type: integr, default: 1}}", "a: type 'integr': expected one of"),
    "acts_with": (A.format(", acts_with: {own.b: {type: number}}"), "did you mean 'own.a'?"),
    "a text": (A.format(", acts_with: b"), "a: acts_with: expected dict or list"),
    "texts": (A.format(", acts_with: {run: main}"), "acts_with: expected keys, and a schema"),
    "below": (A.format(", below: facade.hight_m"), "did you mean 'facade.height_m'?"),
    "models": (
        "properties: {a: {type: array, items: {type: string, models: NOPE}, default: []}}",
        "a: items: models 'NOPE': expected the name of a list of models",
    ),
    "usual": (A.format(", usual: [2, 1]"), "a: usual: expected two ascending numbers"),
    "no default": ("properties: {a: {type: number}}", "a: default: missing"),
    "pattern": ("properties: {a: {type: string, pattern: '[', default: x}}", "a: pattern: untermi"),
    "minimum": (A.format(", minimum: low"), "a: minimum: expected int or float"),
    "dots": ("properties: {a.b: {type: number, default: 1.0}}", "key 'a.b': expected lower-case"),
    "a number": ("properties: {1: {type: number, default: 1.0}}", "key 1: expected lower-case"),
    "items": (
        "properties: {a: {type: array, items: [number], default: []}}",
        "a: items: expected dict",
    ),
    "twice": (A.format("") + A.format("").split("\n")[1] + "\n", "line 3: a stands twice"),
    "itself": ("properties: &p\n  a: *p\n", "a: keyword 'a': expected one of"),
    "reference": (
        A.format(", $ref: 'https://example.org/a'"),
        "a: keyword '$ref': expected one of",
    ),
    "any": ("properties: {a: {anyOf: number, default: 1.0}}", "a: anyOf: expected list"),
    "deep": ("{properties: {a: " * 20 + "{}" + "}}" * 20, "nested more than 12 levels deep"),
}


@pytest.fixture
def own(tmp_path, monkeypatch):
    """A study's folder whose schemas are added to the core's."""

    def clear():
        for function in (schema.sections, schema.whole):
            function.cache_clear()

    (tmp_path / "own").mkdir()
    monkeypatch.setattr(schema, "STUDIES", tmp_path)
    clear()
    yield tmp_path / "own"
    monkeypatch.undo()
    clear()


@pytest.mark.parametrize("name", FAULTS)
def test_what_is_no_schema_is_refused_in_one_line(own, name):
    text, said = FAULTS[name]
    (own / "own.schema.yaml").write_text(text)
    with pytest.raises(ConfigError) as caught:
        resolve({})
    line = str(caught.value)
    assert said in line
    assert "own" in line
    assert "\n" not in line


@pytest.mark.parametrize("name", ["records", "scenarios", "grid", "seed"])
def test_a_section_takes_no_name_of_a_key_at_the_top_level(own, name):
    (own / f"{name}.schema.yaml").write_text(A.format(""))
    with pytest.raises(ConfigError, match=f"{name} is a key at the top level"):
        resolve({})


def test_a_schema_that_is_one_adds_its_keys(own):
    (own / "own.schema.yaml").write_text(A.format(", acts_with: {own.b: {const: 2}}") + B)
    assert resolve({"own": {"b": 2}})["own"] == {"a": 1.0, "b": 2}
    with pytest.raises(ConfigError, match="unknown key 'own.c'"):  # whether it says so or not
        resolve({"own": {"c": 2}})


B = "  b: {type: integer, default: 1, minimum: 1}\n"
