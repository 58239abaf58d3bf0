"""No key is silent: what acts only beside another key says so in its schema, and is named."""

import itertools
import warnings

import pytest
from rocking.collapse.case import Case
from rocking.configuration import unlikely
from rocking.configuration.config import expanded, resolve
from rocking.configuration.layers import nest
from rocking.configuration.schema import leaves, whole
from rocking.configuration.together import NoEffectWarning, met, needs, without_effect

from yade_scripts.model import models, storeys

# sections whose keys a scene, its chain and its loops are made of, and a model that has them all
MODELS = {"facade": "W2c", "return_wall": "W2cm", "damping": "W2", "smdof": "W2", "w3": "W3"}
# read once a scene is there: by a step, by the scan of bricks, by what is said of the building
AFTER_THE_SCENE = ("w3.step_fraction", "w3.scan.", "smdof.fallen_drift_ratio")
BLOCK = {"facade.courses": 0, "smdof.base_shear_ratio": None}  # what bricks take
ENOUGH = {  # what lets a condition hold, by key
    "facade.courses": 4,
    "facade.parapet_height_m": 1.0,
    "facade.parapet_thickness_m": 0.2,
    "facade.wedge_deg": 10.0,
    "smdof.base_shear_ratio": 0.2,
    "smdof.loss_drift_ratio": 0.01,
    "w3.lower_courses": 3,
}
KEYS = {
    path: schema
    for path, schema in leaves(whole())
    if path.split(".")[0] in MODELS and not path.startswith(AFTER_THE_SCENE)
}


def others(schema):
    """Values of a key beside its default."""
    low = schema.get("minimum", schema.get("exclusiveMinimum", 0.0))
    high = schema.get("maximum", schema.get("exclusiveMaximum", 1e9))
    kinds = schema.get("type", [])
    if "enum" in schema:
        return [value for value in schema["enum"] if value != schema["default"]]
    if "boolean" in kinds:
        return [not schema["default"]]
    start = schema["default"] or 0.5
    if "integer" in kinds:
        return [int(start) + 1]
    if "number" in kinds:
        usual = schema.get("usual", [start])
        found = (1.1 * start, 0.9 * start, usual[0], 1.0)
        return [value for value in found if low < value < high and value != schema["default"]]
    return []  # rows of a list


def made(given, model):
    """What a case's solvers start from, in one text; None where it is refused."""
    own = BLOCK if model == "W3" else {}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            case = Case.configured(model, nest({**own, **given}, "test")).sections
            scene = models.build_scene(case)
        except ValueError:
            return None
    chain = case["smdof"]
    parts = scene, storeys.storeys_of(case), chain["damping_model"], chain["damping_ratio"]
    parts += storeys.storey_height(case), chain["tail_s"], case["beta_s"], chain["period_s"]
    return repr(parts)


def silent(base, path, schema, model):
    """Whether no other value of a key changes anything beside `base`."""
    as_it_is = made(base, model)
    found = [made({**base, path: value}, model) for value in others(schema)]
    return bool(found) and all(one == as_it_is for one in found)


def unmet(path, given, model):
    """Whether a key's schema says that it does nothing beside what is given."""
    own = BLOCK if model == "W3" else {}
    resolved = resolve(nest({**own, **given, "models": [model]}, "test"))
    sets = needs(KEYS[path])
    return bool(sets) and not any(met(one, resolved) for one in sets)


@pytest.mark.parametrize("path", KEYS)
def test_a_key_that_changes_nothing_says_what_it_acts_with(path):
    """By the scenes themselves: no list names the keys."""
    model = MODELS[path.split(".")[0]]
    if silent({}, path, KEYS[path], model):
        assert unmet(path, {}, model), f"{path}: changes nothing, and its schema has no acts_with"


SWITCHES = {"smdof.base_shear_ratio": None, "facade.courses": 0, "damping.law": "fitted"}
SWITCHES |= {"w3.header_joint": "rigid", "w3.lower_courses": 0, "smdof.loops": "origin_oriented"}


@pytest.mark.parametrize("switch", SWITCHES)
def test_what_a_switch_turns_off_says_so(switch):
    section = switch.split(".")[0]
    model, base = MODELS[section], {switch: SWITCHES[switch]}
    own = [p for p in KEYS if p.startswith(f"{section}.") and p != switch]
    off = [p for p in own if silent(base, p, KEYS[p], model)]
    assert off
    assert [p for p in off if not unmet(p, base, model)] == []


DECLARED = [path for path in KEYS if needs(KEYS[path])]


@pytest.mark.parametrize("path", DECLARED)
def test_with_what_it_acts_with_a_key_does_something(path):
    """No schema says too much."""
    model = MODELS[path.split(".")[0]]
    for one in needs(KEYS[path]):
        base = {
            key: wanted.get("const", wanted.get("enum", [ENOUGH.get(key)])[0])
            for key, wanted in one.items()
            if key != "facade.sides"
        }
        if None in base.values():
            continue  # by another key of its list
        base |= {"facade.wedge_thickness_m": 0.7} if "facade.wedge_deg" in base else {}
        base |= {"facade.courses": 0} if "facade.wedge_deg" in base else {}
        model = "W1" if "facade.wedge_deg" in base or "facade.courses" in base else model
        base.pop(path, None)
        found = {made({**base, path: value}, model) for value in others(KEYS[path])}
        assert len(found - {None, made(base, model)}) > 0, (path, base)


def said(given):
    """Lines about a configuration, as a run prints them."""
    runs = expanded(given)
    settled = {run: resolved for run, (resolved, _) in runs.items()}
    return unlikely.lines(settled, {run: stated for run, (_, stated) in runs.items()})


@pytest.mark.parametrize(
    ("given", "line"),
    [
        (
            {"smdof": {"base_shear_ratio": None, "loops": "flag"}},
            "smdof.loops = 'flag' has no effect without smdof.base_shear_ratio = a number "
            "(found null)",
        ),
        (
            {"facade": {"flush_face": "inner"}},
            "facade.flush_face = 'inner' has no effect without facade.top_thickness_m = a "
            "number (found null) or facade.thickness_steps = a list that is not empty (found []) "
            "or facade.parapet_height_m = a number > 0 (found 0) and "
            "facade.parapet_thickness_m = a number (found null)",
        ),
        (
            {"facade": {"floors": [{"height_m": 3.0, "load_kn": 10.0, "period_s": 0.2}]}},
            "facade.floors[1].period_s = 0.2 has no effect without mass_t = a number > 0 (found 0)",
        ),
        (
            {"assessment": {"arch_thrust_kn": 3.0}},
            "assessment.arch_thrust_kn = 3 has no effect without assessment.mechanisms = a "
            "list with 'horizontal' (found ['compound'])",
        ),
    ],
)
def test_a_key_without_what_it_acts_with_is_named_in_one_line(given, line):
    if not {*given} <= {*whole()["properties"]}:
        pytest.skip("of a study that is not there")
    assert said(given) == [line]


def test_of_several_runs_those_are_named_in_which_a_key_does_nothing():
    given = {"smdof": {"loops": "flag"}, "models": ["W2"]}
    (line,) = said({**given, "grid": {"smdof.base_shear_ratio": [None, 0.2]}})
    assert line.startswith("main-base_shear_ratio_null: smdof.loops = 'flag' has no effect")
    (both,) = said({**given, "grid": {"smdof.base_shear_ratio": [None], "seed": [1, 2]}})
    assert both.startswith("smdof.loops = 'flag' has no effect")


def test_what_is_as_it_would_be_unsaid_is_not_named():
    """A run's whole configuration, given back, says every key."""
    for given in ({}, {"facade": {"courses": 0}}, {"models": ["W3m"]}, {"damping": {"law": "eq5"}}):
        resolved = resolve(given)
        assert list(without_effect(resolved, resolved)) == []


def test_python_is_warned_too():
    with pytest.warns(NoEffectWarning, match=r"smdof\.hardening = 0\.1 has no effect"):
        Case.configured("W2", {"smdof.base_shear_ratio": None, "smdof.hardening": 0.1})


def test_a_free_standing_wall_without_a_model_of_walls_is_read():
    """Without what is stated the rest may be no configuration."""
    with pytest.warns(NoEffectWarning, match=r"return_wall\.friction_deg = 20 has no effect"):
        Case.configured("W1", {"facade.sides": "two", "return_wall.friction_deg": 20.0})


def test_conditions_name_keys_that_there_are():
    known = [path for path, _ in leaves(whole())]
    for path, schema in leaves(whole()):
        entries = leaves(schema.get("items", {}))
        for part in [schema, *(one for _, one in entries)]:
            own = {key for key, _ in leaves(schema.get("items", {}))}
            for key in itertools.chain.from_iterable(needs(part)):
                assert key in known or key in own, (path, key)
