"""A stronger façade has no larger rate of collapse, whatever mechanisms it brings along."""

import numpy as np
import pandas as pd
import pytest
from drawn_facades import several
from rocking import Motion
from studies.assess.anchors import completed_settings
from studies.assess.code_checks import family_of, governing
from studies.assess.code_spectrum import CodeDemand
from studies.assess.collapses import by_part
from studies.assess.dynamic_answer import answer, weakest
from studies.assess.shaken import cases, chosen, settled
from studies.shared.hazard import Hazard
from study_cases import study_case, study_settings

TABLE = "config/suites/recorded_suite.tsv"
STATIONS = ("GMN_NS", "IS101_Lo", "IS113_Lo", "LPCC_H1", "BGI_NS", "IS106_Lo", "IS108_Lo")
PGA_G = np.array([0.03, 0.1, 0.3, 1.0])
HAZARD = {"site": Hazard("pga_g", PGA_G, 2e-3 * (0.1 / PGA_G) ** 2.5)}
DAMPING = {"law": "value", "beta_s": 0.002}


@pytest.fixture(scope="module")
def turns():
    return [(Motion.named(name, TABLE), "neg") for name in STATIONS]


def rate(given, turns):
    """Annual rate of collapse of all mechanisms that are shaken, and its interval."""
    resolved = completed_settings(study_settings({**given, "damping": DAMPING}))
    own = resolved["assessment"]
    demand = CodeDemand(own["ag_g"], own["f0"], own["tc_star_s"], own["soil"])
    of_case = {key: given[key] for key in ("facade", "return_wall", "smdof")}
    case = settled(study_case("W1", {**of_case, "damping": DAMPING}), own)
    ranked = governing(family_of(resolved, demand).all(), resolved, demand)
    table = chosen(ranked, [case], demand.pga_g, 4.0)
    parts = {row.part: one for row, one in cases(case, table)}
    found = by_part(parts, turns, 3.0, [np.nan] * len(turns))
    rows = [
        {"part": part, "model": "W1", "record": motion.name, "direction": way, **of_part[k]}
        for part, of_part in found.items()
        for k, (motion, way) in enumerate(turns)
    ]
    stations = {name: name for name in STATIONS}
    frame = pd.DataFrame(rows).assign(record_pga_g=1.0)
    return answer(weakest(frame), stations, demand.pga_g, HAZARD, 200, 1)[0]


def with_facade(given, **changes):
    return {**given, "facade": {**given["facade"], **changes}}


@pytest.mark.slow
@pytest.mark.parametrize("k", range(2))
def test_thicker_tied_or_better_anchored_is_no_worse(k, turns):
    """Of drawn façades of one storey; each change against the façade before it."""
    given = [one for one in several(30, 11) if one["facade"]["height_m"] < 5.0][k]
    top = given["facade"]["height_m"]
    bare = with_facade(given, ties=[], floors=[], thickness_steps=[])
    row = {"height_m": top, "length_m": 6.0, "diameter_mm": 18.0}
    chain = [
        with_facade(bare, thickness_m=0.85 * bare["facade"]["thickness_m"]),
        bare,
        with_facade(bare, ties=[{**row, "anchor_kn": 8.0}]),
        with_facade(bare, ties=[{**row, "anchor_kn": 90.0}]),
        with_facade(bare, ties=[{**row, "anchor_kn": 90.0, "height_m": z} for z in (top / 2, top)]),
    ]
    found = [rate(one, turns) for one in chain]
    for weak, strong in zip(found, found[1:], strict=False):
        if np.isfinite(strong["annual_rate"]):  # else none falls
            assert strong["annual_rate"] <= weak["rate_high"]
    last = found[-1]["annual_rate"]
    assert not last > found[0]["annual_rate"]


@pytest.mark.slow
@pytest.mark.parametrize("k", range(2))
def test_a_lighter_wall_on_the_same_tie_is_no_worse(k, turns):
    """The tie pulls with as much on less weight: α0 rises by F h/(W h/2) as W falls."""
    given = [one for one in several(30, 12) if one["facade"]["height_m"] < 5.0][k]
    row = {"height_m": given["facade"]["height_m"], "length_m": 6.0, "diameter_mm": 12.0}
    bare = with_facade(given, ties=[{**row, "anchor_kn": 10.0}], floors=[], thickness_steps=[])
    found = [rate(with_facade(bare, density_kg_m3=d), turns) for d in (2200.0, 1900.0, 1600.0)]
    assert np.isfinite(found[0]["annual_rate"])
    for heavy, light in zip(found, found[1:], strict=False):
        assert not light["annual_rate"] > heavy["rate_high"]
    assert not found[-1]["annual_rate"] > found[0]["annual_rate"]
