"""Arithmetic of claims by hand: what is said, and over what."""

import pandas as pd
import pytest
from studies.paper import claims


def test_what_a_bond_buys_is_said_of_both_pairs_of_models():
    capacity = pd.DataFrame({"W1": [0.2, 0.4], "W1c": [0.3, 0.6], "W2": [0.2, 0.2]})
    text, holds = claims._no_help(capacity.assign(W2c=[0.22, 0.2]))
    assert text == "W2c/W2 1.00 to 1.10, median 1.05; W1c/W1 median 1.50"
    assert holds == (claims.HELP > 1.05)
    assert claims._no_help(capacity) is None


@pytest.mark.parametrize(("third", "holds"), [(0.5, True), (0.7, False)])
def test_a_comparison_holds_only_where_it_does_in_every_case(third, holds):
    index = ["A+", "A-", "B+"]
    first, second = [0.2, 0.3, third], [0.4, 0.5, 0.6]
    capacity = pd.DataFrame({"W2": first, "W1": second}, index=index)
    width = bound = pd.DataFrame(0.0, index=index, columns=["W1", "W2"])
    text, said = claims._compare((capacity, width, bound), "W2", "W1", "<")
    assert said is holds
    assert f"as claimed in {2 + holds} of 3" in text
    assert ("not in B+" in text) is not holds
    turned, said = claims._compare((capacity, width, bound), "W1", "W2", ">")
    assert said is holds
