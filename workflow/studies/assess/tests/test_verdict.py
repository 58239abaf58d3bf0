"""What the report says first, of tables whose verdict is plain to see."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
from studies.assess.advice import damage, next_steps
from studies.assess.catalogue import SAY
from studies.assess.names import PLACES
from studies.assess.verdict import (
    capacity,
    decided_by,
    headline,
    held_or_not,
    kinematic,
    no_rate,
    passes,
    relied_on,
    suite,
)
from studies.assess.walls import named

CHECKS = pd.DataFrame({"check": ["linear_ground"], "pga_demand_g": [0.2], "ratio": [1.2]})
WHOLE = "whole façade about its base"
SHAKEN = pd.DataFrame({"part": ["whole"], "mechanism": [WHOLE], "shaken": [1], "why_not": [""]})
NOWHERE = {key: np.nan for key in (*PLACES, "middle_m")} | {"foot_m": 0.0, "side": 0}
SHAKEN = SHAKEN.assign(**NOWHERE, at_foot="base", pga_fails_g=0.25)
FACADE = SimpleNamespace(courses=4, base="study", base_stiffness_pa_m=None)
ABOUT = {"when": "In 475 years", "factor": 1.35, "wall": named(FACADE)}
BENT = {"foot_m": 0.0, "held_m": 3.5, "hinge_m": 2.0}
CORNER = {"foot_m": 0.0, "side": -1}


def tables(found, shaken=SHAKEN, checks=CHECKS, **own):
    """A report's tables whose mechanisms fail by hand at these PGAs."""
    every = {"code_checks": checks, "mechanisms": mechanisms(**own)}
    return {**every, "verdicts": found, "shaken": shaken}


def mechanisms(**pga_fails_g):
    """Parts, some of them with where they are: "bent" and "corner"."""
    places = {"bent": BENT, "corner": CORNER}
    rows = [
        {**NOWHERE, **places.get(part, {}), "part": part, "pga_fails_g": pga_g}
        for part, pga_g in pga_fails_g.items()
    ]
    found = pd.DataFrame(rows).assign(kind="as stated", at_foot="base", links_left_out=0)
    return found.assign(pga_letter_g=found["pga_fails_g"])


def verdicts(*slv, agree=1.0):
    rows = [(f"W{i}", 11, 0 if one else 2, 0.05, 0.1, one, agree) for i, one in enumerate(slv, 1)]
    names = ["model", "motions", "exceed_d0", "mean_d_m", "d_slv_m", "slv", "agree"]
    return pd.DataFrame(rows, columns=names).assign(d0_m=0.25, part="whole")


def dynamic(stations):
    enough = stations >= 7
    row = {"model": "W2", "stations": stations, "curves": stations, "fell_at_demand": 1}
    row |= {"least_pga_g": 0.15, "probability": 0.3 if enough else np.nan}
    row |= {"probability_low": 0.1, "probability_high": 0.6}
    return pd.DataFrame([row])


def test_a_facade_passes_where_every_model_holds_and_the_worst_of_them_governs():
    """W1 at 0.5 of d_SLV and W2 beyond d0: W2 governs; where both hold, the nearer to d_SLV."""
    stood = mechanisms(whole=0.25)
    assert passes(CHECKS, stood, verdicts(True, True)) == (True, True)
    assert passes(CHECKS, stood, verdicts(True, False)) == (True, False)
    assert passes(CHECKS, mechanisms(whole=0.15), verdicts(True, True)) == (False, True)
    assert passes(CHECKS, stood, pd.DataFrame()) == (True, None)
    assert decided_by(verdicts(True, False)) == "W2"
    assert decided_by(verdicts(True, True).assign(mean_d_m=[0.06, 0.05])) == "W1"
    assert decided_by(verdicts(False, True).assign(mean_d_m=[0.02, 0.09])) == "W1"


def test_a_check_that_holds_in_too_few_draws_counts_as_not_passed_and_says_so():
    doubt = verdicts(True, True, agree=0.94).assign(part="whole")
    assert passes(CHECKS, mechanisms(whole=0.25), doubt) == (True, False)
    said = headline(tables(doubt, whole=0.25), ABOUT)
    assert "does not pass: life safety (SLV) is lost under recorded motions" in said[0]
    assert "only in 94 % of draws of perturbed ones" in said[2]
    assert list(held_or_not(doubt)) == ["doubt", "doubt"]
    assert list(held_or_not(verdicts(True, False))) == ["held", "lost"]
    assert passes(CHECKS, mechanisms(whole=0.25), doubt.assign(agree=0.95)) == (True, True)


@pytest.mark.parametrize(
    ("pga_g", "slv", "words"),
    [
        (0.25, True, "passes: life safety (SLV) is kept up to 125 %"),
        (0.15, True, "does not pass: life safety (SLV) is lost at 75 %"),
        (
            0.25,
            False,
            "does not pass: life safety (SLV) is lost under recorded motions; by hand it is kept "
            "up to 125 %",
        ),
    ],
)
def test_the_first_sentence_says_by_which_check_life_safety_is_lost(pga_g, slv, words):
    found = verdicts(slv).assign(part="whole")
    said = headline(tables(found, whole=pga_g), ABOUT)
    assert words in said[0]


def test_a_link_that_sets_d_slv_asks_for_rods_that_yield():
    """d_SLV of 0.1 m is 0.4 d0 of 0.25 m; of 0.5 m it is less, so a tie or an anchor gives way."""
    lost = verdicts(True, False)
    early = lost.assign(d0_m=0.5)
    rounded = lost.assign(d_slv_m=0.149749, d0_m=0.374374)  # six figures of 0.4 d0
    for found, link in ((early, True), (rounded, False), (lost, False)):
        said = next_steps(tables(found, whole=0.25))
        assert any("that the rods yield" in s for s in said) is link


def test_a_check_that_fails_before_a_damaged_building_is_named():
    rows = [("damaged building, 20 %", 2.0, "slv_height", 0.82), ("smdof.period_s", 1.25, "x", 1)]
    found = pd.DataFrame(rows, columns=["key", "factor", "check", "ratio"])
    said = damage(found, mechanisms(whole=0.25), 0.2)
    assert "period times 2 (20 % damping), at 82 % of the demand's" in said
    assert damage(found, mechanisms(whole=0.15), 0.2) == ""  # it fails as stated
    assert damage(found.assign(ratio=1.1), mechanisms(whole=0.25), 0.2) == ""


def test_below_seven_stations_no_share_and_no_interval():
    """One, two and six stations: counts in words; seven: a share with its interval."""
    for stations in (1, 2, 6):
        said = suite(dynamic(stations))
        assert "%" not in said
        assert "no interval" in said
        assert f"1 of {stations} (the first at 0.15 g)" in said
    assert "30 % with W2 (10 to 60 %)" in suite(dynamic(7))
    never = dynamic(7).assign(probability=1e-4, probability_low=0.0, probability_high=2e-3)
    assert "a probability of under 1 % with W2; in" in suite(never)
    assert "over 99 % with W2; in" in suite(never.assign(probability_low=1.0, probability_high=1.0))


def test_why_there_is_no_rate_asks_for_what_is_missing_alone():
    """Stations of the model with most count: another may have lost some of its curves."""
    both = pd.concat([dynamic(3), dynamic(12)], ignore_index=True)
    config = {"assessment": {"hazard": []}, "risk": {"hazard": None}}
    assert no_rate(both, config).count("give motions") == 0
    assert "risk.hazard and give motions of 7" in no_rate(dynamic(6), config)
    stated = {"assessment": {"hazard": []}, "risk": {"hazard": "a.csv"}}
    assert no_rate(dynamic(6), stated) == "No rate: give motions of 7 stations or more."


def test_what_is_recommended_hangs_on_what_fails():
    weak = next_steps(tables(verdicts(True), whole=0.15, corner=0.3))
    assert weak[0].startswith(f"Tie or hold the façade against: the {WHOLE} (0.15 g).")
    names = {
        "bent": "vertical bending from 0.00 to 3.50 m, open at 2.00 m",
        "corner": "the left corner above 0.00 m",
    }
    for part, name in names.items():  # feet at 0
        said = next_steps(tables(verdicts(True), whole=0.3, **{part: 0.25}))
        assert f"{name}, was not shaken: it is judged by the kinematic checks alone" in said[-1]
    second = CHECKS.assign(ratio=0.62)
    worse = second.assign(ratio=0.15)
    found = [second.assign(check="en_sd_height"), worse.assign(check="parts_height"), CHECKS]
    (said,) = next_steps(tables(verdicts(True), checks=pd.concat(found), whole=0.25))
    assert "do not pass: EN 1998-3 at 62 % of the demand's PGA." in said  # forces decide nothing
    lost = next_steps(tables(verdicts(True, False), whole=0.25))
    assert "The kinematic check passes and the dynamic one does not (W2)" in lost[0]
    unsure = next_steps(tables(verdicts(True, agree=0.9), whole=0.25))
    assert "hangs on single histories" in " ".join(unsure)
    (sound,) = next_steps(tables(verdicts(True), whole=0.25))
    assert "nothing else is asked for" in sound


def test_the_verdict_says_what_moves_and_when_it_rests_on_motions_that_do_not_fit():
    bent = "vertical bending from 0.00 to 3.50 m, open at 2.00 m"
    found = verdicts(True).assign(part="whole", mean_d_m=0.05)
    said = headline(tables(found, whole=0.25), ABOUT, (-0.05, 0.2, True))
    assert f"the weakest of 1 mechanisms, the {WHOLE}, holds" in said[1]
    assert f"the top of the {WHOLE} moves 50 mm in the mean of 11 histories" in said[2]
    assert "bounds" not in said[2]
    assert "draws" not in said[2]
    unsure = found.assign(agree=0.8, slv=False)
    said = headline(tables(unsure, SHAKEN.assign(**BENT), whole=0.25), ABOUT, (-0.1, 1.0, False))
    assert f"the joint of {bent}, moves 50 mm" in said[2]
    assert "; 80 % of draws of single histories say the same." in said[2]
    assert said[2].endswith("does not fit the demand within the code's bounds.")
    said = headline(tables(pd.DataFrame(), whole=0.25), ABOUT)
    assert "the façade passes by hand: life safety" in said[0]


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (0.0035, "0.0035"),
        (8.8e-5, "8.8·10⁻⁵"),
        (3e-4, "3.0·10⁻⁴"),
        (1.2e-11, "1.2·10⁻¹¹"),
        (0, "0"),
    ],
)
def test_small_rates_are_said_in_powers_of_ten(value, words):
    assert SAY.number(value, "power") == words


def test_page_1_names_the_wall_and_what_was_not_shaken_with_the_reason():
    low = {"part": "low", "foot_m": 5.7, "at_foot": "tie", "why_not": "stocky", "pga_fails_g": 0.5}
    bent = {"part": "bent", **BENT, "why_not": "far", "pga_fails_g": 0.9}
    corner = {"part": "corner", **CORNER, "foot_m": 5.0, "why_not": "corner", "pga_fails_g": 0.31}
    left = pd.DataFrame([{**NOWHERE, "shaken": 0, **one} for one in (corner, low, bent)])
    given = tables(verdicts(True), pd.concat([SHAKEN, left], ignore_index=True), whole=0.25)
    said = headline(given, ABOUT)
    assert said[0].endswith("The wall that is shaken is an elastic wall in 4 slices.")
    block = headline(
        given, {**ABOUT, "wall": named(SimpleNamespace(**{**vars(FACADE), "courses": 0}))}
    )[0]
    assert block.endswith("is one rigid block on even springs of E/h.")
    assert said[2].endswith(
        "Not shaken, judged by hand alone: the left corner above 5.00 m (0.31 g), not over the "
        "whole width; the part above 5.70 m (0.5 g), lower than twice the thickness there, where a "
        "wall slides before it rocks; vertical bending from 0.00 to 3.50 m, open at 2.00 m (0.9 "
        "g), by hand far from the demand."
    )
    assert "of the 1 mechanism that was shaken is fulfilled" in said[2]


def test_a_brittle_link_is_told_by_both_numbers():
    early = mechanisms(whole=0.217).assign(links_left_out=1, pga_letter_g=0.0564)
    said = kinematic(early, 0.2336)
    assert f"the {WHOLE} 0.0564 g by the letter, 0.217 g without them" in said
    assert "C8.7.1.2.1.6" in said
    assert "give way early" not in kinematic(mechanisms(whole=0.217), 0.2336)


def test_the_capacity_has_a_ratio_and_a_return_period():
    stated = mechanisms(whole=0.1)
    assert capacity(stated, 0.2, ("at", 123.0)).endswith("a return period of 123 years.")
    assert "of less than 30 years." in capacity(stated, 0.2, ("below", 30.0))
    assert "ζE = 0.50" in capacity(stated, 0.2, None)


def test_the_rate_rests_on_the_model_that_governs_or_else_on_the_last():
    assert relied_on(["W2m", "W1", "W2"]) == "W2m"
    assert relied_on(["W1", "W2", "W1"]) == "W2"
    assert relied_on([]) is None
