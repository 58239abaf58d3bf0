"""The tables of a mechanism, with a pocket calculator: what is printed follows from what is "
"printed."""

import math

import pandas as pd
import pytest
from studies.assess import appendix, byhand
from studies.assess.catalogue import SAY
from studies.assess.family import Family
from study_cases import study_settings

FACADE = {
    "height_m": 8.0,
    "thickness_m": 0.5,
    "width_m": 7.0,
    "density_kg_m3": 1900.0,
    "gable_height_m": 1.8,
    "thickness_steps": [{"z_m": 3.0, "thickness_m": 0.4}],
    "openings": [{"x_m": 0.0, "z_m": 4.0, "width_m": 1.2, "height_m": 1.5}],
    "floors": [{"height_m": 3.0, "load_kn": 20, "anchor_kn": 8}, {"height_m": 8.0, "load_kn": 12}],
    "ties": [{"height_m": 6.0, "diameter_mm": 12.0, "slack_mm": 0.0}],
}
CONFIG = study_settings({"facade": FACADE, "assessment": {"interlocking_course_m": None}})
FAMILY = Family(CONFIG)
PLANE = {one.name: one for one in FAMILY.all() if one.plane}


def cells(table, column):
    return [float(row[column].replace("−", "-")) for row in table.rows[:-1]]


@pytest.mark.parametrize("name", list(PLANE))
def test_sums_of_the_printed_parts_give_the_printed_results(name):
    """α0, M* and e* from the digits of the tables, to the digits of the results."""
    one = PLANE[name]
    rows, holds = byhand.parts(FAMILY, one), byhand.pulled(one)
    total = byhand.sums(rows, holds)
    table = appendix._parts(rows, total, True, SAY)
    p, out, up, square = (cells(table, k) for k in (1, 4, 5, 6))
    done = [sum(w * v for w, v in zip(p, column, strict=True)) for column in (out, up, square)]
    pulled = 0.0
    if holds:
        held = appendix._holds(holds, SAY)
        pulled = sum(float(row[1]) * float(row[4]) for row in held.rows)
    alpha = (done[1] + pulled) / done[0]
    mass = 1e3 * done[0] ** 2 / (9.81 * done[2])
    moving = sum(w for w, v in zip(p, out, strict=True) if v)
    share = 9.81 * mass / (1e3 * moving)
    printed = {s: v for s, _, v, _ in byhand.results(one, total, 1.35)}
    assert f"{alpha:.4g}" == f"{printed['α0']:.4g}" or alpha == pytest.approx(
        printed["α0"], rel=2e-4
    )
    assert mass == pytest.approx(printed["M*"], rel=1e-4)
    assert share == pytest.approx(printed["e*"], rel=1e-4)
    mechanism = one.mechanism
    assert printed["α0"] == pytest.approx(mechanism.multiplier(), rel=1e-12)
    assert (printed["M*"], printed["e*"]) == pytest.approx(mechanism.participation()[:2], rel=1e-12)


def test_a_bands_weight_and_lever_arms_are_those_of_a_drawing():
    """Whole façade: the band from sill to head is 7 − 1.2 m wide and 0.4 m thick, 1.5 m high."""
    one = PLANE["whole façade about its base"]
    (band,) = (p for p in byhand.parts(FAMILY, one) if p.about.get("low_m") == 4.0)
    assert band.weight_n == pytest.approx(1900 * 9.81 * 5.8 * 0.4 * 1.5)
    assert (band.y_m, band.z_m) == pytest.approx((0.3, 4.75))  # flush outside
    assert (band.out, band.up) == pytest.approx((4.75, 0.2))  # about the toe at y = 0.5
    assert band.square == pytest.approx(4.75**2 + 1.5**2 / 12.0)
    assert SAY(f"hand.part.{band.key}", **band.about) == "4.00–5.50 m, 5.8 × 0.4 m"


def test_one_block_turns_about_its_toe_as_its_sums_say():
    """tan θ0 = Σ P δz/Σ P δx without holds; d0 = H sin θ0, and α(θ) = tan(θ0 − θ)."""
    one = PLANE["part above 8.00 m (foot of the gable and floor)"]
    rows = byhand.parts(FAMILY, one)
    total = byhand.sums(rows, [])
    printed = {s: v for s, _, v, _ in byhand.results(one, total, 1.35)}
    theta = math.atan(total.up_n / total.out_n)
    assert printed["θ0"] == pytest.approx(theta, rel=1e-9)
    assert printed["d0"] == pytest.approx(1.8 * math.sin(theta), rel=1e-9)
    assert printed["θ"] == pytest.approx(math.asin(0.4 * math.sin(theta)), rel=1e-9)
    assert printed["α(dC)"] == pytest.approx(math.tan(theta - printed["θ"]), rel=1e-9)
    a = printed["α(dC)"] * 9.80665 / (printed["e*"] * 1.35)
    assert printed["a"] == pytest.approx(a, rel=1e-12)


def test_holds_are_printed_with_their_way():
    one = PLANE["whole façade about its base"]
    floor, tie = byhand.pulled(one)
    assert (floor.height_m, floor.force_n, floor.reach_m) == pytest.approx((3.0, 8e3, 0.2))
    assert tie.force_n == pytest.approx(2 * math.pi / 4 * 0.012**2 * 235e6)
    assert (floor.out, tie.out) == pytest.approx((3.0, 6.0))


def test_rows_of_a_list_are_stated_in_one_line():
    given = [f"facade.floors.{k}.{key}" for k in (1, 2) for key in ("height_m", "load_kn")]
    data = type("Data", (), {"config": CONFIG, "given": given, "folder": "f", "say": SAY})
    found = {(row[0], row[2]): row[1] for row in appendix.stated(data).rows}
    assert found["facade.floors.1", "stated"] == "height_m 3; load_kn 20"
    assert not any(key.startswith("facade.density") for key, _ in found)  # a default here
    assert isinstance(pd.DataFrame(appendix.stated(data).rows), pd.DataFrame)
