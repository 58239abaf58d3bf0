"""Of rows of ties that hold, which is the best."""

import numpy as np
import pandas as pd
from studies.assess import strengthening


def test_of_equal_forces_the_highest_row_is_the_best():
    table = pd.DataFrame({"height_m": [2.0, 4.0, 6.0, 8.0], "force_kn": [5.0, 3.0, 3.0, np.nan]})
    assert strengthening.best(table)["height_m"] == 6.0
    assert strengthening.best(table[::-1])["height_m"] == 6.0
    assert strengthening.best(table[table["height_m"] == 8.0]) is None
