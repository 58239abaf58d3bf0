"""A façade as values: what its section states, no more and no less."""

from dataclasses import MISSING, fields

import pytest
from rocking.configuration import schema
from study_cases import study_case, study_settings

from yade_scripts.model.facades import NEEDED, ROWS, Facade
from yade_scripts.model.shape import shape_of

SECTION = schema.sections()["facade"]["properties"]


def section(**own):
    return study_settings({"facade": own, "models": ["W1"]})["facade"]


def test_its_keys_and_defaults_are_those_of_the_schema():
    """A key that is added to the schema is added here; a default stands in both or in the first."""
    for kind, keys in [(Facade, SECTION)] + [
        (row, SECTION[key]["items"]["properties"]) for key, row in ROWS.items()
    ]:
        assert {one.name for one in fields(kind)} == keys.keys(), kind.__name__
        for one in fields(kind):
            # a section without courses, as a case file of before, is one block
            if one.default is not MISSING and not one.name.startswith("courses"):
                stated = keys[one.name].get("default")
                assert one.default == (tuple(stated) if isinstance(stated, list) else stated)


def test_two_of_the_same_values_are_equal_and_share_their_shape():
    one, other = (Facade.of(section(ties=[{"height_m": 3.0}])) for _ in range(2))
    assert one == other
    assert shape_of(one) is shape_of(other)
    assert Facade.of(one) is one
    assert one != Facade.of(section(ties=[{"height_m": 3.0, "slack_mm": 1.0}]))


def test_a_case_has_its_facade_as_values():
    case = study_case("W1", {"facade": {"height_m": 6.0, "floors": [FLOOR]}})
    assert case.facade.height_m == 6.0
    assert case.facade.floors[0].load_n == 4e3
    assert case.facade == Facade.of(case["facade"])


FLOOR = {"height_m": 3.0, "load_kn": 4.0}


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"e_mpa": None}, "facade.e_mpa: expected a value, found none"),
        ({"heigth_m": 3.0}, "facade.heigth_m: expected one of"),
        ({"ties": [{"height_m": 3.0}]}, r"facade.ties\[1\].count: expected a value, found none"),
        ({"openings": [3.0]}, r"facade.openings\[1\] = 3.0: expected keys and values"),
    ],
)
def test_a_key_that_is_missing_or_unknown_is_named(changed, said):
    given = {**section(), **changed}
    given = {key: value for key, value in given.items() if (key, value) != ("e_mpa", None)}
    with pytest.raises(ValueError, match=f"^{said}"):
        Facade.of(given)


def test_what_a_section_must_state_has_no_default():
    assert {"height_m", "thickness_m", "width_m", "density_kg_m3", "e_mpa"} <= NEEDED[Facade]
