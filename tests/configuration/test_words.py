"""Keys and values as captions say them."""

import pickle

from rocking.configuration import config
from rocking.configuration.words import heading, said


def test_parameters_are_words_and_the_same_text_as_before():
    given = config.relevant(config.resolve({"facade": {"height_m": 5.75}}), "facade")
    assert given.words.startswith("height 5.75 m, ") or ", height 5.75 m" in given.words
    for piece in ("thickness 0.375 m", "density 1800 kg/m³", "friction 30°", "E 1800 MPa"):
        assert piece in given.words
    for sign in '{}":':
        assert sign not in given.words
    assert "None" not in given.words
    assert pickle.loads(pickle.dumps(given)) == given


def test_units_stand_behind_the_value():
    assert said("pga_g", 0.25) == "PGA 0.25 g"
    assert said("n_dof", 4) == "masses 4"
    assert heading("pga_safe_g") == "PGA safe [g]"
    assert heading("period_paper_s") == "period study [s]"


def test_lists_are_words_too_and_empty_ones_are_left_out():
    facade = {"ties": [{"height_m": 5.0}, {"height_m": 2.5}], "hinges_m": [3.0]}
    words = config.relevant(config.resolve({"facade": facade}), "facade").words
    assert "ties (count 2, diameter 20 mm, E 200000 MPa, elongation 0.05, height 5 m, " in words
    assert ", height 2.5 m, length 4 m" in words
    assert "hinges 3 m" in words
    for absent in ("{", "[", "openings", "floors", " ,", "  "):
        assert absent not in words


def test_what_there_is_none_of_is_left_out_and_a_stated_nought_is_not():
    facade = {"friction_deg": 0.0, "tilt_deg": 1.5, "courses": 0}
    words = config.relevant(config.resolve({"facade": facade}), "facade").words
    assert "friction 0°" in words
    assert "tilt 1.5°" in words
    for absent in ("gable", "parapet", "gap", "bond", "courses 0", "base height"):
        assert absent not in words
