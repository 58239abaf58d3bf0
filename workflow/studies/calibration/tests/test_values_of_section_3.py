"""The study's values of its section 3, in docs/study.yaml and in the code: one and the same."""

from pathlib import Path

import yaml
from studies.calibration import claims
from studies.shared.restitution import TARGETS

DATA = yaml.safe_load((Path(__file__).parents[4] / "docs" / "study.yaml").read_text("utf-8"))


def test_restitution_and_damping_are_those_of_the_page():
    assert [list(limits) for limits in TARGETS] == DATA["restitution_ranges"]
    beta = DATA["beta_s"]
    assert {k: beta[k] for k in claims.EQ5_PRINTED} == claims.EQ5_PRINTED
    assert beta["Shawa by trial"] == claims.SHAWA_TRIAL_S
    assert beta["test"] == claims.TEST_BETA_S
