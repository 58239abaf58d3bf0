"""Studies of several runs, and the page of the configuration with its command lines."""

import json
import re
import shlex
import shutil
from pathlib import Path

import pytest
import yaml
from forked import run
from rocking.configuration import schema
from rocking.configuration.config import (
    ConfigError,
    check_files,
    expand_scenarios,
    expanded,
    relevant,
    resolve,
)

from docs import write_keys as docs

ROOT = Path(__file__).resolve().parents[2]


def test_a_grid_gives_every_combination():
    runs = expand_scenarios(
        {
            "run": "s",
            "facade": {"width_m": 6},
            "grid": {"facade.height_m": [5.0, "6.48", 8], "damping": {"law": ["eq5", "value"]}},
        }
    )
    assert list(runs) == [
        f"s-height_m_{h}-law_{law}" for h in ("5", "6.48", "8") for law in ("eq5", "value")
    ]
    one = runs["s-height_m_8-law_eq5"]
    assert (one["run"], one["facade"]["height_m"]) == ("s-height_m_8-law_eq5", 8.0)
    assert (one["facade"]["width_m"], one["damping"]["law"]) == (6.0, "eq5")


def test_keys_of_the_same_name_keep_their_section_in_the_label():
    grid = {"facade.thickness_m": [0.3], "return_wall.thickness_m": [0.4]}
    assert list(expand_scenarios({"grid": grid})) == [
        "main-facade.thickness_m_0.3-return_wall.thickness_m_0.4"
    ]
    lists = expand_scenarios({"grid": {"models": ["W1", ["W1", "W2"]]}})
    assert {k: v["models"] for k, v in lists.items()} == {
        "main-models_W1": ["W1"],
        "main-models_W1_W2": ["W1", "W2"],
    }


def test_scenarios_are_laid_over_the_base_and_chosen_by_name():
    study = {
        "facade": {"width_m": 6.0},
        "scenarios": {"tall": {"facade.height_m": 8, "facade": {"e_mpa": 1500}}, "base": None},
    }
    runs = expand_scenarios(study)
    assert list(runs) == ["main-tall", "main-base"]
    tall = runs["main-tall"]["facade"]
    assert (tall["height_m"], tall["e_mpa"], tall["width_m"]) == (8.0, 1500.0, 6.0)
    assert runs["main-base"]["facade"] == resolve({"facade": {"width_m": 6}})["facade"]
    assert list(expand_scenarios({**study, "scenario": "base"})) == ["main-base"]
    assert list(expand_scenarios({**study, "scenario": "tall,base"})) == list(runs)
    crossed = expand_scenarios({**study, "grid": {"damping.law": ["eq5"]}, "scenario": ["tall"]})
    assert list(crossed) == ["main-tall-law_eq5"]
    faulty = {**study["scenarios"], "low": {"facade.height_m": -8}}
    assert list(expand_scenarios({**study, "scenarios": faulty, "scenario": "base"})) == [
        "main-base"
    ]
    assert list(expand_scenarios({"run": "x"})) == ["x"]


@pytest.mark.parametrize(
    ("config", "message"),
    [
        ({"scenarios": {"a": {"facade.hight_m": 8}}}, "scenario 'a': unknown key 'facade.hight_m'"),
        (
            {"scenarios": {"a": {}, "b": {"facade.height_m": -8}}, "scenario": "a,b"},
            "scenario 'b': facade.height_m = -8",
        ),
        ({"scenarios": {"a": {}}, "facade": {"width_m": 0}}, "facade.width_m = 0: expected"),
        ({"scenarios": {"a": {}, "A": {}}}, "two runs would be called 'main-a' and 'main-A'"),
        ({"scenarios": {"a": {}}, "scenario": "b"}, "scenario = 'b': expected one of a, or all"),
        ({"scenario": "b"}, "scenario = 'b': no scenarios are defined"),
        ({"scenarios": {"a": {}}, "scenario": []}, "scenario = []: expected one of a, or all"),
        ({"scenarios": {"a": {"run": "b"}}}, "scenarios.a.run: a scenario cannot set 'run'"),
        ({"scenarios": {"../a": {}}}, "scenario '../a': run = 'main-../a': expected text of"),
        ({"scenarios": "study.yaml"}, "scenarios = 'study.yaml': expected names"),
        ({"scenarios": {"a": {"facade": 5, "facade.height_m": 3}}}, "scenarios.a.facade.height_m:"),
        ({"grid": {"facade.hight_m": [1]}}, "unknown key 'facade.hight_m'; did you mean"),
        ({"grid": {"facade": [1]}}, "grid.facade: expected a key of that section"),
        ({"grid": {"facade.height_m": 5}}, "grid.facade.height_m = 5: expected a list of values"),
        ({"grid": {"facade.height_m": []}}, "grid.facade.height_m = []: expected a list of values"),
        ({"grid": {"facade.height_m": [5, "5.0"]}}, "grid.facade.height_m = [5, '5.0']: expected"),
        ({"grid": {"facade.height_m": [5, 0.1]}}, "scenario 'height_m_0.1': facade.height_m = 0.1"),
        ({"grid": {"run": ["a"]}}, "grid.run"),
        ({"grid": [1]}, "grid = [1]: expected keys with a list of values each"),
        (None, "expected keys and values at the top level"),
    ],
)
def test_faults_of_a_study_are_named(config, message):
    with pytest.raises(ConfigError) as caught:
        expand_scenarios(config)
    assert str(caught.value).isprintable()
    assert str(caught.value).startswith(f"config: {message}")


def test_the_page_follows_the_schemas(capsys):
    assert docs.main(["--check"]) == 0, "run python -m docs.write_keys"
    overview = docs.README.read_text("utf-8")
    for name, file in schema.files():
        study = None if file.parent == schema.FOLDER else file.parent
        stem = "top_level" if name == schema.TOP else name
        page = study / "keys.md" if study else docs.KEYS / f"{stem}.md"
        for key, _ in schema.leaves(schema.read(file)):
            assert f"| `{key}` |" in page.read_text("utf-8")
            assert study or f"`{key}`" in overview


def test_a_study_adds_keys_to_a_section_of_the_core_and_takes_none(tmp_path, monkeypatch):
    core, studies = tmp_path / "schemas", tmp_path / "studies"
    text = "properties: {{{}: {{type: number, default: 1}}}}"
    for path, keys in (
        (core / "run.schema.yaml", "seed"),
        (core / "walls.schema.yaml", "count"),
        (studies / "a" / "walls.schema.yaml", "colour"),
    ):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text.format(keys))
    monkeypatch.setattr(schema, "FOLDER", core)
    monkeypatch.setattr(schema, "STUDIES", studies)
    schema.sections.cache_clear()
    assert [*schema.sections(core)["walls"]["properties"]] == ["count", "colour"]
    (studies / "a" / "walls.schema.yaml").write_text(text.format("count"))
    schema.sections.cache_clear()
    with pytest.raises(ValueError, match="walls.count stands elsewhere too"):
        schema.sections(core)
    schema.sections.cache_clear()


def test_drift_of_the_page_is_found(tmp_path, monkeypatch, capsys):
    stale = tmp_path / "README.md"
    stale.write_text(docs.render().replace("6.48", "6.5"), "utf-8")
    monkeypatch.setattr(docs, "README", stale)
    monkeypatch.setattr(docs, "KEYS", tmp_path / "keys")
    assert docs.main(["--check"]) == 1
    assert docs.main([]) == 0
    assert docs.main(["--check"]) == 0
    (docs.KEYS / "gone.md").write_text("of a section that is no more", "utf-8")
    assert docs.main(["--check"]) == 1
    assert docs.main([]) == 0
    assert not (docs.KEYS / "gone.md").exists()
    (docs.KEYS / "facade.md").write_text("changed", "utf-8")
    assert docs.main(["--check"]) == 1


SHIPPED = [
    ROOT / "config" / "config.yaml",
    *sorted((ROOT / "config" / "scenarios").glob("*.yaml")),
    *sorted(ROOT.glob("workflow/studies/*/scenario.yaml")),
]


@pytest.mark.parametrize("path", SHIPPED, ids=lambda p: f"{p.parent.name}/{p.name}")
def test_shipped_files_resolve(path):
    check_files([path])
    stated = yaml.safe_load(path.read_text("utf-8"))
    if gone := stated.keys() - {*schema.whole()["properties"], *schema.STUDY_KEYS}:
        assert not any(schema.STUDIES.glob("*/rules.smk")), gone  # else its study is there
        pytest.skip(f"of a study that is not there: {', '.join(sorted(gone))}")
    assert expand_scenarios(stated)


COMMANDS = re.findall(r"^snakemake .*$", docs.README.read_text("utf-8"), re.MULTILINE)
EXPECTED = [
    {"tall": {"facade.height_m": 7.0, "facade.width_m": 4.4}},
    {"two": {"records": ["GMN_NS", "IS113_Lo"], "directions": ["neg"], "models": ["W1", "W2"]}},
    {"tall": {"facade.height_m": 7.0}},
    {"own_facade": {"facade.height_m": 7.2, "damping.law": "eq5", "facade.friction_deg": 30.0}},
    {"own_facade": {"facade.height_m": 7.2, "damping.law": "value"}},
    {"low": {"facade.height_m": 5.0, "facade.courses": 0, "smdof.base_shear_ratio": None}},
    {
        f"study-height_m_{h}-law_{law}": {"facade.height_m": float(h), "damping.law": law}
        for h in ("5", "6.48", "8")
        for law in ("value", "eq5")
    },
    {
        "building-stiff": {"smdof.period_s": 0.15},
        "building-study": {"smdof.period_s": 0.27},
        "building-flexible": {"smdof.period_s": 0.45},
    },
    {"building-stiff": {"smdof.period_s": 0.15, "smdof.damping_ratio": 0.05}},
    {f"walls-thickness_m_{b}": {"facade.thickness_m": float(b)} for b in ("0.25", "0.375", "0.5")},
]
WORKFLOW = """\
import json, sys
sys.path.insert(0, {workflow!r})
from rocking.configuration.config import expand_scenarios
configfile: "config/config.yaml"
RUNS = expand_scenarios(config)
with open("runs.json", "w") as stream:
    json.dump(RUNS, stream)
rule all:
    input: expand("results/{{run}}/ida/W1/GMN_NS_neg.csv", run=RUNS)
rule one:
    output: "results/{{run}}/ida/{{model}}/{{record}}_{{direction}}.csv"
    shell: "touch {{output}}"
"""


@pytest.fixture(scope="module")
def toy(tmp_path_factory):
    """A workflow of the same configuration whose only rule makes empty files."""
    folder = tmp_path_factory.mktemp("toy")
    shutil.copytree(ROOT / "config", folder / "config")
    (folder / "Snakefile").write_text(WORKFLOW.format(workflow=str(ROOT / "workflow")))
    return folder


@pytest.mark.slow
@pytest.mark.parametrize(("command", "expected"), list(zip(COMMANDS, EXPECTED, strict=True)))
def test_command_lines_of_the_page_reach_the_runs(toy, command, expected):
    program, *words = shlex.split(command)
    done = run(toy, program, "-n", "-q", *words)
    assert done.returncode == 0, done.stderr
    runs = json.loads((toy / "runs.json").read_text())
    assert list(runs) == list(expected)
    for name, values in expected.items():
        assert {p: json.loads(relevant(runs[name], p))[p] for p in values} == values


def test_what_a_scenario_or_a_cell_states_is_stated_of_its_run():
    found = expanded(
        {
            "run": "x",
            "facade": {"height_m": 5.0},
            "scenarios": {"thick": {"facade": {"thickness_m": 0.6}}, "dotted": {"seed": 3}},
            "grid": {"facade.width_m": [4.0, 6.0]},
        }
    )
    facades = [stated["facade"] for _, stated in found.values()]
    plain = [{"height_m": 5.0, "width_m": width} for width in (4.0, 6.0)]
    assert facades == [*({**one, "thickness_m": 0.6} for one in plain), *plain]
    assert [stated.get("seed") for _, stated in found.values()] == [None, None, 3, 3]
    assert [one["run"] for one, _ in found.values()] == list(found)
