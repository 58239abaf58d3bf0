"""One test for every format."""

import pytest
import record_samples as samples

NAMES = [sample.name for sample in samples.all_samples()]


@pytest.fixture(params=samples.all_samples(), ids=NAMES)
def sample(request):
    return request.param
