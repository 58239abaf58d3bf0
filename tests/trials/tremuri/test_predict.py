"""The storey that foretells the drifts of TREMURI's house, where a closed form knows them."""

import numpy as np
import pytest

from smdof.spectra import response_spectrum
from tests.trials.tremuri import predict

RECORD = "GMN_NS"


@pytest.mark.parametrize("period_s", [0.07, 0.23])
def test_a_storey_that_never_yields_drifts_by_the_elastic_spectrum(period_s):
    motions = predict.motions_of([RECORD])
    found = predict.drifts_mm(motions, (period_s, 10.0, "bilinear"), 0.05)
    spectrum = response_spectrum(motions[RECORD], predict.STEP_S, [period_s], 0.05)
    assert found == pytest.approx(1e3 * spectrum.sd_m, rel=0.01)


def test_a_weak_storey_drifts_by_more_than_its_yield():
    motions = predict.motions_of([RECORD])
    period_s, ratio = 0.23, 0.1
    found = predict.drifts_mm(motions, (period_s, ratio, "bilinear"), 0.05)
    assert found > 1e3 * ratio * 9.80665 * (period_s / (2.0 * np.pi)) ** 2
