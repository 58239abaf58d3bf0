"""Which check governs: ground or floor, which mechanism, which confidence factor."""

import numpy as np
import pytest
from rocking.records import Record
from studies.assess.checks import LEAST_KNOWN
from studies.assess.code_checks import CHECKS, code_checks, failing_pga, governing, least
from studies.assess.code_spectrum import CodeDemand
from studies.assess.family import Family
from study_cases import study_settings

CONFIG = study_settings(
    {
        "facade": {"height_m": 6.0, "thickness_m": 0.5, "width_m": 5.0, "gable_height_m": 2.0},
        "smdof": {"n_dof": 3, "period_s": 0.8},
    }
)
DEMAND = CodeDemand(0.2, 2.5, 0.3, "B")


def family():
    return Family(CONFIG)


def stated(**own):
    """The configuration with other values of section assessment."""
    return {**CONFIG, "assessment": {**CONFIG["assessment"], **own}}


def test_the_less_of_ground_and_floor_governs():
    """Before a soft building the floor asks for more than the ground; both stand in the table."""
    found = code_checks(family().part(0.0, "whole"), CONFIG, DEMAND)
    ground, floor = found["slv_ground"].failing_pga_g, found["slv_height"].failing_pga_g
    assert floor < 0.95 * ground
    assert least(found) == floor
    assert least({"slv_ground": found["slv_ground"]}) == ground


def test_mechanisms_come_the_weakest_first_and_off_the_ground_none_is_checked_on_it():
    ranked = governing(family().all(), CONFIG, DEMAND)
    pga_g = [row[0] for row in ranked]
    assert pga_g == sorted(pga_g)
    for one, found in ((one, found) for _, one, found in ranked):
        assert one.on_ground == ("slv_ground" in found)


def test_confidence_is_level_one_unless_the_hinge_crushes():
    whole, known = family().part(0.0, "whole"), {"confidence_factor": 1.0}
    without = code_checks(whole, stated(**known), DEMAND)
    crushing = code_checks(whole, stated(**known, hinge_inset_m=1e-9), DEMAND)
    ratio = crushing["linear_ground"].capacity / without["linear_ground"].capacity
    assert ratio == pytest.approx(LEAST_KNOWN)


def test_every_check_of_one_record_stands_beside_the_others():
    """Who applies both takes the less of ground and floor; FC 1.35 allows no more than FC 1."""
    rng = np.random.default_rng(2)
    values = np.cumsum(rng.standard_normal(1500)) * 0.05
    record = Record("r", values - values.mean(), 0.01, source="file")
    whole = family().part(0.0, "whole")
    found = failing_pga(whole, CONFIG, record)
    assert set(found) == set(CHECKS)
    assert found["slv_both"] == min(found["slv_ground"], found["slv_height"])
    assert found["slv_both_fc"] <= found["slv_both"]
