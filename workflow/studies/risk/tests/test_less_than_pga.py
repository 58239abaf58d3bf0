"""The share of resamples in which a measure scatters less than PGA."""

import numpy as np
import pandas as pd
import pytest
from rocking.collapse.probability import KEY
from studies.risk import fragility_tables
from studies.shared.fragility import Bootstrap, Fragility

SETTINGS = {"measures": ["a", "pga_g"], "confidence": 0.9, "min_stations": 12}


@pytest.mark.parametrize("stations", [20, 3])
def test_it_is_counted_draw_by_draw_and_left_open_from_few_stations(monkeypatch, stations):
    """PGA scatters by 0.3 in every draw, the measure by less in three of eight."""
    scatter = {"pga_g": np.full(8, 0.3), "a": np.array([0.2, 0.25, 0.29, *[0.31] * 4, 0.3])}

    def fit_table(part, settings):
        own = scatter[part["im"].iloc[0]]
        return Fragility(0.4, 0.3), Bootstrap(np.full(8, 0.4), own, stations)

    monkeypatch.setattr(fragility_tables.fragility, "fit_table", fit_table)
    row = {**dict.fromkeys(KEY, "x"), "record": "A", "station": "S", "model": "W1"}
    row |= {"low": 0.2, "high": 0.5, "weight": 1.0}
    rows = [
        {**row, "im": name, "reading": reading}
        for name in scatter
        for reading in (fragility_tables.SHARE, fragility_tables.FIRST)
    ]
    _, efficiency, _ = fragility_tables.fits(pd.DataFrame(rows), SETTINGS)
    less = {one["im"]: one["less_than_pga"] for one in efficiency}
    assert np.isnan(less["pga_g"])
    if stations < 7:
        assert np.isnan(less["a"])
    else:
        assert less["a"] == 3 / 8
