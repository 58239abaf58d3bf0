"""Configuration: schemas, defaults, and refusals in one line."""

import copy
import datetime
import json
import os
import shutil

import jsonschema
import pytest
import yaml
from rocking.configuration import files
from rocking.configuration import schema as config_schema
from rocking.configuration.__main__ import main as check_yaml
from rocking.configuration.config import (
    ConfigError,
    check_files,
    expand_scenarios,
    relevant,
    resolve,
    write_resolved,
)

from tests.trials import fuzz_config
from yade_scripts.model import registry

LEAVES = list(config_schema.leaves(config_schema.whole()))


def refusal(config, function=resolve):
    with pytest.raises(ConfigError) as caught:
        function(config)
    text = str(caught.value)
    assert text.isprintable()
    return text


@pytest.mark.parametrize(("path", "schema"), LEAVES, ids=[path for path, _ in LEAVES])
def test_every_key_is_described_and_its_default_is_valid(path, schema):
    assert {"unit", "description", "default"} <= set(schema), path
    assert {"type", "anyOf", "oneOf"} & set(schema), path
    assert schema["description"].strip().endswith("."), f"{path}: a sentence"
    jsonschema.Draft202012Validator.check_schema(schema)
    default = config_schema.complete(schema["default"], schema)
    jsonschema.Draft202012Validator(schema).validate(default)
    for word in ("below", "at_most"):
        assert schema.get(word, path) in dict(LEAVES), f"{path}: {word} names no key"


def test_units_in_names_agree_with_the_schema():
    suffixes = {
        "_m": "m",
        "_s": "s",
        "_g": "g",
        "_hz": "Hz",
        "_deg": "°",
        "_mpa": "MPa",
        "_kg_m3": "kg/m³",
        "_pa_m": "Pa/m",
        "_m_s": "m/s",
    }
    for path, schema in LEAVES:
        ending = max((e for e in suffixes if path.endswith(e)), key=len, default=None)
        if ending is not None:
            assert schema["unit"] == suffixes[ending], path


def test_sections_refuse_unknown_keys_by_schema():
    for name, schema in config_schema.sections().items():
        assert schema["additionalProperties"] is False, name


def test_a_schema_file_more_is_a_section_more(tmp_path):
    for name in ("run", "facade"):
        shutil.copy(config_schema.FOLDER / f"{name}.schema.yaml", tmp_path)
    text = "type: object\nproperties: {size_m: {type: number, unit: m, default: 2}}\n"
    (tmp_path / "extra.schema.yaml").write_text(text)
    known = config_schema.whole(tmp_path)
    assert list(config_schema.sections(tmp_path)) == ["run", "extra", "facade"]
    assert config_schema.complete({}, known)["extra"] == {"size_m": 2.0}


def test_limits_of_a_list_hold_for_each_of_its_entries(monkeypatch):
    """As a study has them that varies a key with such a limit."""
    known = copy.deepcopy(config_schema.whole())
    gaps = {"type": "array", "default": [0.0], "items": {"below": "facade.thickness_m"}}
    known["properties"]["gaps"] = {"properties": {"gaps_m": gaps}}
    monkeypatch.setattr(config_schema, "whole", lambda: known)
    assert resolve({"gaps": {"gaps_m": [0.0, 0.3]}})["gaps"] == {"gaps_m": [0.0, 0.3]}
    line = "config: gaps.gaps_m[2] = 0.5: expected a value below facade.thickness_m = 0.375"
    assert refusal({"gaps": {"gaps_m": [0.0, 0.5]}}) == line


def test_models_are_those_of_their_registry():
    models = config_schema.sections()["run"]["properties"]["models"]
    for name in registry.WITH_WALLS:
        assert f"{name}: {registry.MODELS[name].meaning}" in models["description"]


def test_an_empty_configuration_is_a_facade_of_the_size_of_the_studys():
    one = resolve({})
    assert (one["facade"]["height_m"], one["facade"]["thickness_m"]) == (6.48, 0.375)
    assert one["damping"] == {"law": "eq5", "beta_s": 0.00276}
    assert (one["smdof"]["n_dof"], one["smdof"]["period_s"]) == (4, 0.27)
    assert one["return_wall"]["length_m"] is None
    assert resolve(one) == one


def test_text_from_the_command_line_resolves_like_numbers():
    typed = {
        "facade": {"height_m": 7, "gap_m": 0.001, "base_stiffness_pa_m": None},
        "numerics": {"nodes_height": 7, "retry_half_step": False},
        "vertical_motion": True,
        "records": ["A", "B"],
        "models": ["W1"],
        "ida": {"grid_g": [0.1, 0.2]},
        "run": "2024",
        "smdof": {},
    }
    assert resolve({"facade": {"courses": "6"}})["facade"]["courses"] == 6
    assert "facade.courses = 1: expected 0 or a whole number from 2" in refusal(
        {"facade": {"courses": "1"}}
    )
    text = {
        "facade": {"height_m": "7.0", "gap_m": "1e-3", "base_stiffness_pa_m": "null"},
        "numerics": {"nodes_height": "7", "retry_half_step": "false"},
        "vertical_motion": "on",
        "records": "A, B",
        "models": "W1",
        "ida": {"grid_g": "0.1,0.2"},
        "run": 2024,
        "smdof": None,
    }
    assert resolve(typed) == resolve(text)
    assert json.dumps(resolve(typed)) == json.dumps(resolve(text))  # types too
    assert resolve({"run": datetime.date(2024, 5, 17)})["run"] == "2024-05-17"  # YAML's reading


def test_resolving_leaves_its_input_and_the_schemas_alone():
    given = {"models": ["W1"]}
    resolve(given)["models"].append("W2")
    assert given == {"models": ["W1"]}
    resolve({})["directions"].clear()
    assert resolve({})["directions"] == ["pos", "neg"]


@pytest.mark.parametrize(
    ("config", "message"),
    [
        ({"facade": {"hieght_m": 3}}, "unknown key 'facade.hieght_m'; did you mean 'facade.heigh"),
        ({"fasade": {}}, "unknown key 'fasade'; did you mean 'facade'?"),
        ({"height_m": 7}, "unknown key 'height_m'; did you mean 'facade.height_m'?"),
        ({"friction_deg": 9}, "unknown key 'friction_deg'; did you mean 'facade.friction_deg' or"),
        (
            {"facade": {"height_m": "9", "5": None}},
            "'5' in 'facade' is no key: for a",
        ),
        ({"facade": {"thickness_m": 0, 42: None}}, "'42' in 'facade' is no key: for a decimal"),
        ({"record": "A"}, "unknown key 'record'; did you mean 'records' or 'pictures.record'?"),
        ({"facade": {"height_m:9.5": None}}, "'height_m:9.5' in 'facade': write a space after"),
        ({"facade": {"height_m": "9,5"}}, "facade.height_m = '9,5': expected a number > 0"),
        ({"facade": {"beta_s": 1}}, "unknown key 'facade.beta_s'; did you mean 'damping.beta_s'?"),
        ({"scenaros": {}}, "unknown key 'scenaros'; did you mean 'scenarios'?"),
        ({"damping": {"zzz": 1}}, "unknown key 'damping.zzz'; expected one of law, beta_s"),
        ({"facade": {"height_m": -3}}, "facade.height_m = -3: expected a number > 0 and ≤ 50 (m)"),
        ({"facade": {"height_m": "tall"}}, "facade.height_m = 'tall': expected a number > 0"),
        ({"facade": {"height_m": None}}, "facade.height_m = null: expected a number > 0"),
        ({"facade": {"height_m": True}}, "facade.height_m = true: expected a number > 0"),
        ({"facade": {"height_m": float("nan")}}, "facade.height_m = nan: expected a finite number"),
        ({"facade": {"height_m": "nan"}}, "facade.height_m = 'nan': expected a number > 0"),
        ({"facade": {"height_m": "1_0"}}, "facade.height_m = '1_0': expected a number > 0"),
        ({"facade": 3}, "facade = 3: expected a section"),
        ({"numerics": {"nodes_height": 5.5}}, "numerics.nodes_height = 5.5: expected a whole"),
        ({"damping": {"law": "eq6"}}, "damping.law = 'eq6': expected one of value, eq5, fitted"),
        (
            {"models": ["W1", "W9"]},
            f"models[2] = 'W9': expected one of {', '.join(registry.WITH_WALLS)}",
        ),
        ({"models": ["W1", "W1"]}, "models = ['W1', 'W1']: expected a list of 1 or more different"),
        ({"models": []}, "models = []: expected a list of 1 or more"),
        ({"ida": {"grid_g": [0.1, -1]}}, "ida.grid_g[2] = -1: expected a number > 0 and ≤ 20 (g)"),
        ({"ida": {"grid_g": [0.2, 0.1]}}, "ida.grid_g = [0.2, 0.1]: expected ascending values"),
        ({"run": True}, "run = true: expected text of letters"),
        ({"records": ["../../etc/passwd"]}, "records = ['../../etc/passwd']: expected 'all'"),
        ({1: 2}, "key 1 at the top level: expected text; quote it"),
        ({"facade": {"height_m": 10**5000}}, "facade.height_m: expected a number of fewer digits"),
        ({"facade": {"height_m": b"x"}}, "facade.height_m: a value of type bytes has no"),
        ({"grid": {"facade.height_m": [1]}}, "'grid' describes several runs"),
    ],
)
def test_refusals_name_the_key_and_what_was_expected(config, message):
    assert refusal(config).startswith(f"config: {message}")


@pytest.mark.parametrize(
    ("config", "message"),
    [
        ({"facade": {"height_m": 0.74}}, "facade.height_m = 0.74: expected at least 2 × "),
        ({"facade": {"gap_m": 0.375}}, "facade.gap_m = 0.375: expected a value below facade.thick"),
        ({"facade": {"tilt_deg": 3.4}}, "facade.tilt_deg = 3.4: expected less than atan"),
        ({"return_wall": {"count": 12}}, "return_wall.count = 12: expected count × thickness_m"),
        ({"return_wall": {"thickness_m": 5}}, "return_wall.thickness_m = 5: expected a value at"),
        ({"facade": {"sides": "two"}}, "models = ['W1', 'W2', 'W2m']: expected [W1] with facade."),
        (
            {"facade": {"sides": "two"}, "models": "W1", "damping": {"law": "eq5"}},
            "damping.law = eq5: expected value with facade.sides = two",
        ),
        ({"facade": {"gap_m": 0.01}, "models": "W2c"}, "facade.gap_m = 0.01: expected 0 (m)"),
        ({"facade": {"tilt_deg": 0.2}, "models": "W1c"}, "facade.tilt_deg = 0.2: expected 0 (°)"),
        ({"baseline": {"highpass_hz": 9, "lowpass_hz": 9}}, "baseline.highpass_hz = 9: expected"),
        (
            {"models": "W3", "facade": {"height_m": 5.75}},
            "w3.course_height_m = 0.324: expected a divisor of facade.height_m = 5.75 (m), so that "
            "whole courses fill the height, as 0.319444 (18 courses), with model W3",
        ),
        (
            {"models": "W3m", "w3": {"header_joint": "study"}},
            "w3.header_joint = 'study': expected another rule for W3m",
        ),
        (
            {"models": "W3", "w3": {"header_joint": "study", "split_inclination_deg": 30}},
            "w3.split_inclination_deg = 30: expected less than 21.1 (°)",
        ),
        ({"ida": {"start_g": 3}}, "ida.start_g = 3: expected a value below ida.max_pga_g = 3"),
        ({"ensemble": {"percentiles": [60, 90]}}, "ensemble.percentiles = [60, 90]: expected one"),
    ],
)
def test_impossible_geometry_and_combinations_are_refused(config, message):
    assert refusal(config).startswith(f"config: {message}")


def test_the_limits_themselves_are_allowed():
    # b/h = 0.05787, so 3.29° stands on rock and 3.32° has fallen; 11 walls of 0.4 m just fill 4.4 m
    resolve({"facade": {"tilt_deg": 3.29, "base_stiffness_pa_m": 1e15, "courses": 0}})
    refusal({"facade": {"tilt_deg": 3.32, "base_stiffness_pa_m": 1e15, "courses": 0}})
    slides = {"friction_deg": 0.0, "tilt_deg": 0.5}  # along the joints of its courses
    assert "facade.tilt_deg = 0.5: expected 0" in refusal({"facade": slides})
    resolve({"return_wall": {"count": 11, "thickness_m": 0.4}})
    resolve({"facade": {"height_m": 0.75}})
    resolve(
        {"facade": {"sides": "two", "gap_m": 0.1}, "models": "W1", "return_wall": {"count": 20}}
    )


def test_cycles_and_bombs_are_refused_quickly():
    loop = {}
    loop["facade"] = loop
    assert "levels deep" in refusal(loop)
    bomb = ["lol"] * 10
    for _ in range(8):
        bomb = [bomb] * 10
    assert "more than 20000 values" in refusal({"facade": bomb})
    assert "combinations" in refusal(
        {"grid": {"facade.height_m": list(range(40)), "facade.width_m": list(range(40))}},
        expand_scenarios,
    )


def test_relevant_changes_with_its_own_sections_only():
    base, tall = resolve({}), resolve({"facade": {"height_m": 7.0}})
    assert relevant(base, "facade") != relevant(tall, "facade")
    assert relevant(base, "smdof", "seed") == relevant(tall, "smdof", "seed")
    assert relevant(base, "facade.width_m") == relevant(tall, "facade.width_m")
    assert json.loads(relevant(tall, "facade.height_m")) == {"facade.height_m": 7.0}
    with pytest.raises(KeyError):
        relevant(base, "facades")


def test_the_written_configuration_gives_the_run_again(tmp_path):
    one = resolve(
        {
            "run": "tall",
            "facade": {"height_m": 1e-5, "thickness_m": "1e-6"},
            "numerics": {"node_radius_m": 1e-7},
            "ensemble": {"enabled": "off"},
            "records": ["1ST280", "2024"],
        }
    )
    path = tmp_path / "new" / "config.yaml"
    write_resolved(one, path)
    assert list(expand_scenarios(yaml.safe_load(path.read_text("utf-8"))).values()) == [one]
    check_files([path])
    os.utime(path, (1, 1))
    write_resolved(one, path)
    assert path.stat().st_mtime == 1  # the same text does not make later steps run again
    write_resolved(resolve({}), path)
    assert "run: main" in path.read_text("utf-8")
    assert [p.name for p in path.parent.iterdir()] == ["config.yaml"]


def test_a_key_that_stands_twice_is_refused_with_its_line(tmp_path):
    path = tmp_path / "own.yaml"
    path.write_text("run: a\nfacade:\n  height_m: 7\n  width_m: 4\n  height_m: 8\n")
    assert refusal([path], check_files) == f"config: {path} line 5: key 'height_m' stands twice"
    path.write_text("a: &x {k: 1}\nb: {<<: *x, k: 2}\n")  # a merge key may be overridden
    check_files([path])
    path.write_text("run: [a\n")
    assert f"{path} line 2" in refusal([path], check_files)
    path.write_text("run: 2024-13-45\n")
    assert "not readable as YAML" in refusal([path], check_files)
    path.write_bytes(b"run: \xff\n")
    assert "not UTF-8" in refusal([path], check_files)
    assert "No such file" in refusal([tmp_path / "absent.yaml"], check_files)
    assert "YAML" in refusal([], lambda _: files.check_text("[" * 5000, "deep.yaml"))


@pytest.mark.parametrize(
    ("written", "read"), [("010", "8"), ("1:30", "90"), ("0x10", "16"), ("0b11", "3")]
)
def test_a_number_that_yaml_reads_as_another_is_refused_with_its_line(written, read):
    def check(text):
        files.check_text(text, "own.yaml")

    said = refusal(f"run: a\nfacade:\n  height_m: {written}\n", check)
    assert said.startswith(f"config: own.yaml line 3: {written} is {read} to YAML")
    check(f"run: a\nrecords: ['{written}']\n")  # text in quotation marks is what it is
    check("facade: {height_m: 1_0.5, tilt_deg: -0.5, width_m: +4, e_mpa: 1.8e+3}\n")


@pytest.mark.parametrize("text", ["", "# nothing\n", "- run: a\n", "hello\n"])
def test_a_file_without_keys_is_named_before_snakemake_reads_it(tmp_path, capsys, text):
    path = tmp_path / "own.yaml"
    path.write_text(text)
    assert check_yaml([str(path)]) == 1
    assert capsys.readouterr().err == (
        f"error: config: {path}: expected keys at the top level, as run: mine\n"
    )
    assert check_yaml([]) == check_yaml(["--help"]) == 2


def test_a_fault_in_the_yaml_is_named_before_snakemake_reads_it(tmp_path, capsys):
    """Snakemake reads files before the workflow has a word, and names neither file nor line."""
    path = tmp_path / "own.yaml"
    path.write_text("facade:\n  height_m: 5\n thickness_m: 1\n")
    assert check_yaml([str(path)]) == 1
    assert capsys.readouterr().err.startswith(f"error: config: {path} line 3: ")
    path.write_text("facade:\n  height_m: 5\n")
    assert check_yaml([str(path)]) == 0


@pytest.mark.slow
def test_fuzzed_configurations_resolve_or_are_refused_in_one_line():
    outcomes, failure = fuzz_config.fuzz(600, seed=20)
    assert failure is None, failure
    assert min(outcomes["refused"], outcomes["resolved"]) > 60  # both paths were walked


@pytest.mark.parametrize(
    ("entry", "words"),
    [
        ({"heigth_m": 5.0}, "did you mean 'height_m'?"),
        ({"colour": 1}, "expected one of height_m, "),
    ],
)
def test_a_wrong_key_in_a_list_is_answered_with_the_keys_of_its_entries(entry, words):
    with pytest.raises(ConfigError) as error:
        resolve({"facade": {"ties": [entry]}})
    assert f"facade.ties[1].{next(iter(entry))}" in str(error.value)
    assert words in str(error.value)


def test_a_run_with_a_hazard_curve_takes_a_studys_settings_but_what_is_stated():
    plain, rated = resolve({}), resolve({"risk": {"hazard": "curve.csv"}})
    assert (plain["ida"]["power"], rated["ida"]["power"]) == (0.95, 0.0)
    assert plain["ida"]["confirm_every"] is None
    assert rated["ensemble"]["enabled"] == "off"
    assert (rated["ida"]["confirm"], rated["ida"]["confirm_every"]) == ("collapse", 8)
    own = {"ida": {"confirm_every": 2, "level_ratio": 0.03}, "ensemble": {"enabled": "auto"}}
    asked = resolve({"risk": {"hazard": "curve.csv"}, **own})
    assert asked["ensemble"]["enabled"] == "auto"
    assert asked["ida"] == {**rated["ida"], **own["ida"]}
    assert resolve(rated) == rated


BY_THEMSELVES = ("complete.", "two_components.")  # these searches do not ask `collapse_curve`


def test_the_steps_that_studies_hand_to_a_search_are_within_its_limits():
    """What the configuration accepts ends no job: `collapse_curve` knows the limits of ida."""
    known = dict(LEAVES)
    own = known["ida.level_ratio"]
    handed = {
        key: leaf
        for key, leaf in known.items()
        if key.endswith("level_ratio") and not key.startswith(BY_THEMSELVES)
    }
    assert "w3.scan.level_ratio" in handed
    for key, leaf in handed.items():
        assert own["minimum"] <= leaf["minimum"] < leaf["maximum"] <= own["maximum"], key
