"""Tables beside the codes' checks by hand: suites at a PGA, parts beside the whole."""

import numpy as np
import pandas as pd
import pytest
from rocking.records import Record
from rocking.records.floors import chain_motions
from studies.assess import code_tables
from studies.assess.code_spectrum import CodeDemand
from studies.assess.comparison import parts_against_whole, share_interval
from studies.assess.family import Family
from study_cases import study_settings

from smdof.spectra import response_spectrum

T = 0.01 * np.arange(400)
BURST = np.sin(9.0 * T) * np.exp(-((T - 1.5) ** 2))
SETTINGS = study_settings({"smdof": {"n_dof": 2, "tail_s": 1.0}})


def test_a_suite_stands_at_the_pga_of_the_demand_whatever_its_own():
    """Motions that differ by a factor alone: all percentiles are one, at the demand's PGA."""
    demand = CodeDemand(0.2, 2.4, 0.32, "B")
    records = [Record(name, k * BURST, 0.01, "file") for name, k in (("A", 1.0), ("B", -2.5))]
    table = code_tables.spectra(records, SETTINGS, demand, 0.0)
    for name in ("ground_suite", "floor_chain"):
        assert table[f"{name}_p16_g"].to_numpy() == pytest.approx(table[f"{name}_p84_g"].to_numpy())
    scale = demand.pga_g / (np.abs(BURST).max() / 9.80665)
    periods = table["period_s"].to_numpy()
    own = response_spectrum(BURST, 0.01, periods, 0.05).psa_m_s2 / 9.80665 * scale
    assert table["ground_suite_p50_g"].to_numpy() == pytest.approx(own, rel=1e-3)
    assert table["ground_g"].tolist() == [demand.acceleration(t) for t in periods]


@pytest.mark.parametrize(
    ("share", "weights"),
    [(0.0, (1, 0, 0)), (0.25, (0.5, 0.5, 0)), (0.75, (0, 0.5, 0.5)), (1.0, (0, 0, 1))],
)
def test_between_two_floors_the_chain_moves_as_the_line_between_them(share, weights):
    demand, record = CodeDemand(0.2, 2.4, 0.32, "B"), Record("A", BURST, 0.01, "file")
    table = code_tables.spectra([record], SETTINGS, demand, share)
    motion = chain_motions(record, SETTINGS["smdof"])
    levels = np.vstack([motion.ground_m_s2, motion.floors_m_s2])
    scale = demand.pga_g / np.abs(motion.ground_m_s2).max()
    periods = table["period_s"].to_numpy()
    moved = np.asarray(weights, float) @ levels
    expected = response_spectrum(moved, 0.01 / motion.refine, periods, 0.05).psa_m_s2 * scale
    assert table["floor_chain_p50_g"].to_numpy() == pytest.approx(expected, rel=1e-6)


def levels_of(rows):
    names = ["run", "model", "part", "ag_g", "kinematic_fc", "dynamic"]
    return pd.DataFrame(rows, columns=names)


def test_what_the_whole_facade_alone_would_have_passed_is_counted():
    """At 0.1 g all pass; at 0.2 g the whole by hand and shaken; at 0.3 g the part shaken alone."""
    levels = levels_of(
        [
            *(("a", "W1", "whole", g, hand, shaken) for g, hand, shaken in WHOLE),
            *(("a", "W1", "gable", g, hand, shaken) for g, hand, shaken in PART),
        ]
    )
    names = ["run", "part", "model", "record", "direction", "pga_median_g"]
    curves = [
        *(("a", None, "W1", "R", way, g) for way, g in (("pos", 0.4), ("neg", 0.5))),
        *(("a", "gable", "W1", "R", way, g) for way, g in (("pos", 0.2), ("neg", 0.6))),
        ("a", None, "W1", "S", "pos", np.nan),
        ("a", "gable", "W1", "S", "pos", 0.3),
    ]
    table = parts_against_whole(levels, pd.DataFrame(curves, columns=names))
    assert table["run"].tolist() == ["a", "all"]
    for row in table.to_dict("records"):
        assert row["levels"] == 3
        assert row["whole_alone_passes_by_hand"] == 1
        assert row["whole_alone_passes_dynamic"] == 1
        assert row["kinematic_alone_passes"] == 0
        assert row["dynamic_alone_passes"] == 1
        assert row["curves"] == 3
        assert row["ratio_median"] == pytest.approx((0.2 / 0.4 + 0.6 / 0.5) / 2.0)
        assert row["ratio_p10"] == pytest.approx(0.5 + 0.1 * 0.7)
        assert row["part_first"] == pytest.approx(2 / 3)  # where the whole never fell too
    assert table["part"].tolist() == ["gable", ""]


WHOLE = ((0.1, 1, 1), (0.2, 1, 1), (0.3, 0, 0))
PART = ((0.1, 1, 1), (0.2, 0, 0), (0.3, 0, 1))


@pytest.mark.parametrize(("flag", "end"), [(0.0, 2), (1.0, 1)])
def test_a_share_of_none_or_all_reaches_as_far_as_its_stations_leave_open(flag, end):
    """Of 10 stations (1 − 0.05^(1/10)); two rows of each tell no more."""
    stations = np.repeat(np.arange(10), 2)
    found = share_interval(np.full(20, flag), stations, 50, 1, confidence=0.9)
    reach = 1.0 - 0.05**0.1
    assert found[0] == flag
    assert found[end] == pytest.approx(reach if flag == 0.0 else 1.0 - reach)
    assert np.isnan(share_interval(np.full(20, flag), stations % 3, 50, 1)[1:]).all()


@pytest.mark.parametrize(("arm_m", "place_m"), [(None, 0.3), (0.1, 0.1)])
def test_a_stated_roof_bears_on_its_arm_from_the_back_or_on_the_middle(arm_m, place_m):
    """α0 = [W b/2 + N (b − s)]/(W h/2 + N h)."""
    facade = {"height_m": 6.0, "thickness_m": 0.6, "width_m": 4.0, "density_kg_m3": 1800.0}
    own = {"roof_load_kn": 30.0, "roof_arm_m": arm_m}
    family = Family(study_settings({"facade": facade, "assessment": own}))
    found = family.part(0.0, "whole").mechanism.multiplier()
    weight = family.masonry.weight_n
    expected = weight * 0.3 + 30e3 * (0.6 - place_m)
    assert found == pytest.approx(expected / (weight * 3.0 + 30e3 * 6.0), rel=1e-9)
