"""The assessment as a page: self-contained, with text for every picture, fit for a phone."""

import re

import numpy as np
import pytest
from rocking.assessment import pages
from rocking.assessment.document import Heading, Paragraph, Picture, Table, page
from webdriver import AVAILABLE, Browser


def draw(figure):
    axis = figure.subplots()
    axis.plot(np.arange(5), np.arange(5) ** 2)
    axis.set(xlabel="x [m]", ylabel="y [g]")


BLOCKS = [
    Heading("A <façade>", 1),
    Paragraph("First & only answer.\nSecond line.", strong=True),
    Heading("Numbers"),
    Table(
        "Numbers and where they are.",
        ("assumption", "value", "source"),
        [("one_long_name_of_a_key", "0.123", "return_wall.building_mass_kg")] * 12,
        (0.3, 0.2, 0.5),
        "results/run/assessment/code_checks.csv",
    ),
    Picture(draw, 60.0, "A curve.", "It rises from 0 to 16.", "results/run/curve.csv"),
]


def test_the_page_needs_nothing_else_and_says_what_its_pictures_show():
    text = page(BLOCKS)
    assert not re.search(r'(src|href)="(?!data:)', text)
    assert "http" not in re.sub(r"base64,[A-Za-z0-9+/=]+", "", text)
    assert 'alt="It rises from 0 to 16."' in text
    assert "A &lt;façade&gt;" in text
    assert "First &amp; only answer.<br>" in text
    assert '<td class="number">0.123<' in text
    assert '<td class="words">one_<wbr>long_<wbr>name' in text
    assert page(BLOCKS) == text  # same input, same bytes


def test_a_heading_parts_between_words_and_a_narrow_cell_at_hyphens_too():
    title = "Old town hall, west façade above the arcade of the market: out-of-plane assessment"
    for size in range(8, 30):
        assert " ".join(pages._wrapped(title, size)) == title
    assert pages._wrapped("out-of-plane", 8, 10.0)[0].endswith("-")


def test_the_same_blocks_make_the_same_pdf(tmp_path):
    paths = [tmp_path / "a.pdf", tmp_path / "b.pdf"]
    for path in paths:
        pages.write(path, BLOCKS * 3, "foot")
    first, second = (path.read_bytes() for path in paths)
    assert first == second
    assert len(re.findall(rb"/Type /Page\b", first)) >= 2


@pytest.mark.skipif(not AVAILABLE, reason="no Chromium with ChromeDriver")
def test_a_phone_shows_it_without_scrolling_sideways(tmp_path):
    path = tmp_path / "report.html"
    path.write_text(page(BLOCKS), encoding="utf-8")
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
