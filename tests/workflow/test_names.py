"""Names of records and stations are text, whatever they look like, from table to table."""

import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from code_rules import as_python, used
from rocking.collapse.ida import by_curve
from rocking.records import read_table
from rocking.tables import NAMES, read_frame, read_tables, write_table

ROOT = Path(__file__).parents[2]
LIKE_VALUES = [
    "1063",
    "0012",
    "1E03",
    "1.0",
    "NA",
    "NaN",
    "nan",
    "null",
    "None",
    "True",
    "inf",
    "+5",
]


def drawn(seed, count=40):
    """Names that a records table may have, of few characters that values have too."""
    rng = np.random.default_rng(seed)
    letters = np.array(list("0123456789.EeNaTrue+-_"))
    found = ["".join(rng.choice(letters, rng.integers(1, 6))) for _ in range(20 * count)]
    return [name for name in found if re.fullmatch(r"[A-Za-z0-9_+][A-Za-z0-9._+-]*", name)][:count]


@pytest.mark.parametrize("names", [LIKE_VALUES, drawn(1), drawn(2)])
def test_names_come_back_from_tables_as_they_were(tmp_path, names):
    path = tmp_path / "table.csv"
    rows = [
        {"record": n, "station": n, "model": "W1", "pga_g": 0.1 * i} for i, n in enumerate(names)
    ]
    write_table(rows, path)
    for table in (read_frame(path), read_tables([path, path])[: len(names)]):
        assert list(table["record"]) == names
        assert list(table["station"]) == names
        assert table["pga_g"].dtype == float
    curves = []
    for i, name in enumerate(dict.fromkeys(names)):
        curves.append(tmp_path / f"{i}.csv")
        write_table([{"model": "W1", "record": name, "direction": "pos", "pga_g": 0.1}], curves[-1])
    assert [key[1] for key in by_curve(curves)] == list(dict.fromkeys(names))


def test_an_empty_name_is_missing_and_numbers_stay_numbers(tmp_path):
    path = tmp_path / "table.csv"
    path.write_text("record,station,pga_g,broken\n0012,,NaN,\n5,NA,1.5,3\n")
    table = read_frame(path)
    assert table["station"].isna().tolist() == [True, False]
    assert table["pga_g"].isna().tolist() == [True, False]
    assert pd.api.types.is_float_dtype(table["broken"])


def test_a_records_table_takes_such_names(tmp_path):
    (tmp_path / "a.txt").write_text("0.1\n0.2\n")
    path = tmp_path / "table.csv"
    names = [name for name in LIKE_VALUES if name.lower() not in ("nan",)]
    path.write_text("record,file\n" + "".join(f"{name},a.txt\n" for name in names))
    assert list(read_table(path)) == names


READERS = {f"pandas.{name}" for name in ("read_csv", "read_table", "read_fwf", "read_excel")}


def test_every_table_of_results_is_read_with_its_names_as_text():
    """pandas' own readers make a number of 0012 and nothing of NA."""
    folder = ROOT / "workflow"
    sources = {
        str(path.relative_to(ROOT)): used(path.read_text("utf-8"))
        for path in folder.rglob("*.py")
        if not (path.name.startswith("test_") or {"tests", "trials"} & {*path.parts})
    }
    for path in (folder / "Snakefile", *folder.rglob("*.smk")):
        sources[path.name] = used(as_python(path.read_text("utf-8")))
    assert [name for name, names in sources.items() if names & READERS] == [
        "workflow/rocking/tables.py"
    ]
    assert {"record", "station", "event"} <= set(NAMES)


@pytest.mark.parametrize(
    "text",
    [
        *("import pandas\npandas.read_csv('a')", "import pandas as p\np.read_table('a')"),
        *(
            "from pandas import read_csv as read",
            "def f():\n    import pandas as pd\n    pd.read_fwf",
        ),
    ],
)
def test_the_check_of_readers_finds(text):
    assert used(text) & READERS
