"""The script of fragility, run alone on small made-up results; measures that may be asked for."""

import numpy as np
import pandas as pd
import pytest
from made_curves import collapse_tables, curve, record
from rocking.configuration import schema
from rocking.records.intensity_measures import MEASURES
from run_script import script

pytestmark = pytest.mark.slow

OUTPUTS = ("fragility", "measures", "sufficiency", "brackets", "curves", "factors")
PERIODS = [0.5, 0.63, 0.8, 1.0, 1.25, 1.6, 2.0]
STATIONS = {f"R{i}": f"S{i}" for i in range(len(PERIODS))}


@pytest.fixture(scope="module")
def fragility(tmp_path_factory):
    """Façade that falls at a PGV of 40 cm/s exactly, whatever the record; one curve never does."""
    folder = tmp_path_factory.mktemp("fragility")
    periods = PERIODS
    records = [record(folder, f"R{i}", 1 + i, period) for i, period in enumerate(periods)]
    curves = []
    for i, period in enumerate(periods):
        pga = 0.40 / (period / np.pi) / 9.80665  # PGV = aT/π from rest
        curves.append(curve(folder / f"W1_{i}.csv", "W1", f"R{i}", "pos", pga * 0.97, pga * 1.03))
    curves.append(curve(folder / "W1_never.csv", "W1", "R2", "neg", 3.0, None))
    names = {k: str(folder / f"{k}.csv") for k in OUTPUTS}
    settings = {
        "measures": ["pgv_cm_s", "pga_g", "p_pgv_over_g"],
        "confidence": 0.9,
        "resamples": 200,
        "min_stations": 12,
        "seed": 1,
    }
    with_never = {k: v.replace(".csv", "_all.csv") for k, v in names.items()}
    for taken, ending, output in ((curves[:-1], "", names), (curves, "_all", with_never)):
        script(
            "fragility_table",
            folder,
            input={**collapse_tables(folder, taken, ending), "records": records},
            output=output,
            params={
                "stations": STATIONS,
                "fragility": settings,
                "hazard_slope": 2.0,
                "facade": {"height_m": 6.48, "thickness_m": 0.375},
                "smdof": {"period_s": 0.27, "damping_ratio": 0.05},
            },
        )
    return {k: pd.read_csv(v) for k, v in names.items()}, pd.read_csv(with_never["fragility"])


@pytest.mark.xdist_group("fragility")
def test_the_measure_that_governs_has_no_dispersion_and_its_median_is_the_capacity(fragility):
    tables, _ = fragility
    fits = tables["fragility"].set_index("im")
    assert fits.loc["pgv_cm_s", "median"] == pytest.approx(40.0, rel=0.01)
    assert fits.loc["pgv_cm_s", "dispersion"] <= 0.02
    logs = -np.log(PERIODS)  # collapse PGA is inverse to the period
    assert fits.loc["pga_g", "dispersion"] == pytest.approx(np.std(logs), rel=0.01)
    p = np.sqrt(0.75 * 9.81 / (0.5 * np.hypot(6.48, 0.375)))
    assert fits.loc["p_pgv_over_g", "median"] == pytest.approx(p * 0.40 / 9.80665, rel=0.01)
    assert set(fits["remark"]) == {"indicative: 7 records of 7 stations"}
    share = tables["measures"].set_index("im")["less_than_pga"]
    assert share["pgv_cm_s"] > 0.95


@pytest.mark.xdist_group("fragility")
def test_a_curve_without_collapse_counts(fragility):
    tables, with_never = fragility
    row = with_never[with_never["im"] == "pga_g"].iloc[0]
    before = tables["fragility"].set_index("im").loc["pga_g"]
    assert (row["n"], row["n_censored"], row["n_records"], row["n_stations"]) == (8, 1, 7, 7)
    assert row["median"] > before["median"]
    assert row["dispersion"] > before["dispersion"]


def test_measures_are_those_of_their_registry():
    measures = schema.sections()["fragility"]["properties"]["measures"]
    assert measures["items"]["enum"] == measures["default"] == list(MEASURES)
