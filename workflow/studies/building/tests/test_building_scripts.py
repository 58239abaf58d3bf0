"""A user's own building through the scripts, one after the other: periods, chain, refusals."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import yaml
from rocking.records import Record, write_csv
from run_script import script
from study_cases import study_settings

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[4]
PLAN = ROOT / "config" / "buildings" / "example_three_storeys.yaml"


@pytest.fixture(scope="module")
def settings():
    section = study_settings({})["building"]
    return {**section, "coarsening": 6.0, "modes": 20, "fit_period_s": None}


@pytest.fixture(scope="module")
def folder(tmp_path_factory, settings):
    """Fit, modes, history and WME of the example building under one pulse."""
    path = tmp_path_factory.mktemp("building")
    time = np.arange(800) * 0.01
    pulse = 3.0 * np.sin(6.0 * time) * np.exp(-((time - 2.0) ** 2))
    write_csv(Record("pulse", pulse, 0.01, "file", "m/s2", "none"), path / "pulse.csv")
    params = {"building": settings}
    plan, fit = {"plan": str(PLAN)}, {"plan": str(PLAN), "fit": "fit.json"}
    steps = [("building_fit", {"input": plan, "output": {"fit": "fit.json"}, "params": params})]
    for model in ("CBDEM", "SBDEM"):
        steps.append(
            (
                "building_modal",
                {
                    "input": fit,
                    "output": {"modes": f"{model}.npz"},
                    "params": params,
                    "wildcards": {"building": model},
                },
            )
        )
    steps += [
        (
            "table_building_modes",
            {
                "input": {"cbdem": "CBDEM.npz", "sbdem": "SBDEM.npz"},
                "output": {"table": "modes.csv"},
                "params": {"paper": False},
            },
        ),
        (
            "building_history",
            {
                "input": {**fit, "modes": "SBDEM.npz", "record": "pulse.csv"},
                "output": {"history": "history.csv"},
                "params": params,
                "wildcards": {"building": "SBDEM"},
            },
        ),
        (
            "table_wme",
            {
                "input": {
                    "modes": "SBDEM.npz",
                    "histories": ["history.csv"],
                    "records": ["pulse.csv"],
                },
                "output": {"wme": "wme.csv", "chain": "chain.csv", "config": "chain.yaml"},
                "params": {**params, "records": ["pulse"], "paper": False},
            },
        ),
    ]
    for name, job in steps:
        script(name, path, **job)
    return path


@pytest.mark.xdist_group("building scripts")
def test_tables_follow_the_contract(folder):
    modes = pd.read_csv(folder / "modes.csv")
    assert list(modes.columns) == [
        "model",
        "mode",
        "direction",
        "period_s",
        "effective_mass_ratio",
        "period_paper_s",
    ]
    assert modes["period_paper_s"].isna().all()  # the study's periods are of another building
    assert np.all(modes.groupby(["model", "direction"])["period_s"].diff().dropna() <= 0.0)
    wme = pd.read_csv(folder / "wme.csv")
    assert list(wme.columns) == ["record", "n_dof", "quantity", "wme", "wme_paper"]
    assert len(wme) == 15
    assert np.all(wme["wme"] > 0.0)


@pytest.mark.xdist_group("building scripts")
def test_chain_feeds_the_facade_stage_by_configuration_alone(folder):
    modes, chain = pd.read_csv(folder / "modes.csv"), pd.read_csv(folder / "chain.csv")
    along_y = modes[(modes["model"] == "SBDEM") & (modes["direction"] == "y")]
    period = along_y.loc[along_y["effective_mass_ratio"].idxmax(), "period_s"]
    resolved = study_settings(yaml.safe_load((folder / "chain.yaml").read_text()))
    assert resolved["smdof"]["period_s"] == pytest.approx(period, rel=1e-5)
    assert resolved["smdof"]["n_dof"] == chain["n_dof"][0]


@pytest.mark.xdist_group("building scripts")
def test_history_starts_at_rest_and_amplifies(folder):
    history = pd.read_csv(folder / "history.csv")
    assert list(history.columns) == ["time_s", "ground_m_s2", "top_m_s2", "top_m"]
    assert abs(history["top_m"][0]) < 1e-12
    assert history["top_m_s2"].abs().max() > 1.1 * history["ground_m_s2"].abs().max()


def test_a_bad_plan_ends_in_one_line(tmp_path, settings):
    data = yaml.safe_load(PLAN.read_text())
    data["walls"][0]["openings"][0]["from_start_m"] = 5.5
    (tmp_path / "plan.yaml").write_text(yaml.safe_dump(data))
    done = script(
        "building_fit",
        tmp_path,
        checked=False,
        input={"plan": "plan.yaml"},
        output={"fit": "fit.json"},
        params={"building": settings},
    )
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1
    for word in ("plan.yaml", "'left'", "'window 1a'", "5.5 to 6.5 m", "0 to 6 m"):
        assert word in done.stderr
    assert not (tmp_path / "fit.json").exists()
