"""What the assessment report says on its first pages, and all that its template shows."""

from functools import partial

from rocking.formula import words

from studies.assess import (
    advice,
    appendix,
    building_first,
    content,
    drawings,
    evidence,
    names,
    national,
    pictures,
    ties_said,
    verdict,
    walls,
)
from studies.assess.checks import LEAST_KNOWN
from studies.assess.paper import Picture
from studies.assess.sites import WHOLE_PART
from yade_scripts.model.registry import MODELS

WIDE_MM, HIGH_MM = 176.0, 78.0  # of the drawing


def context(data, digest):
    """All that the template shows, of `appendix.Data` and the digest of the evidence."""
    assessment, say, t = data.config["assessment"], data.say, data.tables
    about = {
        "when": verdict.when(assessment, say),
        "factor": data.factor,
        "wall": walls.named(data.facade, say),
    }
    motions, motions_said = appendix.motions(data)
    return {
        "say": say,
        "title": say("page.title", name=assessment["title"] or data.run),
        "engineer": assessment["engineer"],
        "registration": assessment["registration"],
        "date": ", ".join(filter(None, (assessment["place"], assessment["date"]))),
        "program": data.program,
        "who": who(data),
        "verdict": verdict.headline(t, about, data.fit, say),
        "drawing": drawing(data),
        "answers": answers(data),
        "rests_on": rests_on(data),
        "mechanisms": content.by_mechanism(data),
        "next_steps": next_steps(data),
        "hand": appendix.by_hand(data, data.weakest),
        "capacity": capacity(data),
        "spectrum": appendix.spectrum(data),
        "dynamic": content.dynamic_check(data),
        "ties": ties_said.section(data),
        "fragility": fragility(data),
        "suite": content.suite(data),
        "rate": content.rate(data),
        "sensitivity": content.sensitivity(data),
        "others": appendix.others(data),
        "checks": content.checks(data),
        "spectra": spectra(data),
        "motions": motions,
        "motions_said": motions_said,
        "formulas": appendix.formulas(say),
        "stated": appendix.stated(data),
        "evidence": kept(data, digest),
    }


def answers(data):
    """Questions of the first page, each with its answer."""
    say = data.say
    left = names.not_asked(data.config["assessment"]["mechanisms"], say)
    texts = {
        "ties": ties_said.answer(data),
        "far": capacity_said(data),
        "often": rate_said(data),
        "first": building_first.said(data),
        "not_covered": say("page.not_covered") + left,
    }
    return [(say(f"page.ask.{key}"), text) for key, text in texts.items() if text]


def who(data):
    """Line of client, place, run and program."""
    assessment, say = data.config["assessment"], data.say
    known = {"client": assessment["client"], "place": assessment["place"], "run": data.run}
    told = [say(f"page.who.{key}", value=value) for key, value in known.items() if value]
    program = say("page.who.program", program=data.program, commit=data.commit)
    return " · ".join([*told, program])


def drawing(data):
    """Picture of elevation and section with all measures."""
    say, facade = data.say, data.facade
    marks = {(True, True): "both", (True, False): "ties", (False, True): "floors"}
    key = marks.get((bool(facade.ties), bool(facade.floors)), "plain")
    return Picture(
        partial(drawings.facade, say, data.family, data.weakest, (WIDE_MM, HIGH_MM)),
        drawings.height_mm(data.family, WIDE_MM, HIGH_MM),
        say(f"page.drawing.{key}"),
        drawings.words(say, data.family, data.weakest),
        "",
        WIDE_MM,
    )


def capacity(data):
    """Picture of the capacity curves."""
    say, t = data.say, data.tables
    draw = partial(pictures.capacity, say, t["capacity_curve"], t["mechanisms"], data.names)
    told = say("page.capacity"), say("page.capacity_words")
    return Picture(draw, 46.0, *told, f"{data.folder}/capacity_curve.csv")


def capacity_said(data):
    """ζE, the return period of the capacity, and what the dynamic check says of it."""
    t, say = data.tables, data.say
    stated = verdict.as_stated(t["mechanisms"])
    period = national.return_period_of(data.config["assessment"], stated["pga_fails_g"].iloc[0])
    told = verdict.capacity(stated, data.demand_g, period, say)
    if verdict.passes(t["code_checks"], t["mechanisms"], t["verdicts"])[1] is False:
        told += say("verdict.capacity.less")
    return told


def rate_said(data):
    """The rate of collapse in one sentence."""
    every, relied, say = data.tables["rate"], data.relied, data.say
    rates = every[every["model"] == relied]
    if rates.empty:
        return verdict.no_rate(data.tables["dynamic"], data.config, say)
    each = []
    for r in rates.itertuples():
        ends = {"rate": r.annual_rate, "low": r.rate_low, "high": r.rate_high}
        share = {"percent": 100 * r.probability, "years": r.years}
        each.append(say("page.rate.of_hazard", hazard=r.hazard, **ends, **share))
    first = every[every["hazard"] == every["hazard"].iloc[0]]
    others = [
        say("page.rate.other", rate=r.annual_rate, model=r.model)
        for r in first.itertuples()
        if r.model != relied
    ]
    beside = say("page.rate.others", each=say.all_of(others)) if others else ""
    told = say("page.rate.line", model=relied, each="; ".join(each), others=beside)
    return told + left_out(data) + friction_said(data)


def left_out(data):
    """Sentence on the mechanisms that the rate leaves out, with a bound; nothing without any."""
    table = data.tables["rate_left_out"]
    rows = table[table["model"] == data.relied]
    rows = rows[rows["hazard"] == rows["hazard"].iloc[0]] if len(rows) else rows
    if rows.empty:
        return ""
    bound = rows["rate_bound"].sum()
    return " " + data.say.count("page.rate.left_out", len(rows), rate=bound)


def friction_said(data):
    """Sentence on what the friction of floors would change; nothing where no floor holds by it."""
    table, say = data.tables["friction"], data.say
    if table.empty:
        return ""
    row, each = next(table.itertuples()), []
    rate = getattr(row, "annual_rate", float("nan"))
    if rate == rate:
        each.append(say("page.friction.rate", rate=rate))
    if row.probability == row.probability:
        share = "".join(verdict.collapses(row, say, bare=True))
        each.append(say("page.friction.collapse", share=share))
    if row.checked:
        each.append(say("page.friction.checks", lost=row.not_held, of=row.checked))
    key = "page.friction.with" if row.friction else "page.friction.without"
    return say(key, model=row.model, each=", ".join(each))


def rests_on(data):
    """Lines: demand, models, and what is left out."""
    t, say = data.tables, data.say
    courses, models = data.facade.courses, list(t["dynamic"]["model"])
    each = [say("page.rests.model", model=name, moves=moved(name, models, say)) for name in models]
    if len(models) > 1:
        moving = say("page.rests.models_worst", each="; ".join(each), model=data.relied)
    else:
        moving = say("page.rests.models", each="; ".join(each))
    floors = floors_said(data.facade.floors, data.config["assessment"]["floor_friction"], say)
    if courses:
        shaken = say("page.rests.shaken_courses", courses=courses, floors=floors)
    else:
        shaken = say("page.rests.shaken_block", floors=floors)
    whole = t["parts_dynamic"][t["parts_dynamic"]["part"] == WHOLE_PART]
    return [
        say("page.rests.demand", demand=data.demand_said, pga_g=data.demand_g),
        moving,
        *building_said(models, data.config["smdof"]["base_shear_ratio"], say),
        say(f"page.rests.{'courses' if courses else 'blocks'}", density=data.facade.density_kg_m3),
        say("page.rests.width"),
        shaken,
        say("page.rests.read"),
        say("page.rests.factor", factor=data.factor),
        *early_said(t["mechanisms"], say),
        *beta_said(data),
        *formula_said(words.outliers(data.config, whole), say),
    ]


def building_said(models, ratio, say):
    """Line on what the building behind the façade does, where a model has one."""
    if not any(MODELS[name].chain for name in models):
        return []
    return [say("page.rests.yields", ratio=ratio) if ratio else say("page.rests.elastic")]


def floors_said(floors, counts, say):
    """End of the sentence on the dynamic models: what their floors hold by, if friction counts."""
    rubbing = sorted({row.friction for row in floors if row.load_kn and row.friction})
    if not rubbing:
        return say("page.rests.floors_none")
    friction = say.all_of(say.number(mu, "g") for mu in rubbing)
    key = "page.rests.floors_count" if counts else "page.rests.floors_left_out"
    return say(key, friction=friction)


def early_said(mechanisms, say):
    """Line on ties and anchors that give way early, where there are any."""
    early = (verdict.as_stated(mechanisms)["links_left_out"] > 0).any()
    return [say("page.rests.early")] if early else []


def beta_said(data):
    """Line on a damping law outside of what it was fitted to, with what β does to the answer."""
    say = data.say
    beyond = say.all_of(
        say(f"page.rests.{key}", **v)
        for key, v in walls.beyond_law(data.facade, data.config["damping"]["law"])
    )
    if not beyond:
        return []
    each = [
        say("page.rests.beta_times", factor=factor, ratio=ratio)
        for factor, ratio in walls.ranges_of(data.tables["dynamic_sensitivity"], walls.BETA)
    ]
    if not each:
        return [say("page.rests.beta", beyond=beyond)]
    return [say("page.rests.beta_does", beyond=beyond, each="; ".join(each))]


def formula_said(outliers, say):
    """Lines on computed medians outside of what the formula allows (`words.outliers`)."""
    return [
        say(
            f"page.rests.formula_{'more' if outlier.computed_g > outlier.high_g else 'less'}",
            model=outlier.model,
            computed_g=outlier.computed_g,
            low_g=outlier.low_g,
            high_g=outlier.high_g,
        )
        for outlier in outliers
    ]


def moved(name, models, say):
    """How a model's return walls move, without reference to a model that is not among `models`."""
    model = MODELS[name]
    if not model.chain:
        return say("page.moves.ground")
    if not model.two_way:
        return say("page.moves.floors")
    if model.one_way_model in models:
        return say("page.moves.as", model=model.one_way_model)
    return say("page.moves.pushed")


def next_steps(data):
    """Lines of what is recommended next."""
    t, assessment, say = data.tables, data.config["assessment"], data.say
    known, misfit = "", ""
    if data.factor != assessment["confidence_factor"]:
        known = say("advice.confidence", stated=assessment["confidence_factor"], used=LEAST_KNOWN)
    if data.fit is not None and not data.fit[2]:
        misfit = say("advice.misfit")
    worse = advice.damage(t["code_sensitivity"], t["mechanisms"], data.demand_g, say)
    return advice.next_steps(t, worse, known, misfit, say=say)


def fragility(data):
    """Picture of the collapse probability; None where motions are too few."""
    t, say = data.tables, data.say
    if not len(t["dynamic_curves"]):
        return None
    suite = verdict.suite(t["dynamic"], t["shaken"]["shaken"].sum() > 1, say)
    half = [
        say("page.fragility_words", model=r.model, pga_g=r.median_pga_g)
        for r in t["dynamic"].itertuples()
    ]
    return Picture(
        partial(pictures.fragility, say, t["dynamic_curves"], t["dynamic"], t["mechanisms"]),
        48.0,
        say("page.fragility", suite=suite),
        "; ".join(half),
        f"{data.folder}/dynamic_curves.csv",
    )


def spectra(data):
    """Picture of the demand on ground and floor."""
    say = data.say
    return Picture(
        partial(pictures.spectra, say, data.tables["spectra"]),
        60.0,
        say("page.spectra", pga_g=data.demand_g),
        say("page.spectra_words"),
        f"{data.folder}/spectra.csv",
    )


def kept(data, digest):
    """Lines that cite the evidence."""
    say, verdicts = data.say, data.tables["verdicts"]
    place = f"{data.folder}/evidence/{digest[: evidence.DIGITS]}"
    about = {"histories": int(data.tables["dynamic"]["histories"].sum())}
    if len(verdicts):
        behind = say("page.evidence.agreement", **about, share=verdicts["agree"].min())
    else:
        behind = say("page.evidence.histories", **about)
    cited = {"list": evidence.LIST, "sums": evidence.SUMS, "digest": digest}
    cited["motions"] = f"{place}/{evidence.MOTIONS}"
    return [
        say("page.evidence.folder", place=place),
        say("page.evidence.digest", **cited),
        behind,
    ]
