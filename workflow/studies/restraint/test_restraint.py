"""What a roof is worth: which runs YADE confirms, and which façades can have one."""

import numpy as np
import pandas as pd
import pytest
from both_solvers import BETA_S, FEW
from forked import snakemake
from rocking.collapse.case import Case
from rocking.collapse.motion import Motion
from study_cases import study_settings
from yade_process import resolved

from studies.restraint import study as restraint

G = 9.80665


def test_what_yade_confirms_of_a_roof():
    """Least and most friction of the largest load, below and above the band, within the scan."""
    config = study_settings({"facade": {"floors": [{"height_m": 3.0, "anchor_kn": 4.0}]}})
    rows = [(20.0, 0.2, 4.0, 0.1, 0.2, 0.2, 0.3, 3.0), (60.0, 0.0, 0.0, 0.1, 0.2, 0.3, 0.4, 3.0)]
    rows += [(60.0, 0.1, 6.0, 9.0, 9.0, 9.0, 9.0, 9.0), (60.0, 0.4, 24.0, 0.5, 1.0, 2, np.nan, 3)]
    names = ["load_kn", "friction", "capacity_kn", *restraint.INTENSITIES]
    table = pd.DataFrame(rows, columns=names)
    cases = restraint.to_confirm(Case(config), None, table, settings=None)["cases"]
    wanted = [(0.0, [0.19]), (0.0, [0.42]), (24.0, [0.95])]
    assert [(c["about"]["force_kn"], c["pga_g"]) for c in cases] == wanted
    for case in cases:
        facade, height = case["changes"]["facade"], case["about"]["height_m"]
        own, roof = facade["floors"]
        assert (own["anchor_kn"], roof["height_m"], roof["load_kn"]) == (4.0, height, 60)
        assert study_settings({"facade": facade})["facade"] == facade


@pytest.mark.slow
@pytest.mark.parametrize(
    ("given", "said"),
    [
        ("models=[W3]", "models = ['W3']: expected one with a planar counterpart"),
        ("restraint={loads_kn: [90000]}", "facade.height_m = 6.48: expected at most 0.95 (m)"),
    ],
)
def test_what_cannot_have_a_roof_is_refused_before_any_work(tmp_path, given, said):
    """Bonded walls alone have no planar counterpart, and a façade falls under too large a load."""
    done = snakemake(tmp_path, "-n", "--config", given, "--", "restraint")
    assert done.returncode != 0
    assert f"restraint: {said}" in done.stdout + done.stderr


@pytest.mark.slow
def test_worth_of_a_roof_is_the_static_one():
    """A long slow push: λ W h/2 = max over θ of

    (W + P)(b/2 − c/3) + min(k θ h, μ P) h − θ (W h/2 + P h), c = √(2 (W + P)/(jkn w θ)) ≤ b the
    pressed part of the base; collapse at the next level above it.
    """
    config = resolved(numerics={**FEW, "after_motion_s": 0.5})
    config["ida"] |= {"level_ratio": 0.02, "beyond": 1.03, "max_pga_g": 1.0}
    config["ensemble"] |= {"realisations": 2, "amplitude_spread": 0.02}
    case = Case({**config, "model": "W1", "beta_s": BETA_S})
    f = config["facade"]
    h, b = f["height_m"], f["thickness_m"]
    weight = f["density_kg_m3"] * h * b * f["width_m"] * G
    t = np.linspace(0.0, 6.0, 301)
    push = G * 0.5 * (1.0 - np.cos(np.pi * np.minimum(t / 3.0, 1.0)))
    settings = {"loads_kn": [60.0], "frictions": [0.0, 0.3]}
    found = restraint.collapse(case, Motion(floors=(t, {"ground": -push})), "pos", settings)
    theta = np.linspace(1e-3, 0.06, 2000)
    for row in found.itertuples():
        total = weight + 1e3 * row.load_kn
        pressed = np.sqrt(2.0 * total / (f["e_mpa"] * 1e6 / h * f["width_m"] * theta))
        held = h * np.minimum(2e7 * theta * h, 1e3 * row.capacity_kn)
        moment = total * (0.5 * b - pressed / 3.0) + held
        moment -= theta * (0.5 * weight * h + 1e3 * row.load_kn * h)
        expected = moment[pressed < b].max() / (0.5 * weight * h)
        assert 0.99 * expected < row.pga_collapse_g < 1.06 * expected
    assert found["capacity_kn"].tolist() == [0.0, 0.0, 18.0]
