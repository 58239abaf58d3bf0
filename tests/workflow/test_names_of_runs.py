"""One short pattern for the names of many runs."""

import random
import re

import pytest
from rocking.runs.names import any_of

GRID = [
    f"p-height_m_{5 + k / 10:.10g}-thickness_m_{0.3 + j / 200:.10g}"
    for k in range(25)
    for j in range(20)
]


@pytest.mark.parametrize(
    "names",
    [
        ["main"],
        ["tall", "tall-1", "tall-2", "small"],
        ["a.b", "a+b", "axb", "a-b", "a]b", "a^b", "a"],
        GRID,
        ["ab", "b", "aab", "bb"],
    ],
)
def test_a_pattern_matches_its_names_and_no_others(names):
    pattern = re.compile(any_of(names))
    rng = random.Random(4)
    others = [
        name[:k] + rng.choice("ab15.-+]^_") + name[k:] for name in names[:40] for k in range(4)
    ]
    others += [name[:-1] for name in names[:40]] + [a + b for a in names[:6] for b in names[:6]]
    for name in {*names, *others}:
        assert bool(pattern.fullmatch(name)) == (name in names), name


def test_a_pattern_of_a_grid_is_short_and_reads_in_a_path():
    """500 names in a row are 18,000 characters, in the path of every file of every job."""
    assert any_of(["tall", "tall-1", "tall-2"]) == r"tall(?:\-[12])?"
    pattern = any_of(GRID)
    assert len(pattern) < 300  # 2520 where what ends have in common is written with each
    assert not set("{}") & set(pattern)  # Snakemake's own marks around it
    path = re.compile(rf"results/(?P<run>{pattern})/tables/(?P<table>.+)\.csv")
    assert path.fullmatch(f"results/{GRID[77]}/tables/x.csv")["run"] == GRID[77]
