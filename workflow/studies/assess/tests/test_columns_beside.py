"""Columns of the assessment's tables beside the PGA: over the demand, the worst model."""

from types import SimpleNamespace

import pandas as pd
import pytest
from studies.assess import ties, ties_shaken, ties_tables
from studies.assess.code_spectrum import CodeDemand
from study_cases import study_settings

FACADE = {"height_m": 6.0, "thickness_m": 0.4, "width_m": 5.0, "density_kg_m3": 1800.0}


def test_what_a_mechanism_fails_at_over_the_demand_with_and_without_rows():
    demand = CodeDemand(0.26, 2.4, 0.32, "B")
    tied = ties.Tied(study_settings({"facade": FACADE}), demand)
    rows = [ties.TieRow(6.0, 20e3)]
    least_g = []
    for added in ([], rows):
        forces = [row.force_n for row in added]
        result = ties.Recommended(added, forces, [], [None] * len(added), added, True, {})
        table = pd.DataFrame(ties_tables.after(tied, result, None))
        fails_g = (demand.pga_g * table["ratio"]).to_numpy()
        assert fails_g == pytest.approx(table["pga_fails_g"].to_numpy())
        assert table["pga_fails_g"].is_monotonic_increasing
        found = dict(zip(table["part"], table["pga_fails_g"], strict=True))
        assert found == pytest.approx(tied.mechanisms(added)[1])
        assert not table["beyond"].any()
        least_g.append(table.loc[table["part"] == "whole", "pga_fails_g"].item())
    assert least_g[1] > 1.1 * least_g[0]


class Answers(ties_shaken.Shaken):
    """Stands in for the dynamic check: what it says of a part under every model."""

    def __init__(self, by_model):
        self.models, self.by_model = list(by_model), by_model

    def _parts(self, rows, model):
        own = self.by_model[model]
        return dict.fromkeys(own), [(SimpleNamespace(part=name), model) for name in own]

    def _ahead(self, parts):
        pass

    def _run(self, rows, part, label, one):
        return self.by_model[part][label]


def answer(holds, mean_d_m):
    return {"holds": holds, "mean_d_m": mean_d_m, "d_slv_m": 0.1}


def test_of_a_part_the_answer_of_every_model_stands():
    """Each by part and model, whichever model is asked first."""
    first = {"a": answer(True, 0.02), "b": answer(False, 0.03), "c": answer(True, 0.05)}
    second = {"a": answer(True, 0.04), "b": answer(True, 0.09), "c": answer(True, 0.01)}
    for models in ((first, second), (second, first)):
        found = Answers(dict(zip(("W1", "W2"), models, strict=True))).everything([])
        by_model = dict(zip(("W1", "W2"), models, strict=True))
        assert found == {part: {m: own[part] for m, own in by_model.items()} for part in "abc"}
