"""What an assessment reads: spectra and hazards, refused in one line where they mean nothing."""

import numpy as np
import pytest
from rocking.records import G_M_S2, Record
from rocking.records.floors import chain_motions
from studies.assess import inputs
from studies.assess.demand import RecordDemand, floor_demand
from studies.assess.site import SpectrumError, at_pga, pga_at, read_spectrum, shapes
from studies.assess.values import values
from studies.shared.hazard import Hazard
from study_cases import study_settings

from smdof.spectra import response_spectrum

CHAIN = {
    "n_dof": 3,
    "period_s": 0.3,
    "damping_ratio": 0.05,
    "damping_model": "modal",
    "tail_s": 2.0,
}


def written(tmp_path, text):
    path = tmp_path / "spectrum.csv"
    path.write_text(text)
    return str(path)


def test_a_spectrum_is_read_with_its_remarks(tmp_path):
    found = read_spectrum(written(tmp_path, "# of a place\nperiod_s,sa_g\n0,0.2\n0.5,0.4\n2,0.1\n"))
    assert found.pga_g == 0.2
    assert found.acceleration(1.25) == pytest.approx(0.25)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "the file is empty"),
        ("period_s;sa_g\n0;0.2\n", "expected period_s,sa_g"),
        ("period_s,sa_g\n0,0.2\n0.5,-0.4\n2,0.1\n", "line 3"),
        ("period_s,sa_g\n0,0.2\n0.5,soft\n2,0.1\n", "line 3"),
        ("period_s,sa_g\n0,0.2\n2,0.4\n0.5,0.1\n", "does not ascend"),
        ("period_s,sa_g\n0.1,0.2\n0.5,0.4\n2,0.1\n", "from period 0"),
        ("period_s,sa_g\n0,0.2\n0.5,nan\n2,0.1\n", "line 3"),
    ],
)
def test_a_spectrum_that_means_nothing_is_refused_in_one_line(tmp_path, text, words):
    with pytest.raises((SpectrumError, ValueError), match=words) as caught:
        read_spectrum(written(tmp_path, text))
    assert "\n" not in str(caught.value)


def test_the_pga_of_a_return_period_lies_on_the_hazards_power_law():
    """λ = 1e-4 x^−2: one in 475 years at √(475e-4) = 0.2179 g."""
    x = np.array([0.05, 0.1, 0.5, 1.0])
    hazard = Hazard("pga_g", x, 1e-4 * x**-2.0)
    assert pga_at(hazard, 475.0) == pytest.approx(0.2179, rel=1e-3)
    with pytest.raises(SpectrumError, match="reach"):
        pga_at(hazard, 1e6)
    with pytest.raises(SpectrumError, match="pgv_cm_s"):
        pga_at(Hazard("pgv_cm_s", x, 1e-4 * x**-2.0), 475.0)


def record(seed, dt=0.01, n=1200):
    rng = np.random.default_rng(seed)
    values = rng.standard_normal(n) * np.hanning(n)
    return Record(name=f"r{seed}", acceleration_m_s2=values - values.mean(), dt_s=dt, source="file")


def test_the_median_shape_starts_at_the_pga_and_scales_with_it():
    shape = shapes([record(1), record(2), record(3)])
    assert at_pga(shape, 0.3).pga_g == pytest.approx(0.3)
    one, two = at_pga(shape, 0.3), at_pga(shape, 0.6)
    assert two.acceleration(0.7) == pytest.approx(2.0 * one.acceleration(0.7))


def test_the_formula_at_the_roof_peaks_near_the_chain_where_it_resonates():
    """At T1 the exact chain and the formula agree within a factor that no other period could meet.

    Of broad-band noise the formula's plateau stands for a peak; at the roof its median over motions
    lies within a factor of 1.6 of the exact one, while at 0.6 T1 it is far above it.
    """
    periods, ratios = 0.3 * np.array([0.6, 1.0]), []
    for one in map(record, (1, 2, 3, 4)):
        motion = chain_motions(one, CHAIN)
        roof, dt = motion.floors_m_s2[-1], one.dt_s / motion.refine
        exact = response_spectrum(roof, dt, periods, 0.05).psa_m_s2 / G_M_S2
        floor = floor_demand(RecordDemand(one.acceleration_m_s2, one.dt_s), 1.0, CHAIN)
        ratios.append([floor.acceleration(t, 0.05) for t in periods] / exact)
    below, at = np.median(ratios, axis=0)
    assert 1 / 1.6 < at < 1.6
    assert below > 1.5


def test_modal_peaks_are_those_of_the_records_own_spectrum():
    demand = RecordDemand(record(5).acceleration_m_s2, 0.01)
    floor = floor_demand(demand, 1.0, CHAIN)
    first = demand.acceleration(0.3) * abs(floor.share) * np.sqrt(1.01)
    assert floor.peak_g == pytest.approx(first)


STATED = {
    "facade": {"height_m": 6.0, "thickness_m": 0.4, "width_m": 4.4, "density_kg_m3": 1800},
    "smdof": {"n_dof": 4, "period_s": 0.3},
    "assessment": {"confidence_factor": 1.2},
}


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({}, "facade.height_m, .*, assessment.confidence_factor not stated"),
        (
            {"facade": {"height_m": 6.0}},
            "assess: facade.thickness_m, facade.wi.* not stated",
        ),
        (STATED | {"smdof": {"n_dof": 2}}, "assess: smdof.period_s not stated"),
    ],
)
def test_an_assessment_takes_no_façade_from_the_case_study(given, words):
    with pytest.raises(ValueError, match=words):
        inputs.check_stated(given)


def test_walls_that_carry_a_building_do_not_carry_the_case_studys():
    inputs.check_stated(STATED, ["W1", "W2"])
    with pytest.raises(ValueError, match=r"assess: return_wall\.building_mass_kg not stated"):
        inputs.check_stated(STATED, ["W1", "W2m"])
    inputs.check_stated(STATED | {"return_wall": {"building_mass_kg": 1e5}}, ["W2m"])
    inputs.check_stated(STATED | {"building": {}}, ["W2m"])


def test_rods_of_ties_that_are_there_are_stated():
    """Length and diameter say how far a rod stretches before it yields or breaks."""
    rods = {"height_m": 4.0, "diameter_mm": 22.0, "length_m": 9.0}
    tied = {**STATED, "facade": {**STATED["facade"], "ties": [rods, {"height_m": 6.0}]}}
    with pytest.raises(ValueError, match=r"ties\.2\.diameter_mm, facade\.ties\.2\.length_m not"):
        inputs.check_stated(tied)
    inputs.check_stated({**STATED, "facade": {**STATED["facade"], "ties": [rods]}})


def test_rows_of_a_list_are_marked_key_by_key():
    floors = [{"height_m": 3.0, "load_kn": 20.0}]
    given = STATED | {"facade": STATED["facade"] | {"floors": floors}}
    resolved = study_settings(given)
    stated = inputs.every_value(given)
    found = {key: rest for key, *rest in values(resolved, stated)}
    assert found["facade.floors.1.load_kn"] == ["20", "stated"]
    assert found["facade.floors.1.friction"] == ["0.4", "default"]
    assert found["facade.floors.1.arm_m"] == ["half the thickness", "derived"]
    assert found["facade.ties"] == ["[]", "default"]


def test_every_value_is_marked_and_β_says_where_its_law_ends():
    given = STATED | {"facade": STATED["facade"] | {"parapet_height_m": 0.9}}

    def row(damping, key):
        resolved = study_settings(given | {"damping": damping})
        found = {name: rest for name, *rest in values(resolved, ["facade.height_m"])}
        assert {standing for _, standing in found.values()} == {"stated", "derived", "default"}
        return found[key]

    assert row({}, "facade.height_m") == ["6", "stated"]
    assert row({}, "facade.parapet_thickness_m") == ["that of the highest storey", "derived"]
    assert row({}, "baseline.method")[1] == "default"
    resolved = study_settings(given)
    stiffness = 1e6 * resolved["facade"]["e_mpa"] / 6.0  # E/h
    words, _ = row({}, "facade.base_stiffness_pa_m")
    assert f"{stiffness:.3g}" in words.replace("·10", "e")
    for damping, standing in (({}, "default"), ({"law": "eq5"}, "derived")):
        words, found = row(damping, "damping.beta_s")
        assert found == standing
        assert "beyond the walls that it was fitted to" in words


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ({}, "no demand"),
        ({"assessment": {"confidence_factor": 1.2, "spectrum": "none.csv"}}, "assessment.spectrum"),
        ({"risk": {"hazard": "none.csv"}}, "risk.hazard"),
    ],
)
def test_a_missing_demand_is_refused_in_one_line(more, words):
    inputs.check_stated(STATED | more)
    resolved = study_settings(STATED | more)

    def check():
        files = inputs.spectrum_file(resolved, str), inputs.hazard_file(resolved, str)
        inputs.check_demand(resolved, *files)

    with pytest.raises(ValueError, match=words) as caught:
        check()
    assert "\n" not in str(caught.value)


def test_the_shape_at_a_hazards_pga_is_the_middle_one():
    """Of three spectra of 1, 2 and 4 times the PGA the demand has the one of 2."""
    shape = np.ones((3, 32)) * np.array([[4.0], [1.0], [2.0]])
    shape[:, 0] = 1.0  # period 0
    found = at_pga(shape, 0.3)
    assert found.pga_g == pytest.approx(0.3)
    assert found.acceleration(0.5) == pytest.approx(0.6)


def test_a_part_is_not_assessed_by_itself():
    """Its own checks would take the whole façade's mechanisms."""
    resolved = study_settings({"part": {"foot_m": 2.0}})
    with pytest.raises(ValueError, match="assess: part: expected none"):
        inputs.check_mechanisms(resolved)


def test_a_report_without_what_prints_it_is_refused_by_the_command_that_installs_it():
    inputs.check_printer("json")  # is there
    with pytest.raises(ValueError, match="needs the package none_such.*`make setup`"):
        inputs.check_printer("none_such")
