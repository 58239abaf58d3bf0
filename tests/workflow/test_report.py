"""The report: pages of tables, and the one file in a real browser, clicked through to a figure."""

import subprocess
import sys
from pathlib import Path

import pytest
from run_script import script
from webdriver import AVAILABLE, Browser

ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / "workflow" / "scripts"


def page_of(tmp_path, text, name="ida_collapse"):
    """Run the page's script alone on a small table."""
    table, page = tmp_path / f"{name}.csv", tmp_path / "page.html"
    table.write_text(text)
    style = ROOT / "workflow/report/table.css"
    files = {"table": str(table), "style": str(style)}
    params = {"title": "a <title>", "text": "Words."}
    script("report_table", tmp_path, input=files, output=str(page), params=params)
    return page.read_text()


def test_a_page_escapes_its_text_writes_units_and_marks_the_study(tmp_path):
    text = page_of(
        tmp_path, "record,pga_safe_g,period_paper_s,wme_paper\n<b>X</b>,0.123456789,0.25,\n"
    )
    assert "&lt;b&gt;X&lt;/b&gt;" in text
    assert "<b>X" not in text
    assert "A &lt;title&gt;" in text
    assert "PGA safe [g]" in text
    assert ">0.1235<" in text
    assert text.count('class="number study"') == 4  # head and cell of two columns
    assert "study's own values" in text
    assert 'href="http' not in text


def test_the_answer_says_what_to_trust_and_how_far_records_were_scaled(tmp_path):
    (tmp_path / "ida.csv").write_text(
        "model,record,direction,pga_g,status\nW1,A,pos,0.6,ok\nW1,A,pos,0.7,overturned\n"
        "W1,B,pos,0.2,failed\n"
    )
    (tmp_path / "records.csv").write_text(
        "record,source,pga_g\nA,surrogate,0.1\nB,file,0.2\nC,file,0.1\n"
    )
    (tmp_path / "collapse.csv").write_text(
        "model,record,direction,pga_safe_g,pga_collapse_g,pga_p10_g,pga_p90_g,pga_all_g,pga_max_g,"
        "disagreements,runs_yade,runs_planar\nW1,A,pos,0.6,0.7,0.6,0.9,0.8,1.4,2,37,641\n"
        "W1,B,pos,0.2,,,,,0.4,0,5,0\nW1,C,pos,0.2,0.2,0.2,0.2,0.3,0.5,0,0,99\n"
    )
    (tmp_path / "figure.png").write_bytes(b"not looked at" * 999)
    code = (
        "import sys; from types import SimpleNamespace as N; from rocking.configuration.config "
        "import Settings; sys.path.insert(0, sys.argv[1]); snakemake = N(wildcards=N(run='r'), "
        "params=N(facade=Settings('{\"facade\":{\"height_m\":5.0}}'), models=['W1, a block']), "
        "input=N(ida=['ida.csv'], records='records.csv', collapse='collapse.csv', "
        "figure='figure.png', style=sys.argv[2]), output=type('Files', (N,), "
        "{'__iter__': lambda f: iter(vars(f).values())})(page='p.html', first='p.rst', "
        "factors='f.csv')); "
        "exec(open(sys.argv[1] + '/report_summary.py').read())"
    )
    style = ROOT / "workflow/report/table.css"
    done = subprocess.run(
        [sys.executable, "-c", code, str(SCRIPTS / "report"), str(style)],
        capture_output=True,
        text=True,
        cwd=tmp_path,
        env={"PYTHONPATH": f"{ROOT}:{ROOT / 'workflow'}"},
        timeout=60,
    )
    assert done.returncode == 0, done.stderr
    assert "warning: record A is scaled to 7.0 times its own peak, above 5" in done.stderr
    # of C, which YADE did not run, the amplitude from which all of the scan fell
    rows = (tmp_path / "f.csv").read_text().splitlines()[1:]
    assert rows == ["A,0.1,0.7,7", "B,0.2,0.2,1", "C,0.1,0.3,3"]
    text = (tmp_path / "p.html").read_text()
    for piece in (
        "height 5 m",
        "1 of 3 records are surrogates",
        "more than 5 times their own peak: A (7.0)",
        "1 of 3 runs failed",
        "1 of 3 curves never collapsed",
        "At 2 intensities YADE and the planar solver disagree",
        "1 of 3 curves have no single collapse intensity",
        '<td class="number">37</td><td class="number">641</td>',
    ):
        assert piece in text, piece
    assert max(map(len, (tmp_path / "p.rst").read_text().splitlines())) < 10_000


def category(browser, name):
    browser.click(f"//nav//a[normalize-space()='{name}']")


def press(browser, label, button):
    """Press "eye" or "information-circle" of the result with a label.

    Snakemake shows two results as a switch over one row, more of them as rows.
    """
    switch, row = f"//label[normalize-space()='{label}']", f"//tr[td[normalize-space()='{label}']]"
    browser.wait(lambda: browser.elements(f"{switch} | {row}"), label)
    if browser.elements(switch):
        browser.click(switch)
        row = "//tbody/tr"
    browser.click(f"{row}//*[@iconname='{button}']")


@pytest.mark.xdist_group("small study")
@pytest.mark.yade
@pytest.mark.slow
@pytest.mark.skipif(not AVAILABLE, reason="needs Chromium and ChromeDriver")
def test_report_opens_offline_and_clicks_through_to_figures_and_tables(small_study, tmp_path):
    report = tmp_path / "report.html"  # alone in a folder
    report.write_bytes((small_study / "report.html").read_bytes())
    with Browser(tmp_path / "profile") as browser:
        browser.open(report.as_uri())
        browser.wait(lambda: "lumped masses" in browser.text(), "the description")
        # it begins with the answer, from the top of the screen, and not with the graph of the rules
        first = browser.text()
        order = ("height 5.75 m", "PGA collapse [g]", "What to trust", "lumped masses")
        places = [first.index(text) for text in order]
        assert places == sorted(places)
        top = "return document.querySelector('.prose h1').getBoundingClientRect().top"
        assert 0 <= browser.script(top) < 200
        for name in (
            "Records",
            "Floor motions",
            "Incremental dynamic analyses",
            "Fragility",
            "Run times",
        ):
            assert browser.elements(f"//nav//a[normalize-space()='{name}']"), name

        # Figure 9: the picture itself is drawn, and its caption quotes this study's façade
        category(browser, "Incremental dynamic analyses")
        press(browser, "9: IDA curves", "eye")
        width = """const picture = document.querySelector('img[src^="data:image/png"]');
                   return picture && picture.naturalWidth"""
        assert browser.wait(lambda: browser.script(width), "Figure 9") > 500
        press(browser, "9: IDA curves", "information-circle")
        browser.wait(lambda: "DESCRIPTION" in browser.text().upper(), "the caption")
        assert "height 5.75 m" in browser.text()
        assert "W1" in browser.text()

        # the collapse table is a page with one row a curve
        browser.click("//nav//a[normalize-space()='Results']")
        category(browser, "Incremental dynamic analyses")
        press(browser, "collapse intensities", "eye")
        browser.enter("//iframe")
        browser.wait(lambda: "PGA collapse [g]" in browser.text(), "the table")
        assert "RRS228" in browser.text()
        assert len(browser.elements("//tbody/tr")) == 2
        browser.leave()

        # provenance says what the records are
        browser.click("//nav//a[normalize-space()='Results']")
        category(browser, "Records")
        press(browser, "provenance of every record", "eye")
        browser.enter("//iframe")
        browser.wait(lambda: "seed: 1977" in browser.text(), "the provenance")
        assert browser.text().count("surrogate\t") == 2
        wide = "const page = document.documentElement; return page.scrollWidth - page.clientWidth"
        assert browser.script(wide) == 0
        browser.leave()

        failed = [line for line in browser.log() if line.startswith("SEVERE")]
        assert not failed, failed  # as when anything is asked from a network
