"""Arithmetic of the study by hand: what is run where, and what stands in its table."""

from studies.base_compliance import study as base_compliance

ROW_OF_CURVE = {"pga_median_g": 0.2, **dict.fromkeys(base_compliance.ENDS, 0.2)}


def test_the_chosen_stack_is_run_again_at_half_the_step_of_courses(monkeypatch):
    asked = []

    def collapses(cases, motion, directions, find, variants):
        asked.append((find, [variant.about["facade"] for variant in variants]))
        return [{"facade": variant.about["facade"], **ROW_OF_CURVE} for variant in variants]

    monkeypatch.setattr(base_compliance, "collapses", collapses)
    table = base_compliance.of_wall("own", None, None, "pos")
    (_, names), (half, again) = asked
    assert base_compliance.CHOICE in names
    assert again == [base_compliance.HALF]
    assert half.keywords == {"step": 0.5 * base_compliance.COURSES_STEP}
    assert half.func is base_compliance.costed
    assert table["facade"].tolist() == [*names, base_compliance.HALF]
    assert (table["wall"] == "own").all()
