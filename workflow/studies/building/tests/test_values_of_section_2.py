"""The study's values of its section 2, in docs/study.yaml and in the code: one and the same."""

from pathlib import Path

import yaml
from studies.building.case import PAPER_PERIODS_S
from studies.building.comparison import PAPER_WME

DATA = yaml.safe_load((Path(__file__).parents[4] / "docs" / "study.yaml").read_text("utf-8"))


def test_errors_and_periods_are_those_of_the_page():
    for (quantity, record), values in PAPER_WME.items():
        assert list(values) == DATA["table_2"][quantity][record]
    for (model, direction), period in PAPER_PERIODS_S.items():
        assert period == DATA["periods_s"][model][direction]
