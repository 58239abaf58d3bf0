"""The report's data, and its appendix: mechanisms by hand, motions, formulas, values, evidence."""

from dataclasses import dataclass, field

from studies.assess import byhand, names, verdict
from studies.assess.anchors import completed_settings
from studies.assess.catalogue import NOTHING, Catalogue, catalogue
from studies.assess.checks import LIMITS, confidence
from studies.assess.demand import eta, floor_demand
from studies.assess.family import Candidate, Family
from studies.assess.national import spectrum_of, stated_row
from studies.assess.paper import Table
from studies.assess.selection import fit_of
from studies.assess.sites import site_of
from studies.assess.slv import readings
from studies.assess.sources import FORMULAS
from studies.assess.values import DEFAULT, values
from yade_scripts.model.facades import Facade

STEPS = {  # of a check, by their symbols: keys of `step`, and of the formulas behind
    "T_SLV": ("secant", ("secant_slv",)),
    "T_max": ("period_largest", ()),
    "S_De": ("needed", ("largest", "at_height")),
    "a_g,SLD": ("pga_onset_least", ("onset",)),
    "a_g,SLV": ("pga_fails", ()),
}


@dataclass
class Data:
    """What a report is made of.

    `fit` and `range_s` are of the selected motions' mean, see `selection.fit_of`.
    """

    config: dict  # resolved
    given: list  # keys that the user stated
    tables: dict  # by file name; verdicts and yade of all models
    run: str
    demand_said: str  # in the report's language
    program: str
    commit: str
    folder: str  # where the tables are, for the sources
    say: Catalogue = field(init=False)
    names: dict = field(init=False)  # of mechanisms, by part
    facade: Facade = field(init=False)
    family: Family = field(init=False)
    weakest: Candidate = field(init=False)  # fails first by hand
    demand_g: float = field(init=False)  # PGA
    relied: str = field(init=False)  # model that the rate rests on
    fit: tuple | None = field(init=False)
    range_s: tuple = field(init=False)

    def __post_init__(self):
        """Find the weakest mechanism of the tables among the façade's."""
        t, assessment = self.tables, self.config["assessment"]
        self.say = catalogue(assessment["language"])
        stated = verdict.as_stated(t["mechanisms"])
        self.names = {row.part: names.name(row, self.say) for row in stated.itertuples()}
        self.config = completed_settings(self.config)
        self.facade = Facade.of(self.config["facade"])
        self.family = Family(self.config)
        self.weakest = self.candidate(next(stated.itertuples()))
        self.demand_g = t["code_checks"]["pga_demand_g"].iloc[0]
        self.relied = verdict.relied_on(t["dynamic"]["model"])
        self.fit, self.range_s = fit_of(t["selected_spectra"])

    def candidate(self, row):
        """Mechanism of a row of mechanisms.csv, without the links that are left out of it."""
        candidate = self.family.at(site_of(row))
        if not row.links_left_out:
            return candidate
        read = readings(candidate.mechanism)[int(row.links_left_out)]
        return candidate._replace(mechanism=read, letter=candidate.mechanism)

    @property
    def factor(self):
        """FC that the checks use."""
        assessment = self.config["assessment"]
        return confidence(assessment["confidence_factor"], assessment["hinge_inset_m"])


def _parts(rows, total, whole, say):
    """Table of the parts with their sums; `whole`: says what its columns are."""

    def six(value):
        return say.number(value, "six")

    cells = [
        (
            say(f"hand.part.{p.key}", **p.about),
            six(1e-3 * p.weight_n),
            NOTHING if p.y_m != p.y_m else say.number(p.y_m, ".4f"),
            say.number(p.z_m, ".4f"),
            *map(six, (p.out, p.up, p.square)),
            *map(six, (1e-3 * p.weight_n * v for v in (p.out, p.up, p.square))),
        )
        for p in rows
    ]
    sums = (1e-3 * v for v in (total.out_n, total.up_n, total.square_n))
    head = say("hand.part.sum"), six(1e-3 * total.weight_n)
    cells.append((*head, "", "", "", "", "", *map(six, sums)))
    symbols = ("P [kN]", "y [m]", "z [m]", "δx", "δz", "δx²", "P δx", "P δz", "P δx²")
    return Table(
        say("hand.parts.caption_whole" if whole else "hand.parts.caption"),
        (say("hand.parts.part"), *symbols),
        cells,
        (0.24, 0.08, 0.07, 0.08, 0.08, 0.08, 0.1, 0.09, 0.09, 0.09),
        "",
        (len(cells) - 1,),
    )


def _with(value, unit, say):
    """A value with its unit, four figures; a mass of tonnes in whole kilograms."""
    whole = unit == "kg" and value >= 1e3
    return f"{say.number(value, ',.0f' if whole else '.4g')} {unit}".strip()


def _holds(rows, say):
    """Table of what holds, with its work."""
    cells = [
        (
            say(f"hand.hold.{h.key}"),
            say.number(1e-3 * h.force_n, ".4g"),
            say.number(h.height_m, ".3f"),
            say("hand.holds.range", slack=1e3 * h.slack_m, reach=1e3 * h.reach_m),
            say.number(h.out, "six"),
            say.number(1e-3 * h.force_n * h.out, "six"),
        )
        for h in rows
    ]
    head = say("hand.holds.hold"), "F [kN]", "z [m]", say("hand.holds.pulls"), "δF", "F δF"
    return Table(say("hand.holds.caption"), head, cells, (0.3, 0.14, 0.14, 0.18, 0.12, 0.12))


def by_hand(data, candidate, whole=True):
    """One mechanism's name and tables: parts, holds, capacity, demand and verdict.

    Where `whole` they say how each number comes about; else they stand two in a row.
    """
    say = data.say
    name = names.name(candidate, say)
    if not candidate.plane:
        return {"name": name, "tables": [_by_strips(data, candidate)]}
    parts, holds = byhand.parts(data.family, candidate), byhand.pulled(candidate)
    total = byhand.sums(parts, holds)
    quantities = byhand.results(candidate, total, data.factor)
    rows = [
        (symbol, say(f"hand.how.{key}"), _with(value, unit, say))
        for symbol, key, value, unit in quantities
    ]
    rows += _demand_of(data, candidate)
    tables = [_parts(parts, total, whole, say), *([_holds(holds, say)] if holds else [])]
    if not whole:
        return {"name": name, "tables": [*tables, _paired(data, candidate, rows)]}
    symbol, fails_g = "PGA", _fails_g(data, candidate)
    told = say(f"hand.demand.{_passed(data, fails_g)}", demand_g=data.demand_g)
    rows.append((symbol, told, f"{say.number(fails_g, '.4g')} g"))
    results = Table(
        say("hand.results.caption", factor=data.factor),
        ("", say("hand.results.how"), say("hand.results.value")),
        rows,
        (0.14, 0.66, 0.2),
        f"{data.folder}/code_steps.csv",
        (len(rows) - 1,),
    )
    return {"name": name, "tables": [*tables, results]}


def _by_strips(data, candidate):
    """Table of capacity, demand and verdict of what does not turn over the whole width."""
    say, thrust = data.say, data.config["assessment"]["arch_thrust_kn"]
    stated = verdict.as_stated(data.tables["mechanisms"]).set_index("part")
    row = stated.loc[candidate.part]
    rows = [
        ("α0", "", say.number(row["multiplier"], ".4g")),
        ("M*", "", _with(row["participating_mass_kg"], "kg", say)),
        ("e*", "", say.number(row["e_star"], ".4g")),
        ("d0", "", f"{say.number(row['d0_m'], '.4g')} m"),
    ]
    told = say(f"mechanism.of_kind.{names.kind_of(candidate)}", thrust_kn=thrust or 0.0)
    return _paired(data, candidate, rows + _demand_of(data, candidate), f"{told} ")


def _paired(data, candidate, rows, before=""):
    """Table of symbols and values, three pairs in a row; the verdict stands in its caption."""
    say, pairs = data.say, [(symbol, value) for symbol, _, value in rows]
    third = -(-len(pairs) // 3)
    columns = [pairs[k * third : (k + 1) * third] for k in range(3)]
    cells = [
        tuple(word for c in columns for word in (c[k] if k < len(c) else ("", "")))
        for k in range(third)
    ]
    fails_g = _fails_g(data, candidate)
    about = {"pga_g": fails_g, "demand_g": data.demand_g}
    told = before + say(f"hand.verdict.{_passed(data, fails_g)}", **about)
    return Table(told, ("",) * 6, cells, (0.17, 0.16, 0.17, 0.17, 0.17, 0.16))


def _checked(data, candidate):
    """Steps of the non-linear SLV checks of a mechanism by place, each by symbol."""
    steps = data.tables["code_steps"]
    of_part = steps[steps["part"] == candidate.part]
    for check, place in (("slv_ground", "ground"), ("slv_height", "floor")):
        by_symbol = of_part[of_part["check"] == check].set_index("symbol")
        if len(by_symbol):
            yield place, by_symbol


def _fails_g(data, candidate):
    """PGA at which the non-linear SLV check of a mechanism fails [g], of ground and floor."""
    return min(float(steps.loc["a_g,SLV", "value"]) for _, steps in _checked(data, candidate))


def _passed(data, fails_g):
    return "passes" if fails_g >= data.demand_g else "fails"


def _demand_of(data, candidate):
    """Rows of the demand on a mechanism: symbol, how, value."""
    say, rows = data.say, []
    for place, steps in _checked(data, candidate):
        word = say(f"hand.demand.place.{place}")
        about = {"ground": {}, "floor": {"place": candidate.place}}[place]
        where = say(f"step.where.{place}", **about)
        for symbol, (key, formulas) in STEPS.items():
            given = {"secant": {"factor": LIMITS["SLV"][1]}, "needed": {"where": where}}
            how = say(f"step.{key}", **given.get(key, {}))
            if formulas:
                numbers = ", ".join(say(f"formula.{name}.number") for name in formulas)
                how = say("hand.demand.cited", how=how, numbers=numbers)
            step = steps.loc[symbol]
            value = f"{say.number(step['value'], '.4g')} {step['unit']}"
            rows.append((say("hand.demand.symbol", symbol=symbol, place=word), how, value))
    return rows


def _national(data):
    """Rows of the spectrum of NTC 2018 that is the demand; none where another one is."""
    assessment, say = data.config["assessment"], data.say
    if (
        assessment["spectrum"]
        or assessment["en_spectrum"]
        or (row := stated_row(assessment)) is None
    ):
        return []
    demand = spectrum_of(row, assessment["soil"], assessment["topography"])
    ss, st, tb, tc, td = demand.factors
    where = {"soil": assessment["soil"], "topography": assessment["topography"]}
    hazard = {"ag_g": row["ag_g"], "f0": row["f0"], "tc_s": row["tc_star_s"]}
    return [
        ("a_g, F0, T_C*", say("hand.spectrum.hazard", **hazard)),
        ("S_S, S_T", say("hand.spectrum.soil", ss=ss, st=st, **where)),
        ("T_B, T_C, T_D", say("hand.spectrum.periods", tb=tb, tc=tc, td=td)),
        ("PGA", say("hand.spectrum.pga", pga_g=demand.pga_g)),
        ("η", say("hand.spectrum.eta", slv=eta(0.08), slc=eta(0.10))),
    ]


def spectrum(data):
    """Numbers behind the demand's spectra on the ground and on the weakest mechanism's floor."""
    assessment, chain, say = data.config["assessment"], data.config["smdof"], data.say
    rows = _national(data) or [(say("hand.spectrum.demand"), data.demand_said)]
    period_s = chain["period_s"] * assessment["building_period_factor"]
    place = data.weakest.place
    share = floor_demand(None, place, chain).share
    about = {"period_s": period_s, "place": place, "share": abs(share)}
    floor = say.count("hand.spectrum.of_floor", chain["n_dof"], **about)
    return Table(
        say("hand.spectrum.caption"),
        ("", ""),
        [*rows, (say("hand.spectrum.floor"), floor)],
        (0.2, 0.8),
        f"{data.folder}/spectra.csv",
    )


def others(data):
    """Every mechanism but the weakest, by hand, the weakest of them first."""
    rows = verdict.as_stated(data.tables["mechanisms"]).itertuples()
    return [by_hand(data, data.candidate(r), False) for r in rows if r.part != data.weakest.part]


def motions(data):
    """Table of the motions of the dynamic check, and lines on their source and licence."""
    say, chosen = data.say, data.tables["selected_motions"].fillna("")
    if chosen.empty:
        return Table(say("hand.motions.none"), ("",), [], (1.0,)), []
    rows = [
        (
            *(r.record, r.station, r.component, r.event),
            *(say.number(value, ".3f") for value in (r.factor, r.pga_g)),
        )
        for r in chosen.itertuples()
    ]
    keys = ("motion", "station", "component", "event", "factor", "pga")
    table = Table(
        say("hand.motions.caption"),
        tuple(say(f"hand.motions.{key}") for key in keys),
        rows,
        (0.16, 0.1, 0.14, 0.4, 0.1, 0.1),
        f"{data.folder}/selected_motions.csv",
    )
    lines = []
    for source, licence in chosen[["source", "licence"]].drop_duplicates().itertuples(index=False):
        source = source or say("hand.motions.no_source")
        if licence:
            lines.append(say("hand.motions.licence", source=source, licence=licence))
        else:
            lines.append(say("hand.motions.no_licence", source=source))
    return table, lines


def formulas(say):
    """Table of every formula and how it was read."""
    rows = [
        (
            say(f"formula.document.{formula.document}"),
            say(f"formula.{key}.number"),
            say(f"formula.{key}.text"),
            say(f"formula.read.{formula.read}"),
        )
        for key, formula in FORMULAS.items()
    ]
    head = tuple(say(f"formula.head.{key}") for key in ("document", "number", "text", "read"))
    return Table(say("formula.caption"), head, rows, (0.17, 0.15, 0.52, 0.16))


def stated(data):
    """Table of the values that were stated or derived; defaults are in the evidence.

    Rows of floors, openings, ties and the hazard stand in one line each.
    """
    say = data.say
    rows: dict[tuple, list] = {}
    for key, value, standing in values(data.config, data.given, say):
        if standing == DEFAULT:
            continue
        place, _, last = key.rpartition(".")
        listed = place[-1:].isdigit()
        told = f"{last} {value}" if listed else value
        rows.setdefault((place if listed else key, standing), []).append(told)
    cells = [
        (key, "; ".join(told), say(f"hand.stated.{standing}"))
        for (key, standing), told in rows.items()
    ]
    return Table(
        say("hand.stated.caption"),
        (say("hand.stated.key"), say("hand.stated.value"), ""),
        cells,
        (0.3, 0.6, 0.1),
        f"{data.folder}/values.csv",
    )
