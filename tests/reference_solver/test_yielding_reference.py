"""A building that yields, by the reference solvers and by the compiled one."""

import pytest
from reference_solver.facade import answers
from rocking import Motion, history

from tests.cases import yielding_cases


@pytest.mark.slow
@pytest.mark.parametrize(("model", "loops"), [("W2", "peak_oriented"), ("W2m", "bilinear")])
def test_both_planar_solvers_have_the_same_peak(model, loops):
    """The compiled solver marches it with the façade; here it is floors, or springs and sliders."""
    case, motion = yielding_cases.case(model, 0.06, loops), Motion.named("RRS228")
    found = answers(case.sections, motion.columns(case), "neg", [0.08], nodes=17, tolerance=1e-6)
    own = history(case, motion, "neg", 0.08)
    assert found.status == [own.status] == ["ok"]
    assert found.d_over_b[0] == pytest.approx(own.d_over_b, rel=1e-3)
