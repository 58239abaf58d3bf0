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
