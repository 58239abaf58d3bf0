"""One small tied façade through all of `assess`, its numbers made again by formulas of its own."""

import base64
import html
import math
import re

import numpy as np
import pandas as pd
import pytest
import yaml
from forked import snakemake
from rocking import Motion, history
from rocking.collapse.curve import run_by
from scipy.integrate import cumulative_trapezoid
from studies.assess.code_checks import family_of, governing
from studies.assess.code_spectrum import CodeDemand
from studies.assess.dynamic_check import checked, limits_of, verdict
from studies.assess.shaken import cases, chosen
from study_cases import study_case, study_settings
from test_language import ENGLISH_WORDS, NAMES

pytestmark = [pytest.mark.slow, pytest.mark.yade, pytest.mark.xdist_group("whole path")]

H, B, FOOT, AG, F0, TC_STAR = 3.6, 0.24, 1.6, 0.16, 2.4, 0.3
G = 9.80665
TABLE = "config/suites/recorded_suite.tsv"
STATIONS = ("GMN_NS", "IS101_Lo", "IS113_Lo", "LPCC_H1", "BGI_NS", "IS106_Lo", "IS108_Lo")
CONFIG = f"""
run: small
models: [W2, W1]
records_table: {TABLE}
records: [{", ".join(STATIONS)}]
directions: [neg]
facade:
  height_m: {H}
  thickness_m: {B}
  width_m: 4.0
  density_kg_m3: 1700
  courses: 0
  ties: [{{height_m: {FOOT}, count: 2, diameter_mm: 16, length_m: 3.0, anchor_kn: 60}}]
damping: {{law: value, beta_s: 0.001}}
smdof: {{n_dof: 2, period_s: 0.2, base_shear_ratio: null}}
ida: {{max_pga_g: 1.5}}
assessment: {{confidence_factor: 1.2, ag_g: {AG}, f0: {F0}, tc_star_s: {TC_STAR}, soil: B,
  motions: 7, yade_histories: 2, dynamic_realisations: 0, resamples: 100}}
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    here = tmp_path_factory.mktemp("assessed")
    (here / "small.yaml").write_text(CONFIG)
    done = snakemake(here, "--configfile", "small.yaml", "--", "assess")
    assert done.returncode == 0, done.stderr
    return here / "results/small/assessment"


@pytest.fixture(scope="module")
def italian(folder):
    """Pages of the same run in English and in Italian, and the tables made for the second."""
    here, page = folder.parents[2], folder / "report.html"
    before = page.read_text("utf-8")
    made = {path: path.stat().st_mtime_ns for path in folder.glob("*.csv")}
    words = "assessment={language: it, engineer: Ada}"
    done = snakemake(here, "--configfile", "small.yaml", "--config", words, "--", "assess")
    assert done.returncode == 0, done.stderr
    other = page.read_text("utf-8")
    page.write_text(before, "utf-8")  # for tests that read the English one
    return before, other, {path.name for path in made if path.stat().st_mtime_ns != made[path]}


def the_part(model):
    """The part above the row of ties, as a case."""
    rows = [{"height_m": FOOT, "diameter_mm": 16.0, "length_m": 3.0, "anchor_kn": 60.0}]
    facade = {"height_m": H, "thickness_m": B, "width_m": 4.0, "density_kg_m3": 1700.0}
    given = {"facade": {**facade, "ties": rows}, "smdof": {"n_dof": 2, "period_s": 0.2}}
    damping = {"law": "value", "beta_s": 0.001}
    return study_case(model, {**given, "damping": damping}).part(FOOT)


def ground_g(period_s, damping):
    """NTC 2018, subsoil B: S = 1.4 − 0.4 F0 a_g ≤ 1.2, T_C = 1.1 T_C*^0.8, S_e(T) [g]."""
    s, tc, td = min(1.4 - 0.4 * F0 * AG, 1.2), 1.1 * TC_STAR**0.8, 4.0 * AG + 1.6
    high = max(math.sqrt(10.0 / (5.0 + 100.0 * damping)), 0.55) * F0
    if period_s < tc / 3.0:
        return AG * s * (1.0 + (high - 1.0) * period_s / (tc / 3.0))
    return AG * s * high * min(1.0, tc / period_s) * min(1.0, td / max(period_s, 1e-9))


def floor_g(period_s, damping, place):
    """Circolare C7.2.5–7 with the first mode of two equal masses, (1, φ), φ the golden ratio."""
    golden = 0.5 * (1.0 + math.sqrt(5.0))
    factor = (1.0 + golden) / (1.0 + golden**2)
    shape = factor * (2.0 * place if place < 0.5 else 1.0 + (golden - 1.0) * (2.0 * place - 1.0))
    peak = ground_g(0.2, 0.05) * shape * math.sqrt(1.01)
    r = 1.1 / math.sqrt(0.05) * math.sqrt(10.0 / (5.0 + 100.0 * damping))
    if period_s < 0.16:
        return r * peak / (1.0 + (r - 1.0) * (1.0 - period_s / 0.16) ** 1.6)
    far = r * peak / (1.0 + (r - 1.0) * max(period_s / 0.22 - 1.0, 0.0) ** 1.2)
    return max(far, ground_g(period_s, damping)) if period_s > 0.2 else far


def test_what_the_code_says_of_the_part_above_the_ties(folder):
    """Hand calculation, C8.7.1.2.1: b/h of the upper 2 m, FC of knowledge level 1."""
    tall = H - FOOT
    alpha = math.atan(B / tall)
    d0 = tall * math.sin(alpha)
    turned = math.asin(0.4 * d0 / tall)
    a = math.tan(alpha - turned) * G / (0.75 * 1.35)
    d_slv = 0.4 * d0 * 2.0 / 3.0
    period = 1.68 * math.pi * math.sqrt(d_slv / a)
    place = 0.5 * (FOOT + H) / H
    # the largest displacement up to there: on a floor not below that of b T1 beyond b T1
    periods = np.linspace(period / 12.0, period, 4000)
    held = [floor_g(t, 0.08, place) * G * (t / (2 * math.pi)) ** 2 for t in periods]
    tail = floor_g(0.2, 0.08, place) * G * (0.22 / (2 * math.pi)) ** 2
    pga_g = ground_g(0.0, 0.05)
    fails = pga_g * d_slv / max(*held, tail)
    onset = B / tall / (0.75 * 1.35)
    fails = max(fails, pga_g * onset / floor_g(0.0, 0.05, place))
    least = pd.read_csv(folder / "mechanisms.csv").iloc[0]
    assert least["mechanism"] == f"part above {FOOT:.2f} m (tie)"
    assert least["multiplier"] == pytest.approx(B / tall, rel=1e-5)
    assert least["d0_m"] == pytest.approx(d0, rel=1e-5)
    assert least["pga_fails_g"] == pytest.approx(fails, rel=2e-3)  # steps of periods
    steps = pd.read_csv(folder / "code_steps.csv").query("check == 'slv_height'")
    steps = steps[steps["mechanism"] == least["mechanism"]].set_index("symbol")["value"]
    assert steps["d_SLV"] == pytest.approx(d_slv, rel=1e-5)
    assert steps["T_SLV"] == pytest.approx(period, rel=1e-5)
    checks = pd.read_csv(folder / "code_checks.csv")
    assert checks["pga_demand_g"].unique() == pytest.approx([pga_g], rel=1e-5)


def psa_g(motion, period_s):
    """5 % pseudo-acceleration by steps of a tenth of the sample, central differences [g]."""
    record = motion.record
    n = len(record.acceleration_m_s2)
    time = np.arange(0.0, (n - 1) * record.dt_s, min(record.dt_s, period_s / 40.0) / 4.0)
    ground = np.interp(time, record.dt_s * np.arange(n), record.acceleration_m_s2)
    w, h = 2.0 * math.pi / period_s, time[1]
    u, last, most = 0.0, 0.0, 0.0
    for a in ground:
        ahead = (h**2 * (-a - w**2 * u) + 2.0 * u - last * (1.0 - 0.05 * w * h)) / (
            1.0 + 0.05 * w * h
        )
        last, u = u, ahead
        most = max(most, abs(u))
    return w**2 * most / G


def test_the_motions_are_scaled_to_the_demand(folder):
    """PGA is factor × the record's peak, and the mean spectrum is that of the scaled motions."""
    motions = pd.read_csv(folder / "selected_motions.csv")
    spectra = pd.read_csv(folder / "selected_spectra.csv")
    assert len(motions) == 7
    known = {row.record: Motion.named(row.record, TABLE) for row in motions.itertuples()}
    for row in motions.itertuples():
        peak = np.abs(known[row.record].record.acceleration_m_s2).max() / G
        assert row.pga_g == pytest.approx(row.factor * peak, rel=1e-5)
    for row in spectra.iloc[[5, 20]].itertuples():
        assert row.target_g == pytest.approx(ground_g(row.period_s, 0.05), rel=1e-5)
        own = [m.factor * psa_g(known[m.record], row.period_s) for m in motions.itertuples()]
        assert row.mean_g == pytest.approx(np.mean(own), rel=5e-3)


def test_the_dynamic_check_of_the_part_is_that_of_its_histories(folder):
    """Displacements in metres are d/b times b; the verdict follows from d0 and their mean."""
    rows = pd.read_csv(folder / "parts_check_W1_histories.csv")
    motions = pd.read_csv(folder / "selected_motions.csv").set_index("record")["pga_g"]
    assert set(rows["part"]) == {f"above_{FOOT}", f"from_0.0_to_{FOOT}"}
    rows = rows[rows["part"] == f"above_{FOOT}"]
    assert rows.set_index("record")["pga_g"].to_dict() == pytest.approx(motions.to_dict())
    for row in rows.itertuples():
        assert row.d_m == pytest.approx(B * row.d_over_b, rel=1e-5)
    one = rows.sort_values("d_over_b").iloc[len(rows) // 2]
    own = history(the_part("W1"), Motion.named(one["record"], TABLE), "neg", one["pga_g"])
    assert min(own.d_over_b, 1.0) == pytest.approx(one["d_over_b"], rel=0.02)  # digits of the PGA
    (found,) = (
        pd.read_csv(folder / "parts_check_W1.csv").query("part == @rows.part.iloc[0]").itertuples()
    )
    tall = H - FOOT
    d0 = tall * math.sin(math.atan(B / tall))
    over = (rows["status"] == "overturned") | (rows["d_m"] > d0)
    assert found.exceed_d0 == over.sum()
    assert found.mean_d_m == pytest.approx(rows["d_m"].mean(), rel=1e-5)
    assert (found.d0_m, found.d_slv_m) == pytest.approx((d0, 0.4 * d0), rel=1e-5)
    assert found.slv == (over.sum() == 0 and rows["d_m"].mean() <= 0.4 * d0)


def test_yade_agrees_on_the_mechanism_and_model_that_decide(folder):
    yade = pd.read_csv(folder / "dynamic_check_yade.csv")
    names = [f"{kind}_check_{m}.csv" for kind in ("parts", "dynamic") for m in ("W1", "W2")]
    checks = pd.concat([pd.read_csv(folder / name) for name in names])
    lost = checks if checks["slv"].all() else checks[~checks["slv"]]
    worst = lost.iloc[(lost["mean_d_m"] / lost["d_slv_m"]).argmax()]
    assert {*zip(yade["model"], yade["part"], strict=True)} == {(worst["model"], worst["part"])}
    assert list(yade["which"]) == ["nearest", "worst"]
    case, ends = the_part(worst["model"]), []
    for row in yade.itertuples():
        near = run_by("planar", case, Motion.named(row.record, TABLE), row.direction)
        found = near.run(row.pga_g * np.linspace(0.99, 1.01, 9), scatter=False)
        ends.append(tuple(sorted(set(found["status"]))))
        # no history that turns on its last digits: its peak grows by no more than 2.5 % for 1 %
        assert (B * found["d_over_b"]).to_numpy() == pytest.approx(row.d_m, rel=0.025)
        assert row.d_yade_m == pytest.approx(row.d_m, rel=0.01)
        assert row.status_yade == ends[-1][0]
    assert ends == [("ok",), ("overturned",)]


def passes(given, motions):
    """Whether W1 passes by hand, and shaken: checks and histories as of any façade."""
    settings, demand = study_settings(given), CodeDemand(AG, F0, TC_STAR, "B")
    known = {one.part: one for one in family_of(settings, demand).all()}
    ranked = governing(known.values(), settings, demand)
    of_case = {key: given[key] for key in ("facade", "smdof", "damping")}
    case, within = study_case("W1", of_case), settings["assessment"]["shaken_within"]
    table = chosen(ranked, [case], demand.pga_g, within)
    assert (table["shaken"] == 1).sum() >= 2

    def held():
        for row, part in cases(case, table):
            limits = limits_of(known[row.part].mechanism)
            yield verdict(checked(part.sections, motions, ["neg"], limits, 0), limits, 1)["slv"]

    return ranked[0][0] >= demand.pga_g and all(held())


def test_with_the_rows_it_passes_and_with_95_per_cent_of_the_least_force_it_does_not(folder):
    """The rows as their file has them; the search has no part in what is said of them."""
    after, found = (pd.read_csv(folder / f"ties{name}.csv") for name in ("_mechanisms", ""))
    assert len(after)
    assert not after["beyond"].any()
    assert (found["relied"] == "W1").all()
    assert (found["force_built_kn"] >= found["margin"] * found["force_kn"] - 1e-6).all()
    assert (found["anchor_load_kn"] <= found["anchor_kn"]).all()
    table = pd.read_csv(folder / "selected_motions.csv")
    motions = [(Motion.named(r.record, TABLE), r.pga_g) for r in table.itertuples()]
    stated, tied = yaml.safe_load(CONFIG), yaml.safe_load((folder / "ties.yaml").read_text())
    rows = tied["facade"]["ties"]
    assert len(rows) > len(stated["facade"]["ties"])
    longest_s = pd.read_csv(folder / "selected_spectra.csv")["period_s"].max()
    assert tied["assessment"]["match_high_s"] == pytest.approx(longest_s, rel=1e-5)
    least = (found["force_kn"] / found["force_built_kn"]).to_list()

    def with_rows(factors):
        both = zip(rows[1:], factors, strict=True)
        added = [{**r, "diameter_mm": f**0.5 * r["diameter_mm"]} for r, f in both]
        return {**stated, "facade": {**stated["facade"], "ties": [*rows[:1], *added]}}

    assert not passes(stated, motions)
    assert passes(with_rows([1.0] * len(least)), motions)
    assert not passes(with_rows([0.95 * f for f in least]), motions)


def test_a_motion_fells_the_facade_where_it_fells_a_part(folder):
    """The façade's collapse PGA is the least of its mechanisms', and lognormal statistics of it."""
    every = pd.read_csv(folder / "parts_collapse_W1.csv")
    parts = every[every["part"] == f"above_{FOOT}"].set_index("record")
    whole = pd.read_csv(folder / "collapse_W1.csv").set_index("record")
    least = np.fmin(every.groupby("record")["pga_median_g"].min(), whole["pga_median_g"])
    (row,) = pd.read_csv(folder / "dynamic.csv").query("model == 'W1'").itertuples()
    assert row.least_pga_g == pytest.approx(least.min())
    assert row.fell_at_demand == (least <= ground_g(0.0, 0.05)).sum()
    assert not least.isna().any()
    assert row.median_pga_g == pytest.approx(np.exp(np.log(least).mean()), rel=1e-4)
    assert row.dispersion == pytest.approx(np.log(least).std(ddof=0), rel=1e-3)
    assert (parts["pga_median_g"] < whole["pga_median_g"].fillna(9.0)).all()


def half_said(row):
    """Half collapse, or that most motions felled another mechanism before."""
    return "later" if row.never_collapsed > 0.5 * row.curves else f"{row.median_pga_g:.3g}"


def test_the_table_of_mechanisms_has_every_model_of_the_run(folder):
    """Each shaken mechanism: by hand, then held or not and half collapse under each model."""
    shaken = pd.read_csv(folder / "shaken.csv").query("shaken == 1")
    half = pd.read_csv(folder / "parts_dynamic.csv")
    models = ["W1", "W2"]
    wanted = {(part, model) for part in shaken["part"] for model in models}
    assert len(wanted) == 6
    assert set(zip(half["part"], half["model"], strict=True)) == wanted
    checks = [
        pd.read_csv(folder / f"{kind}_check_{m}.csv")
        for kind in ("parts", "dynamic")
        for m in models
    ]
    held = pd.concat(checks).set_index(["part", "model"])["slv"]
    text = html.unescape((folder / "report.html").read_text("utf-8"))
    rows = [re.sub("<[^>]+>", "|", row) for row in re.findall("(?s)<tr.*?</tr>", text)]
    for one in shaken.itertuples():
        cells = [
            f"{'held' if held[one.part, row.model] else 'not held'}; {half_said(row)}"
            for row in half[half["part"] == one.part].itertuples()
        ]
        assert any(one.mechanism in row and all(f"|{c}|" in row for c in cells) for row in rows)


def test_the_report_says_the_worst_of_both(folder):
    text = (folder / "report.html").read_text("utf-8")
    least = pd.read_csv(folder / "mechanisms.csv").iloc[0]
    verdict = "passes" if least["pga_fails_g"] >= ground_g(0.0, 0.05) else "fails"
    assert f"The façade {verdict} the non-linear kinematic check" in text
    assert f"part above {FOOT:.2f} m (tie)" in text
    names = [f"{kind}_check_{m}.csv" for kind in ("parts", "dynamic") for m in ("W1", "W2")]
    held = pd.concat(pd.read_csv(folder / name) for name in names).groupby("model")["slv"].all()
    lost = [model for model, every in held.items() if not every]
    dynamic = "is not fulfilled" if lost else "is fulfilled"
    assert f"of the 3 mechanisms that were shaken {dynamic}." in text
    how = "is lost under recorded motions; by hand it is kept" if lost else "is kept"
    how = "is lost at" if verdict == "fails" else how
    word = "passes" if how == "is kept" else "does not pass"
    assert f"the façade {word}: life safety (SLV) {how} " in text


def test_housners_velocity_and_intensity_once(folder):
    """V of the free block, and the mean pseudo-velocity of the demand's spectrum."""
    alpha, radius = math.atan(B / H), 0.5 * math.hypot(B, H)
    lift = radius * (1.0 - math.cos(alpha))
    needed = math.sqrt(8.0 * 9.81 * lift / 3.0) / math.cos(alpha)
    t = np.linspace(0.1, 2.5, 2000)
    v = np.array([ground_g(x, 0.05) * G * x / (2.0 * math.pi) for x in t])
    given = cumulative_trapezoid(v, t)[-1] / 2.4
    row = pd.read_csv(folder / "code_checks.csv").query("check == 'housner'").iloc[0]
    assert (row["capacity"], row["demand"]) == pytest.approx((needed, given), rel=2e-3)
    assert row["pga_fails_g"] == pytest.approx(ground_g(0.0, 0.05) * needed / given, rel=2e-3)


def test_an_italian_report_has_the_same_numbers_and_computes_nothing_anew(italian):
    """Numbers of the page's tables with the decimal comma set back; files but its own are kept."""
    english, other, made = italian
    assert made == {"values.csv"}
    swapped = str.maketrans(",.", ".,")
    cells = '<td class="number">([^<]*)<'
    numbers = [re.findall(cells, text) for text in (english, other)]
    assert len(numbers[0]) > 200
    own = [text for text in numbers[0] if text.count(".") < 2]  # no numbers of formulas
    assert [text.translate(swapped) for text in numbers[1] if text.count(".") < 2] == own
    assert '<html lang="it">' in other
    assert "Ada" in other


def test_an_italian_report_has_no_english_but_names(italian):
    """Words of the page and its pictures, without keys, files and what the records' files say."""
    text = html.unescape(re.sub("<wbr>", "", italian[1]))
    pictures = re.findall("data:image/svg[+]xml;base64,([A-Za-z0-9+/=]+)", text)
    drawn = " ".join(base64.b64decode(one).decode() for one in pictures)
    drawn = " ".join(re.findall("<text[^>]*>([^<]*)<", drawn))
    assert "spostamento" in drawn
    body = re.sub("(?s)<style>.*?</style>|<p>Fonte.*?</p>", "", text)
    body = re.sub(">it<", "><", body)  # the value of assessment.language
    body = NAMES.sub(" ", re.sub("<[^>]+>", " ", body) + drawn)
    words = {word.lower() for word in re.findall(r"\b[A-Z]?[a-zà-ù]+\b", body)}
    assert words & ENGLISH_WORDS == set()
