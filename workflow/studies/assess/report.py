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
    national,
    pictures,
    ties_said,
    verdict,
    walls,
)
from studies.assess.checks import LEAST_KNOWN
from studies.assess.names import not_asked
from studies.assess.paper import Picture
from studies.assess.sites import WHOLE_PART
from studies.assess.verdict import g3, per_cent, powered
from yade_scripts.model.registry import MODELS

WIDE_MM, HIGH_MM = 176.0, 78.0  # of the drawing
NOT_COVERED = (
    "Failure in the façade's own plane, masonry that falls apart or crushes, foundations, what "
    "pushes from neighbours, what one mechanism does to another; of ties the walls they end in. "
    "Formulas of the codes were read in a transcription (appendix D): compare them with the text."
)


def context(data, digest):
    """All that the template shows, of `appendix.Data` and the digest of the evidence."""
    own, t = data.config["assessment"], data.tables
    motions, motions_said = appendix.motions(data)
    return {
        "title": f"{own['title'] or data.run}: out-of-plane assessment",
        "engineer": own["engineer"],
        "registration": own["registration"],
        "date": ", ".join(filter(None, (own["place"], own["date"]))),
        "program": data.program,
        "who": who(data),
        "verdict": verdict.headline(
            t["code_checks"],
            t["mechanisms"],
            t["verdicts"],
            t["shaken"],
            when(own),
            data.factor,
            data.config["facade"],
            data.fit,
        ),
        "drawing": drawing(data),
        "answers": [
            ("Which ties?", ties_said.answer(data)),
            ("How far?", capacity_said(data)),
            ("How often?", rate_said(data)),
            *(("Which first?", first) for first in [building_first.said(data)] if first),
            ("Not covered", f"{NOT_COVERED} {not_asked(own['mechanisms'])}".strip()),
        ],
        "rests_on": rests_on(data),
        "mechanisms": content.by_mechanism(data),
        "next_steps": next_steps(data),
        "hand": appendix.by_hand(data, data.weakest),
        "capacity": Picture(
            partial(pictures.capacity, t["capacity_curve"], t["mechanisms"]),
            46.0,
            "Capacity curve. d_SLV is the least of 0.4 d0 and of where a tie or an anchor gives "
            "way and takes more than half of the capacity.",
            "The multiplier falls to zero at d0.",
            f"{data.folder}/capacity_curve.csv",
        ),
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
        "formulas": appendix.formulas(),
        "stated": appendix.stated(data),
        "evidence": kept(data, digest),
    }


def who(data):
    """Line of client, place, run and program."""
    own = data.config["assessment"]
    known = [("Client", own["client"]), ("Place", own["place"]), ("Run", data.run)]
    said = [f"{name}: {value}" for name, value in known if value]
    return " · ".join([*said, f"{data.program}, commit {data.commit}"])


def when(own):
    """What the demand is, to begin a sentence with."""
    stated = own["spectrum"] or (own["ag_g"] is not None)
    if stated and not own["hazard"]:
        return "Under the stated demand"
    return f"For a return period of {own['return_period_years']:g} years"


def drawing(data):
    """Picture of elevation and section with all measures."""
    high_mm = drawings.height_mm(data.family, WIDE_MM, HIGH_MM)
    facade = data.config["facade"]
    marks = "Crosses: ties. " * bool(facade["ties"]) + "Dashed: floors. " * bool(facade["floors"])
    return Picture(
        partial(drawings.facade, data.family, data.weakest, WIDE_MM, HIGH_MM),
        high_mm,
        f"To scale, in metres. {marks}Dashed outline: the mechanism that fails first, turned by "
        "half of the rotation at which it falls.",
        drawings.words(data.family, data.weakest),
        "",
        WIDE_MM,
    )


def capacity_said(data):
    """ζE, the return period of the capacity, and what the dynamic check says of it."""
    t = data.tables
    stated = verdict.as_stated(t["mechanisms"])
    years = national.return_period_of(data.config["assessment"], stated["pga_fails_g"].iloc[0])
    said = verdict.capacity(stated, data.demand_g, years)
    if verdict.passes(t["code_checks"], t["mechanisms"], t["verdicts"])[1] is False:
        said += " The dynamic check is not fulfilled at the demand, so its own capacity is less."
    return said


def rate_said(data):
    """The rate of collapse in one sentence."""
    every, relied = data.tables["rate"], data.relied
    rates = every[every["model"] == relied]
    if rates.empty:
        return verdict.no_rate(data.tables["dynamic"], data.config)
    said = [
        f"{powered(r.annual_rate)} collapses a year by {r.hazard} (95 % {powered(r.rate_low)} to "
        f"{powered(r.rate_high)}), {100 * r.probability:.2g} % in {r.years:g} years"
        for r in rates.itertuples()
    ]
    first = every[every["hazard"] == every["hazard"].iloc[0]]
    others = [
        f"{powered(r.annual_rate)} with {r.model}" for r in first.itertuples() if r.model != relied
    ]
    beside = f" ({verdict.words_of(others)})" if others else ""
    return (
        f"With {relied}: {'; '.join(said)}{beside}, as it stands, without further ties."
        f"{left_out(data)}{friction_said(data)}"
    )


def left_out(data):
    """Sentence on the mechanisms that the rate leaves out, with a bound; nothing without any."""
    table = data.tables["rate_left_out"]
    own = table[table["model"] == data.relied]
    own = own[own["hazard"] == own["hazard"].iloc[0]] if len(own) else own
    if own.empty:
        return ""
    some = "one mechanism that was" if len(own) == 1 else f"{len(own)} mechanisms that were"
    return (
        f" It leaves out {some} not shaken: at most {powered(own['rate_bound'].sum())} more, "
        "if they fall no earlier, against their check by hand, than those that were."
    )


def friction_said(data):
    """Sentence on what the friction of floors would change; nothing where no floor holds by it."""
    table = data.tables["friction"]
    if table.empty:
        return ""
    row = next(table.itertuples())
    word = "With" if row.friction else "Without"
    share = "".join(verdict.collapses(row)) if row.probability == row.probability else ""
    rate = getattr(row, "annual_rate", float("nan"))
    said = [f"{powered(rate)} a year"] if rate == rate else []
    said += [f"collapse at the demand {share}"] if share else []
    if row.checked:
        said.append(f"{row.not_held:.0f} of {row.checked:.0f} dynamic checks not held")
    return f" {word} the friction of floors that is stated ({row.model}): {', '.join(said)}."


def rests_on(data):
    """Lines: demand, models, and what is left out."""
    f, t = data.config["facade"], data.tables
    courses = f["courses"]
    stack = f"a stack of {courses} elastic courses" if courses else "a rigid part"
    names = list(t["dynamic"]["model"])
    meanings = "; ".join(f"{name}: {moved(name, names)}" for name in names)
    rests = ""
    if len(names) > 1:
        rests = f" The verdict is that of the worst of them; ties and rate rest on {data.relied}."
    whole = t["parts_dynamic"][t["parts_dynamic"]["part"] == WHOLE_PART]
    return [
        f"The demand is {data.demand_said}, a PGA of {g3(data.demand_g)} g.",
        f"Models of how the return walls move behind the façade. {meanings}.{rests}",
        f"{'By hand the' if courses else 'The'} façade is rigid blocks of "
        f"{f['density_kg_m3']:g} kg/m³ on dry joints; it does not crush or fall "
        "apart, and the mechanisms know ties and anchors but no friction of floors.",
        "Every part turns over the whole width, but for corners, horizontal bending and parts of "
        "the width. Corners end at the eaves and take the return wall as one without openings.",
        f"In the dynamic models each mechanism is {stack} on the building, or two rigid parts that "
        "bend, and leans on the return walls behind it"
        + content.floors_said(f["floors"], data.config["assessment"]["floor_friction"]),
        "The Circolare was read in a public transcription with page numbers, EN 1998-3 at second "
        "hand (appendix D). No percentage of New Zealand's new building standard is given: its "
        "rocking check by displacements could not be read, and the force check of NZS 1170.5 says "
        "where rocking begins, not where a wall falls (code_checks.csv has it).",
        f"Confidence factor FC = {data.factor:g}.",
        *early_said(t["mechanisms"]),
        *beta_said(data),
        *words.remarks(data.config, whole),
    ]


def early_said(mechanisms):
    """Line on ties and anchors that give way early, where there are any."""
    if not (verdict.as_stated(mechanisms)["links_left_out"] > 0).any():
        return []
    return [
        "A tie or an anchor that gives way before 0.4 d0 and takes more than half of the capacity "
        "with it sets d_SLV by the letter of C8.7.1.2.1.6. The same paragraph asks for 0.4 d0 of a "
        "curve with those actions alone that last until collapse, and a link that only pulls back "
        "never lowers the curve (C8.7.1.1). So the check by hand is made without the link too, and "
        "the larger PGA counts. Motions shake the façade with the link, and C8.7.1.2.1.6 takes the "
        "lesser of the two d_SLV: the dynamic check is held to it, and the table of that check "
        "states the larger one beside it."
    ]


def beta_said(data):
    """Line on a damping law outside of what it was fitted to, with what β does to the answer."""
    beyond = walls.beyond_law(data.config)
    if not beyond:
        return []
    found = walls.ranges_of(data.tables["dynamic_sensitivity"], walls.BETA)
    does = "; ".join(f"{factor:g} times β, {ratio:.2f} times" for factor, ratio in found)
    said = f" In the median half collapse moves: {does} the PGA." if does else ""
    return [
        f"Contact damping β is that of eq. 5, fitted to other walls: this one is {beyond}.{said}"
    ]


def moved(name, names):
    """How a model's return walls move, without reference to a model that is not among `names`."""
    model = MODELS[name]
    if model.chain and model.two_way and model.one_way_model not in names:
        return "they move with the building, whose mass the façade can push"
    return model.moved


def next_steps(data):
    """Lines of what is recommended next."""
    t, own = data.tables, data.config["assessment"]
    worse = advice.damage(t["code_sensitivity"], t["mechanisms"], data.demand_g)
    known = ""
    if data.factor != own["confidence_factor"]:
        known = (
            "Give assessment.hinge_inset_m, from the masonry's compressive strength, to be allowed "
            f"the stated confidence factor {own['confidence_factor']:g} instead of {LEAST_KNOWN}."
        )
    misfit = ""
    if data.fit is not None and not data.fit[2]:
        misfit = (
            "Give more records (records_table): the mean spectrum of the chosen motions does not "
            "fit the demand within the code's bounds, so their check is not yet that of the code."
        )
    given = t["code_checks"], t["mechanisms"], t["verdicts"], t["shaken"]
    thinner = advice.thinner_is_better(t["code_sensitivity"])
    return advice.next_steps(*given, worse, thinner, known, misfit)


def fragility(data):
    """Picture of the collapse probability; None where motions are too few."""
    t = data.tables
    if not len(t["dynamic_curves"]):
        return None
    return Picture(
        partial(pictures.fragility, t["dynamic_curves"], t["dynamic"], t["mechanisms"]),
        48.0,
        "Probability of collapse with 95 % bands; mark: PGA at which the SLV check fails. "
        + verdict.suite(t["dynamic"], t["shaken"]["shaken"].sum() > 1),
        "; ".join(
            f"{r.model}: half collapse at {g3(r.median_pga_g)} g" for r in t["dynamic"].itertuples()
        ),
        f"{data.folder}/dynamic_curves.csv",
    )


def spectra(data):
    """Picture of the demand on ground and floor."""
    return Picture(
        partial(pictures.spectra, data.tables["spectra"]),
        60.0,
        f"Elastic spectra of 5 % at a PGA of {g3(data.demand_g)} g: the demand, the Circolare's "
        "floor spectrum where the weakest mechanism is held, and the building's chain under the "
        "run's motions scaled to that PGA.",
        "Ground, floor by formula, floor by the chain.",
        f"{data.folder}/spectra.csv",
    )


def kept(data, digest):
    """Lines that cite the evidence."""
    place = f"{data.folder}/evidence/{digest[: evidence.DIGITS]}"
    histories = int(data.tables["dynamic"]["histories"].sum())
    verdicts = data.tables["verdicts"]
    worst = f" Least agreement: {per_cent(verdicts['agree'].min())}." if len(verdicts) else ""
    return [
        f"Configuration with every key, table of motions, digests of their files, the site's "
        f"files, every table behind a number above, and program with version are in {place}/, "
        "with this report. No later command rewrites that folder.",
        f"Its {evidence.LIST} lists the SHA-256 of every file behind this report and has itself "
        f"the SHA-256 {digest}. `sha256sum -c {evidence.SUMS}` there checks these files and the "
        "report.",
        f"Behind the collapse probabilities stand {histories} histories by the planar "
        f"solver.{worst}",
    ]
