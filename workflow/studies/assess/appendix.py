"""The report's data, and its appendix: mechanisms by hand, motions, formulas, values, evidence."""

from dataclasses import dataclass, field

from studies.assess import byhand, verdict
from studies.assess.anchors import completed_settings
from studies.assess.checks import confidence
from studies.assess.demand import eta, floor_demand
from studies.assess.family import Candidate, Family
from studies.assess.names import kind_of, said
from studies.assess.national import spectrum_of, stated_row
from studies.assess.paper import Table
from studies.assess.selection import fit_of
from studies.assess.sites import site_of
from studies.assess.slv import readings
from studies.assess.sources import FORMULAS
from studies.assess.values import DEFAULT, values

STEPS = {  # of a check, with the numbers of their formulas
    "T_SLV": " (C8.7.1.10)",
    "T_max": "",
    "S_De": " (C8.7.1.2.1.8, C8.7.1.12)",
    "a_g,SLD": " (C8.7.1.8)",
    "a_g,SLV": " (not below a_g,SLD)",
}
FAILS_AT = "of failure"


@dataclass
class Data:
    """What a report is made of.

    `fit` and `range_s` are of the selected motions' mean, see `selection.fit_of`.
    """

    config: dict  # resolved
    given: list  # keys that the user stated
    tables: dict  # by file name; verdicts and yade of all models
    run: str
    demand_said: str
    program: str
    commit: str
    folder: str  # where the tables are, for the sources
    family: Family = field(init=False)
    weakest: Candidate = field(init=False)  # fails first by hand
    demand_g: float = field(init=False)  # PGA
    relied: str = field(init=False)  # model that the rate rests on
    fit: tuple | None = field(init=False)
    range_s: tuple = field(init=False)

    def __post_init__(self):
        """Find the weakest mechanism of the tables among the façade's."""
        t = self.tables
        self.config = completed_settings(self.config)
        self.family = Family(self.config)
        self.weakest = self.candidate(next(verdict.as_stated(t["mechanisms"]).itertuples()))
        self.demand_g = t["code_checks"]["pga_demand_g"].iloc[0]
        self.relied = verdict.relied_on(t["dynamic"]["model"])
        self.fit, self.range_s = fit_of(t["selected_spectra"])

    def candidate(self, row):
        """Mechanism of a row of mechanisms.csv, without the links that are left out of it."""
        one = self.family.at(site_of(row))
        if not row.links_left_out:
            return one
        read = readings(one.mechanism)[int(row.links_left_out)]
        return one._replace(mechanism=read, letter=one.mechanism)

    @property
    def factor(self):
        """FC that the checks use."""
        own = self.config["assessment"]
        return confidence(own["confidence_factor"], own["hinge_inset_m"])


def _six(value):
    return f"{value:.6g}".replace("-", "−")


def _parts(rows, total, whole):
    """Table of the parts with their sums; `whole`: says what its columns are."""
    cells = [
        (
            p.name,
            _six(1e-3 * p.weight_n),
            "–" if p.y_m != p.y_m else f"{p.y_m:.4f}",
            f"{p.z_m:.4f}",
            *map(_six, (p.out, p.up, p.square)),
            *map(_six, (1e-3 * p.weight_n * v for v in (p.out, p.up, p.square))),
        )
        for p in rows
    ]
    sums = (1e-3 * v for v in (total.out_n, total.up_n, total.square_n))
    cells.append(("sum", _six(1e-3 * total.weight_n), "", "", "", "", "", *map(_six, sums)))
    said = (
        "Parts: width × thickness of the masonry between two heights, weight and centroid (y from "
        "the inner face of the foot outward, z above the base), and its virtual displacements for "
        "a unit rotation of the lowest block; δx² is the mean over the part's own height."
    )
    return Table(
        said if whole else "Parts.",
        ("part", "P [kN]", "y [m]", "z [m]", "δx", "δz", "δx²", "P δx", "P δz", "P δx²"),
        cells,
        (0.25, 0.08, 0.07, 0.07, 0.08, 0.07, 0.1, 0.1, 0.09, 0.09),
        "",
        (len(cells) - 1,),
    )


def _holds(rows):
    """Table of what holds, with its work."""
    cells = [
        (
            h.name,
            f"{1e-3 * h.force_n:.4g}",
            f"{h.height_m:.3f}",
            f"{1e3 * h.slack_m:.3g} to {1e3 * h.reach_m:.4g}",
            _six(h.out),
            _six(1e-3 * h.force_n * h.out),
        )
        for h in rows
    ]
    return Table(
        "What holds it: force, height, and from which to which outward way of its point it pulls.",
        ("hold", "F [kN]", "z [m]", "pulls [mm]", "δF", "F δF"),
        cells,
        (0.3, 0.14, 0.14, 0.18, 0.12, 0.12),
    )


def by_hand(data, candidate, whole=True):
    """One mechanism's name and tables: parts, holds, capacity, demand and verdict.

    Where `whole` they say how each number comes about; else they stand two in a row.
    """
    if not candidate.plane:
        return {"name": candidate.name, "tables": [_by_strips(data, candidate)]}
    parts, holds = byhand.parts(data.family, candidate), byhand.pulled(candidate)
    total = byhand.sums(parts, holds)
    found = byhand.results(candidate, total, data.factor)
    rows = [(s, how, f"{v:.4g} {unit}".strip()) for s, how, v, unit in found]
    rows += _demand_of(data, candidate.part)
    results = Table(
        f"Capacity, demand and verdict, with FC = {data.factor:g}.",
        ("", "how", "value"),
        rows,
        (0.14, 0.66, 0.2),
        f"{data.folder}/code_steps.csv",
        (len(rows) - 1,),
    )
    tables = [_parts(parts, total, whole), *([_holds(holds)] if holds else [])]
    tables.append(results if whole else _paired(rows))
    return {"name": candidate.name, "tables": tables}


def _by_strips(data, candidate):
    """Table of capacity, demand and verdict of what does not turn over the whole width."""
    part, thrust = candidate.part, data.config["assessment"]["arch_thrust_kn"]
    row = verdict.as_stated(data.tables["mechanisms"]).set_index("part").loc[part]
    rows = [
        ("α0", "", f"{row['multiplier']:.4g}"),
        ("M*", "", f"{row['participating_mass_kg']:.4g} kg"),
        ("e*", "", f"{row['e_star']:.4g}"),
        ("d0", "", f"{row['d0_m']:.4g} m"),
    ]
    words = said(kind_of(candidate), thrust_kn=thrust or 0.0)
    return _paired(rows + _demand_of(data, part), f"{words} ")


def _paired(results, words=""):
    """Table of symbols and values, three pairs in a row; the last, the verdict, in its caption."""
    pairs, last = [(symbol, value) for symbol, _, value in results[:-1]], results[-1]
    third = -(-len(pairs) // 3)
    columns = [pairs[k * third : (k + 1) * third] for k in range(3)]
    rows = [
        tuple(word for c in columns for word in (c[k] if k < len(c) else ("", "")))
        for k in range(third)
    ]
    said = f"{words}{last[0]} {last[1].replace(FAILS_AT, f'{FAILS_AT} {last[2]}')}."
    return Table(said, ("",) * 6, rows, (0.17, 0.16, 0.17, 0.17, 0.17, 0.16))


def _demand_of(data, part):
    """Rows of the demand on a mechanism, and where it fails."""
    steps = data.tables["code_steps"]
    own, rows, fails = steps[steps["part"] == part], [], []
    for key, words in (("slv_ground", "ground"), ("slv_height", "floor")):
        found = own[own["check"] == key].set_index("symbol")
        if found.empty:
            continue
        for symbol, number in STEPS.items():
            step = found.loc[symbol]
            value = f"{step['value']:.4g} {step['unit']}"
            rows.append((f"{symbol}, {words}", f"{step['meaning']}{number}", value))
        fails.append(float(found.loc["a_g,SLV", "value"]))
    least, demand_g = min(fails), data.demand_g
    words = "it passes, beyond" if least >= demand_g else "it fails, short of"
    rows.append(("PGA", f"{FAILS_AT}: {words} the demand's {demand_g:.4g} g", f"{least:.4g} g"))
    return rows


def spectrum(data):
    """Numbers behind the demand's spectra on the ground and on the weakest mechanism's floor."""
    own, chain = data.config["assessment"], data.config["smdof"]
    rows = [("demand", data.demand_said)]
    if not own["spectrum"] and (row := stated_row(own)) is not None:
        demand = spectrum_of(row, own["soil"], own["topography"])
        ss, st, tb, tc, td = demand.factors
        rows = [
            ("a_g, F0, T_C*", f"{row['ag_g']:.4g} g, {row['f0']:.4g}, {row['tc_star_s']:.4g} s"),
            (
                "S_S, S_T",
                f"{ss:.4g}, {st:.4g} (subsoil {own['soil']}, topography {own['topography']})",
            ),
            ("T_B, T_C, T_D", f"{tb:.4g}, {tc:.4g}, {td:.4g} s"),
            ("PGA", f"a_g S_S S_T = {demand.pga_g:.4g} g"),
            ("η", f"√(10/(5 + ξ)) = {eta(0.08):.4g} at 8 %, {eta(0.10):.4g} at 10 %"),
        ]
    period = chain["period_s"] * own["building_period_factor"]
    place = data.weakest.place
    (share,) = floor_demand(None, place, chain).share
    storeys = f"{chain['n_dof']} equal storeys" if chain["n_dof"] > 1 else "one storey"
    floor = (
        f"first mode of {storeys}, T1 = {period:.4g} s; taken at {place:.4g} of the eaves' height, "
        "the middle of what holds the part, where the mode times its participation, |γ1 ψ1|, is "
        f"{abs(share):.4g}"
    )
    return Table(
        "The demand: S_De(T) = S_e(T) T²/4π² on the ground; on the floor by C7.2.5–8.",
        ("", ""),
        [*rows, ("floor", floor)],
        (0.2, 0.8),
        f"{data.folder}/spectra.csv",
    )


def others(data):
    """Every mechanism but the weakest, by hand, the weakest of them first."""
    rows = verdict.as_stated(data.tables["mechanisms"]).itertuples()
    return [by_hand(data, data.candidate(r), False) for r in rows if r.part != data.weakest.part]


def motions(data):
    """Table of the motions of the dynamic check, and lines on their source and licence."""
    found = data.tables["selected_motions"].fillna("")
    rows = [
        (r.record, r.station, r.component, r.event, f"{r.factor:.3f}", f"{r.pga_g:.3f}")
        for r in found.itertuples()
    ]
    if found.empty:
        said = "No motions were chosen: the dynamic check was not made."
        return Table(said, ("",), [], (1.0,)), []
    table = Table(
        "Motions, each scaled by its factor so that their mean fits the demand's spectrum (picture "
        "of the dynamic check).",
        ("motion", "station", "component", "event", "factor", "PGA [g]"),
        rows,
        (0.16, 0.1, 0.14, 0.4, 0.1, 0.1),
        f"{data.folder}/selected_motions.csv",
    )
    said = found[["source", "licence"]].drop_duplicates().itertuples(index=False)
    lines = []
    for source, licence in said:
        of = f"Licence: {licence}." if licence else "Its file states no licence."
        lines.append(f"Source: {source or 'not stated'} {of}")
    return table, lines


def formulas():
    """Table of every formula and how it was read."""
    return Table(
        "Official wording: the text in a public transcription with page numbers. "
        "Transcription: a formula in the same place, from the page's image.",
        ("document", "number", "formula or rule", "read as"),
        [(f.document, f.number, f.text, f.status) for f in FORMULAS.values()],
        (0.17, 0.15, 0.52, 0.16),
    )


def stated(data):
    """Table of the values that were stated or derived; defaults are in the evidence.

    Rows of floors, openings, ties and the hazard stand in one line each.
    """
    rows: dict[tuple, list] = {}
    for key, value, standing in values(data.config, data.given):
        if standing == DEFAULT:
            continue
        place, _, last = key.rpartition(".")
        listed = place[-1:].isdigit()
        words = f"{last} {value}" if listed else value
        rows.setdefault((place if listed else key, standing), []).append(words)
    cells = [(key, ", ".join(words), standing) for (key, standing), words in rows.items()]
    return Table(
        "Stated: in the user's file; derived: from other values, or by a rule of the code. All "
        "others, at their defaults, are in values.csv of the evidence.",
        ("key", "value", ""),
        cells,
        (0.3, 0.6, 0.1),
        f"{data.folder}/values.csv",
    )
