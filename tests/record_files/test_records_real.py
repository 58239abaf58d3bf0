"""Real files, beside the repository when they are there."""

from pathlib import Path

import numpy as np
import pytest
import record_samples as samples
from record_files import FORMATS
from record_files.reader import _detect
from record_files.text import text_from_bytes
from rocking.records import detect, integrate, read_record

FILES = Path(__file__).parents[3] / "shared" / "formats"
REAL = {  # file: (format, component, step, samples)
    "COSMOS_V1_Cosmos12TimeSeriesTest.v1": ("cosmos", None, 0.01, 7000),
    "CSMIP_V2_ce36456p_CE36456.V2": ("csmip", "0", 0.02, 3250),
    "CSV_pyslammer_Nahanni_1985_NS1-280.csv": ("csv", None, 0.005, 4113),
    "ESM_dyna_HL.DLFA..HNE.D.20190728.160908.C.ACC.ASC": ("esm", None, 0.005, 13876),
    "ESM_old_20101114230825_3104_ap_RawAcc_E.asc": ("esm", None, 0.01, 5600),
    "GeoNet_20110222_015029_MQZ.V2A": ("geonet", "E", 0.02, 3300),
    "GeoNet_20160214_001347_HVSC_20.V1A": ("geonet", "S26W", 0.005, 11478),
    "GeoNet_20180212_211557_WPWS_20.V2A": ("geonet", "S74E", 0.02, 5800),
    "GeoNet_small_D00129A02.V1A": ("geonet", "#1", 0.01, 1483),
    "KNET_CHB0031412312349.EW": ("knet", "E-W", 0.01, 6000),
    "PEER_NGA2005_NGA_no_1063_RRS228.AT2": ("at2", "228", 0.01, 1991),
    "PEER_NGAWest2_RSN292_ITALY_A-STU270.AT2": ("at2", None, 0.0024, 16392),
    "PEER_NGAWest2_RSN763_LOMAP_GIL067.AT2": ("at2", None, 0.005, 7999),
    "PEER_original_PEA_ARL360.at2": ("at2", None, 0.02, 2000),
    "SINGLECOL_slammer_NS1-280": ("single-column", None, 0.005, 4113),
    "SMC_0111a.smc": ("smc", "360", 0.005, 6001),
    "TWOCOL_SortedEQFile_120111.txt": ("two-column", None, 0.01, 3000),
}


def real_file(name):
    if not (FILES / name).is_file():
        pytest.skip("the real record is not here")
    return FILES / name


@pytest.mark.parametrize("name", REAL)
def test_real_file(name):
    path = real_file(name)
    form, component, dt_s, count = REAL[name]
    assert detect(path) == form
    bare = form in ("single-column", "two-column")
    record = read_record(
        path,
        component=component,
        units="g" if bare else None,
        dt_s=dt_s if form == "single-column" else None,
    )
    assert len(record) == count
    assert record.dt_s == pytest.approx(dt_s, rel=1e-6)


def test_one_motion_in_two_formats_is_the_same():
    comma = read_record(real_file("CSV_pyslammer_Nahanni_1985_NS1-280.csv"))
    column = read_record(real_file("SINGLECOL_slammer_NS1-280"), units="g", dt_s=0.005)
    np.testing.assert_array_equal(comma.acceleration_m_s2, column.acceleration_m_s2)


@pytest.mark.parametrize(
    ("name", "component", "peaks"),
    [  # velocity [m/s] and displacement [m] peaks that the files' own headings state
        ("CSMIP_V2_ce36456p_CE36456.V2", "90", (0.28253, 0.05449)),
        ("CSMIP_V2_ce36456p_CE36456.V2", "UP", (0.11377, 0.03820)),
        ("GeoNet_20110222_015029_MQZ.V2A", "E", (0.14011, 0.016576)),
        ("GeoNet_20110222_015029_MQZ.V2A", "N", (0.05863, 0.025745)),
    ],
)
def test_integrated_peaks_agree_with_the_file_s_own(name, component, peaks):
    """Units and step are right when integration gives the processing agency's velocity.

    Its displacement starts from an initial value of some millimetres that the
    acceleration does not hold, so it agrees less closely.
    """
    record = read_record(real_file(name), component=component)
    v, d = integrate(record.acceleration_m_s2, record.dt_s)
    assert np.abs(v).max() == pytest.approx(peaks[0], rel=0.01)
    assert np.abs(d).max() == pytest.approx(peaks[1], rel=0.08)


def test_every_format_has_a_sample_and_a_real_file():
    ours = {"columns", "wrapped", "packed"}
    assert {form for form, *_ in REAL.values()} == set(FORMATS) - ours
    found = {detect_name(sample) for sample in [*samples.all_samples(), samples.packed()]}
    assert found == set(FORMATS)


def detect_name(sample):
    return _detect(text_from_bytes(sample.name, sample.data))
