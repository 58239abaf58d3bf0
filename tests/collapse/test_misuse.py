"""The public functions given what they cannot take: one line, before anything runs."""

import math
import re

import numpy as np
import pytest
from rocking import Case, Motion, Variant, collapse_curve, estimate, history
from rocking.collapse.curve import WHERE
from rocking.collapse.scan import scan_settings

PULSE = np.sin(0.05 * np.arange(800)) * np.hanning(800)


@pytest.fixture(scope="module")
def case():
    return Case.configured("W1")


@pytest.fixture(scope="module")
def motion():
    return Motion.sampled(PULSE, 0.01, "g", name="pulse")


def refused(function, words):
    with pytest.raises((ValueError, TypeError), match=re.escape(words)) as caught:
        function()
    assert "\n" not in str(caught.value)


def test_every_setting_of_a_search_has_the_limits_of_the_configuration(case, motion):
    """Whatever a scan is told is a key of the configuration, and refused as there."""
    known = scan_settings(case.sections)
    assert known.keys() <= WHERE.keys()
    for key in ("level_ratio", "max_pga_g", "realisations", "amplitude_spread", "safe_share"):
        for value in (0, -1, math.nan, "0.02", None, [0.1], 1e9):
            refused(
                lambda k=key, v=value: collapse_curve(case, motion, settings={k: v}), f"['{key}']"
            )
    refused(lambda: collapse_curve(case, motion, settings={"power": 2}), "from 0 to 0.9999")
    refused(lambda: collapse_curve(case, motion, settings={"realisations": 2.5}), "a whole number")
    for fraction in (0, 7, "x", math.nan):
        refused(lambda f=fraction: collapse_curve(case, motion, fraction=f), "fraction = ")
    for level in (0.0, -0.1, math.nan, 1e30, "0.1", None):
        how = {"search": "list", "settings": {"pga_g": [level]}}
        refused(lambda h=how: collapse_curve(case, motion, **h), "settings['pga_g'] = ")
        refused(lambda g=level: history(case, motion, "pos", g), "pga_g = ")


def test_what_is_no_case_no_key_and_no_change_is_named(case):
    refused(lambda: Case(None), "Case of NoneType: expected Case.configured")
    refused(lambda: Case.read(None), "expected a case file")
    refused(lambda: Case.configured(["W1"]), "expected one of free, W1")
    refused(
        lambda: Case.configured("W1", {"facade": {"height_m": 6}, "facade.height_m": 7}),
        "facade.height_m: given twice",
    )
    for key in (None, 3, "", "facade.", "facade.tall_m"):
        refused(lambda k=key: case.varied({k: 1}), "the case has no such key")
    refused(lambda: Variant("x", changes=None), "changes = None: expected a mapping")
    refused(lambda: Variant("x", factors=[2.0]), "factors = [2.0]: expected a mapping")
    for factor in ("2", None, np.array([1.0, 2.0])):
        thick = Variant("x", factors={"facade.thickness_m": factor})
        refused(lambda v=thick: case.varied(v), "facade.thickness_m: factor")
    for value in (-1, math.nan, "x", None):
        refused(lambda v=value: case.varied({"beta_s": v}), "beta_s = ")
    for height in (None, "3", math.nan, -1):
        refused(lambda z=height: case.part(z), "part.foot_m = ")
    with pytest.raises(KeyError, match="the case has no 'damp'; it has facade"):
        case["damp"]


def test_what_is_no_motion_is_named(motion, tmp_path):
    refused(lambda: Motion.named(None), "name = None: expected text")
    refused(lambda: Motion.named("RRS228", table=3), "table = 3: expected text")
    path = tmp_path / "mine.txt"
    path.write_text("\n".join(map(str, PULSE)))
    refused(lambda: Motion.read(path, dt_s="0.01", units="g"), "dt_s = '0.01': expected a number")
    refused(lambda: Motion.read(path, dt_s=0.01, units=3), "units = 3: expected text")
    refused(lambda: Motion.sampled(1j * PULSE, 0.01, "g"), "complex numbers are no acceleration")
    for wrong in (PULSE > 0, [str(value) for value in PULSE], np.array(PULSE, dtype="S")):
        refused(lambda w=wrong: Motion.sampled(w, 0.01, "g"), "are no acceleration or step")
    for step in ("0.01", True):
        refused(lambda s=step: Motion.sampled(PULSE, s, "g"), "are no acceleration or step")
    refused(lambda: Motion.sampled(PULSE, 0.01, "g", name=None), "name = None: expected text")
    hidden = np.ma.masked_greater(PULSE, 0.5)
    refused(lambda: Motion.sampled(hidden, 0.01, "g"), "not all samples are finite")
    refused(lambda: motion.varied(None), "NoneType given: expected a Variant")
    refused(lambda: motion.varied({"vertical": 1.0}), "dict given: expected a Variant")
    for change, words in (
        ({"first": "1ST280"}, "first = '1ST280': expected keywords of Motion.named"),
        ({"first_pga_g": -0.1}, "first_pga_g = -0.1: expected a number ≥ 0"),
        ({"pause_s": "long"}, "pause_s = 'long': expected a number ≥ 0"),
        ({"vertical": "yes"}, "vertical = 'yes': expected a number"),
        ({"second": 1}, "unknown change of the motion 'second'"),
    ):
        refused(lambda c=change: motion.varied(Variant("x", motion=c)), words)


def test_what_is_no_intensity_and_no_hazard_is_named(case, motion):
    found = estimate(Case.configured("W1", {"facade.base": "column"}))
    assert found.probability([0.0, found.median]) == pytest.approx([0.0, 0.5])
    for value in (-1, [0.1, math.nan], None):
        refused(lambda v=value: found.probability(v), "expected numbers ≥ 0")
    curve = collapse_curve(case, motion, search="list", settings={"pga_g": [0.05]})
    for slope in (0, -3, math.nan, "x", None):
        refused(lambda k=slope: curve.summary(slope=k), "slope = ")
