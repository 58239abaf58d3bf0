"""The assessment as a page and as its PDF: one source, self-contained, with text to be searched."""

import contextlib
import itertools
import os
import re
import shutil
import subprocess
import types
import zlib

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pytest
from studies.assess import paper, pictures
from studies.assess.catalogue import SAY
from studies.assess.drawings import spread
from studies.assess.paper import Picture, Table
from webdriver import AVAILABLE, Browser


def draw(figure):
    axis = figure.subplots()
    axis.plot(np.arange(5), np.arange(5) ** 2)
    axis.set(xlabel="x [m]", ylabel="y [g]")


TABLE = Table(
    "Numbers and where they are.",
    ("assumption", "value", "source"),
    [("one_long_name_of_a_key", "0.123", "return_wall.building_mass_kg")] * 12,
    (0.3, 0.2, 0.5),
    "results/run/assessment/code_checks.csv",
    (1,),
)
PICTURE = Picture(draw, 60.0, "A curve.", "It rises from 0 to 16.", "results/run/curve.csv")
NOTHING = {"lines": [], "tables": [], "picture": None, "pictures": []}
CONTEXT = {
    "say": SAY,
    **{"title": "A <façade>", "engineer": "An Engineer", "registration": "", "date": ""},
    **{"program": "program 1", "who": "Client: & sons", "verdict": ["First & only.", "α0 = 0.1"]},
    **{"drawing": PICTURE, "answers": [("Which ties?", "None.")], "rests_on": ["x"]},
    **{"mechanisms": TABLE, "next_steps": ["y"], "hand": {"name": "one", "tables": [TABLE]}},
    **{"capacity": PICTURE, "spectrum": TABLE, "dynamic": NOTHING, "ties": NOTHING},
    **{"fragility": None, "suite": TABLE, "rate": NOTHING, "sensitivity": NOTHING},
    **{"others": [], "checks": [], "spectra": PICTURE, "motions": TABLE, "motions_said": []},
    **{"formulas": TABLE, "stated": TABLE, "evidence": ["z"]},
}


def test_the_page_needs_nothing_else_and_says_what_its_pictures_show():
    text = paper.page(CONTEXT)
    assert not re.search(r'(src|href)="(?!data:)', text)
    assert "http" not in re.sub(r"base64,[A-Za-z0-9+/=]+", "", text)
    assert 'alt="It rises from 0 to 16."' in text
    assert "A &lt;façade&gt;" in text
    assert "First &amp; only." in text
    assert '<td class="number">0.123<' in text
    assert '<td class="words">one_<wbr>long_<wbr>name' in text
    assert text.count('<tr class="strong">') == 7  # one row in each of the tables
    assert paper.page(CONTEXT) == text  # same input, same bytes


def test_a_template_that_asks_for_what_is_not_there_says_so():
    with pytest.raises(paper.jinja2.UndefinedError, match="verdict"):
        paper.page({key: value for key, value in CONTEXT.items() if key != "verdict"})


def opened(data):
    """Bytes of a PDF with its packed streams unpacked."""
    found = [data]
    for stream in re.findall(rb"stream\r?\n(.*?)\r?\nendstream", data, re.S):
        with contextlib.suppress(zlib.error):
            found.append(zlib.decompress(stream))
    return b"".join(found)


@pytest.mark.slow
def test_the_same_page_makes_the_same_pdf_with_title_bookmarks_and_searchable_text(
    tmp_path, monkeypatch
):
    """Whatever the clock says, also in the fonts."""
    monkeypatch.delenv("SOURCE_DATE_EPOCH", raising=False)
    text = paper.page(CONTEXT)
    paths = [tmp_path / "a.pdf", tmp_path / "b.pdf"]
    for seconds, path in enumerate(paths):
        clock = types.SimpleNamespace(time=lambda now=1e9 + 100 * seconds: now)
        monkeypatch.setattr("fontTools.misc.timeTools.time", clock)
        paper.write_pdf(path, text)
    assert "SOURCE_DATE_EPOCH" not in os.environ
    first, second = (path.read_bytes() for path in paths)
    assert first == second
    inside = opened(first)
    assert len(re.findall(rb"/Type ?/Page\b", inside)) >= 2
    assert b"pdfaid:part" in inside
    assert b"/Outlines" in inside
    assert b"/URI" not in inside
    if not shutil.which("pdftotext"):
        return
    words = ["pdftotext", str(paths[0]), "-"]
    found = subprocess.run(words, capture_output=True, text=True, timeout=60, check=True).stdout
    for said in ("α0 = 0.1", "What this rests on", "x [m]", "building_mass_kg"):
        assert said in found, said


def test_a_page_that_would_fetch_something_is_refused(tmp_path):
    page = paper.page(CONTEXT).replace('src="data:', 'src="https://example.org/', 1)
    with pytest.raises(ValueError, match="expected a page that holds all it shows"):
        paper.write_pdf(tmp_path / "a.pdf", page)


def test_numbers_beside_a_drawing_keep_apart_and_in_order():
    rng = np.random.default_rng(3)
    for count in (1, 2, 5, 9):
        values = sorted(rng.uniform(0.0, 10.0, count))
        found = spread(values, 1.0, 0.0, 10.0)
        assert found == sorted(found)
        assert np.diff(found).min(initial=np.inf) > 0.97
        assert found[0] >= 0.0
        assert found[-1] <= 10.0
    assert spread([1.0, 5.0], 1.0, 0.0, 10.0) == [1.0, 5.0]
    assert np.diff(spread([3.0] * 21, 1.0, 0.0, 10.0)) == pytest.approx(0.5, rel=1e-6)


@pytest.mark.parametrize("near", [0.57, 0.574, 0.6, 0.5])
def test_labels_of_a_bar_do_not_overprint(near):
    """Of two factors whose values are alike, on one side of the line or on both."""
    rows = [("a", 0.95, 0.575), ("a", 1.05, near), ("b", 0.75, 0.94), ("b", 1.25, 0.545)]
    table = pd.DataFrame(rows, columns=["key", "factor", "value"])
    figure = plt.figure(figsize=(4.7, 1.7), layout="constrained")
    pictures.tornado(SAY, table, 0.543, figure)
    figure.canvas.draw()
    labels = [one for one in figure.axes[0].texts if one.get_text().startswith("×")]
    boxes = [one.get_window_extent() for one in labels]
    plt.close(figure)
    assert "".join(sorted("".join(one.get_text() for one in labels))).count("×") == 4
    for one, other in itertools.combinations(boxes, 2):
        assert not one.overlaps(other)


@pytest.mark.skipif(not AVAILABLE, reason="no Chromium with ChromeDriver")
def test_a_phone_shows_it_without_scrolling_sideways(tmp_path):
    path = tmp_path / "report.html"
    path.write_text(paper.page(CONTEXT), encoding="utf-8")
    with Browser(tmp_path / "profile") as browser:
        browser.call_cdp(
            "Emulation.setDeviceMetricsOverride",
            {"width": 390, "height": 844, "deviceScaleFactor": 1, "mobile": True},
        )
        browser.open(path.as_uri())
        wide, shown = browser.script(
            "return [document.documentElement.scrollWidth, document.images[0].naturalWidth]"
        )
        assert wide <= 390
        assert shown > 0
        assert browser.log() == []
