"""What an assumption is worth: ratios, losses, and variants that change what they say."""

import numpy as np
import pandas as pd
import pytest
from rocking import Case
from yade_process import resolved

from studies.assumptions import study as assumptions
from yade_scripts.model.models import build_scene
from yade_scripts.model.scene import to_json

STAGE = {"period_s": 0.22, "complete_period_s": 0.25, "mass_kg": 66e3}


def capacity(**pga_g):
    """One curve a model; every measure at the given amplitude, a band of ± 1 % about it."""
    factors = {"pga_collapse_g": 0.99, "pga_p10_g": 0.99, "pga_p90_g": 1.01, "pga_all_g": 1.01}
    rows = [
        {"model": name, "record": "A", "direction": "pos", "pga_median_g": g, "pga_equivalent_g": g}
        | {key: g * factor for key, factor in factors.items()}
        for name, g in pga_g.items()
    ]
    return pd.DataFrame(rows)


def test_the_driven_loss_is_that_of_motion_and_assumption():
    """W1 0.4, W2 0.14, W2m 0.2 g: 65 % driven, of which 50 by motion and 15 by the assumption."""
    found = (
        assumptions.losses(capacity(W1=0.4, W2=0.14, W2m=0.2)).set_index("measure").loc["median"]
    )
    assert found["loss_one_way"] == pytest.approx(0.65)
    assert found["loss_two_way"] == pytest.approx(0.5)
    assert found["assumption"] == pytest.approx(0.15)
    assert assumptions.losses(capacity(W1=0.4, W2=0.14)).empty


def test_a_substitute_that_stands_more_is_unsafe():
    """Outside the reference's own scatter; inside it neither is stronger."""
    table = assumptions.compared(capacity(W2m=0.2, W2=0.14, W1=0.4, W2cm=0.201), "W2m")
    side = dict(zip(table["model"], table["side"], strict=True))
    assert side == {"W2m": "", "W2": "safe", "W1": "unsafe", "W2cm": "even"}
    assert table["ratio_median"].tolist() == pytest.approx([1.0, 0.7, 2.0, 1.005])
    blank = assumptions.compared(capacity(W2=0.14), "W2m")
    assert blank["ratio_median"].isna().all()
    assert blank["side"].tolist() == [""]


def test_a_curve_of_probabilities_alone():
    """Crossings by straight lines; lowest amplitude at which any fell, first at which all did."""
    table = pd.DataFrame({"pga_g": [0.4, 0.1, 0.3, 0.2], "probability": [1.0, 0.0, 0.8, 0.2]})
    found = assumptions.from_probabilities(
        table.assign(realisations=5, realisations_yade=np.nan, probability_yade=np.nan)
    )
    assert found["pga_collapse_g"] == 0.2
    assert found["pga_p10_g"] == pytest.approx(0.15)
    assert found["pga_median_g"] == pytest.approx(0.25)
    assert found["pga_p90_g"] == pytest.approx(0.35)
    assert found["pga_all_g"] == 0.4
    ends = np.array([0.1, 0.02**0.5, 0.06**0.5, 0.12**0.5])  # each share up to the next middle
    rate = np.array([0.0, 0.2, 0.8, 1.0]) @ (ends**-2 - np.append(ends[1:] ** -2, 0.0))
    assert found["pga_equivalent_g"] == pytest.approx(rate**-0.5)
    assert found["runs"] == 20
    # stands to 0.1 g, then 0.09 + 0.05 + 0.01 g in the three steps
    assert found["pga_mean_g"] == pytest.approx(0.25)
    assert np.isnan(assumptions.mean_intensity([0.1, 0.2], [0.0, 0.5]))


@pytest.mark.parametrize("model", ["W2", "W3"])
def test_every_variant_changes_the_scene_or_its_motion(model):
    """Names are unique and no key is misspelt: each variant is another scene, chain or record."""
    case = Case({**resolved(), "model": model, "beta_s": 0.00276})
    base = to_json(build_scene(case.sections))
    every = assumptions.variants(case, STAGE, surrogate={})
    known = {v.name: v for v in every}
    assert len(known) == len(every) == len(assumptions.variants(case, STAGE)) + 1
    for name, variant in known.items():
        new = case.varied(variant).sections
        other = [new["smdof"] != case["smdof"], new["damping"] != case["damping"], variant.motion]
        assert to_json(build_scene(new)) != base or any(other), name
    two_way = case.varied(known["return walls feel the façade, building's mass"])
    assert two_way.model == f"{model}m"
    assert two_way["return_wall"]["building_mass_kg"] == STAGE["mass_kg"]


def test_the_strength_of_the_building_is_an_assumption_beside_the_configured_one():
    """An elastic case is compared with V/W 0.10 to 0.30, one of 0.20 with the elastic one too."""
    levels = {}
    for ratio in (None, 0.20):
        own = resolved(smdof={"base_shear_ratio": ratio})
        case = Case({**own, "model": "W2", "beta_s": 0.00276})
        found = [v for v in assumptions.variants(case, STAGE) if "strength" in v.name]
        levels[ratio] = [v.about["level"] for v in found]
        for variant in found:
            varied = case.varied(variant)["smdof"]["base_shear_ratio"]
            assert varied == assumptions.STRENGTHS[variant.about["level"]]
    assert levels == {
        None: ["V/W 0.10", "V/W 0.20", "V/W 0.30"],
        0.20: ["V/W 0.10", "V/W 0.30", "elastic"],
    }


def test_a_building_has_the_façade_s_mass_over_the_ratio():
    """m = ρ h b w of the façade, over the ratio; a driven one has the façade's own."""
    case = Case.configured("W2")
    settings = {"periods_s": [0.2], "damping_ratios": [], "mass_ratios": [0.1, 0.5]}
    size = [case["facade"][key] for key in ("height_m", "thickness_m", "width_m", "density_kg_m3")]
    masses = [
        one.changes["return_wall.building_mass_kg"] for one in assumptions.buildings(case, settings)
    ]
    np.testing.assert_allclose(masses, np.prod(size) / np.array([1.0, 0.1, 0.5]), rtol=1e-12)


def test_every_pair_of_couplings_stands_once_and_then_each_over_the_reference():
    """W1 has no walls that move, and so no counterpart."""
    pga_g = {"W1": 0.4, "W2": 0.2, "W2m": 0.3, "other": 0.1}
    rows = [
        {"model": m, "record": "R", "direction": "pos", "pga_median_g": v} for m, v in pga_g.items()
    ]
    table = pd.DataFrame(rows).assign(pga_p10_g=0.2, pga_p90_g=0.2)
    for reference, expected in (
        ("W2m", [("W2", "W2m"), ("W1", "W2m"), ("other", "W2m")]),
        ("W1", [("W2", "W2m"), ("W2", "W1"), ("W2m", "W1"), ("other", "W1")]),
    ):
        found = assumptions.pairs(table, reference)
        assert list(zip(found["model"], found["reference"], strict=True)) == expected
        ratio = [pga_g[one] / pga_g[two] for one, two in expected]
        np.testing.assert_allclose(found["ratio_median"], ratio)


def test_a_scan_counts_as_planar_and_yades_own_runs_as_yades():
    pga_g = np.linspace(0.1, 0.4, 31)
    runs = pd.DataFrame({"pga_g": pga_g, "collapsed": (pga_g > 0.25).astype(int), "d_over_b": 0.5})
    runs["status"] = np.where(runs["collapsed"], "overturned", "ok")
    for planar in (True, False):
        found = assumptions.measured(runs, 0.01, planar)
        assert found["runs_planar"] == (31 if planar else 0)
        assert found["pga_collapse_g"] == pytest.approx(0.26)
        assert found["pga_mean_g"] == pytest.approx(0.255)  # stands up to the middle of the step


def test_a_loss_counts_what_stands_above_a_first_range():
    """W2 falls from 0.14 to 0.16 g and from 0.2 g on: half collapse is 0.14 g, not its rate's."""
    pga_g = np.geomspace(0.1, 0.5, 400)
    shares = {
        "W1": pga_g >= 0.4,
        "W2": ((pga_g >= 0.14) & (pga_g < 0.16)) | (pga_g >= 0.2),
        "W2m": pga_g >= 0.2,
    }
    rows = []
    for name, fell in shares.items():
        runs = pd.DataFrame({"pga_g": pga_g, "collapsed": fell.astype(int), "d_over_b": 0.5})
        runs["status"] = np.where(fell, "overturned", "ok")
        found = assumptions.measured(runs, 0.01, True)
        rows.append({"model": name, "record": "A", "direction": "pos"} | found)
    found = assumptions.losses(pd.DataFrame(rows)).set_index("measure")
    by_hand = (0.14**-2 - 0.16**-2 + 0.2**-2) ** -0.5
    assert found.loc["equivalent", "pga_w2_g"] == pytest.approx(by_hand, rel=5e-3)
    assert found.loc["equivalent", "loss_two_way"] == pytest.approx(0.5, abs=5e-3)
    assert found.loc["median", "loss_one_way"] == pytest.approx(0.65, abs=5e-3)
    steeper = assumptions.measured(runs, 0.01, True, slope=3.0)
    assert steeper["pga_equivalent_g"] == pytest.approx(0.2, rel=5e-3)  # a threshold, for any slope
