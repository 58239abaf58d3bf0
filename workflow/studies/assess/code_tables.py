"""Tables of the code's answer for one façade: checks, mechanisms, sensitivity and spectra.

`settings` are the sections facade, return_wall, smdof and assessment of a configuration.
"""

import numpy as np
import pandas as pd
from rocking.collapse.case import Case, Variant
from rocking.records import G_M_S2
from rocking.records.floors import chain_motions

from smdof.spectra import response_spectrum
from studies.assess.code_checks import governing, least
from studies.assess.demand import floor_demand
from studies.assess.family import Family, pulls_of, stretched
from studies.assess.sites import EXTENT
from studies.assess.slv import Slv

CHECKS = [
    "part",
    "mechanism",
    "check",
    "name",
    "capacity",
    "demand",
    "unit",
    "ratio",
    "pga_fails_g",
]
CHECKS += ["pga_demand_g", "source"]
STEPS = ["part", "mechanism", "check", "symbol", "meaning", "value", "unit"]
VARIED = {  # factors by key
    "facade.height_m": (0.95, 1.05),
    "facade.thickness_m": (0.8, 0.95, 1.05, 1.2),  # over which a link's end may be passed
    "facade.density_kg_m3": (0.9, 1.1),
    "smdof.period_s": (0.75, 1.25),
    "smdof.damping_ratio": (0.6, 1.4),
    "assessment.confidence_factor": (0.9, 1.1),
}
DAMAGE = ("assessment.building_period_factor", "assessment.building_damping")
DAMAGED = ((1.5, 0.10), (2.0, 0.20))  # of a damaged building
DAMAGED_KEYS = {damping: f"damaged building, {100 * damping:g} %" for _, damping in DAMAGED}
DRAWN_S = np.geomspace(0.05, 4.0, 49)  # periods of the drawn spectra
SHOWN = ("linear_ground", "linear_height", "slv_ground", "slv_height", "slc_ground", "slc_height")
SECTIONS = ("facade", "return_wall", "smdof", "assessment")
AS_STATED = "as stated"  # kind of a mechanism of the façade as it stands


def variants(facade):
    """One key at a time up and down, then a damaged building; a height with all that is on it."""
    for key, factors in VARIED.items():
        for factor in factors:
            how: dict = {"factors": {key: factor}}
            if key == "facade.height_m":
                new = stretched(facade, factor).items()
                how = {"changes": {f"facade.{k}": v for k, v in new if v != facade[k]}}
            yield Variant(key, **how, about={"key": key, "factor": factor})
    for factor, damping in DAMAGED:
        name = DAMAGED_KEYS[damping]
        how = dict(zip(DAMAGE, (factor, damping), strict=True))
        yield Variant(name, changes=how, about={"key": name, "factor": factor})


def sensitivity(settings, demand, site):
    """PGA of failure over the demand's, of one mechanism, by `variants`.

    `site` is where it is; its heights are stretched with the façade's. What counts of links that
    give way (`slv.readings`) is found anew.
    """
    rows = []
    stated = Case({part: settings[part] for part in SECTIONS})
    for variant in variants(settings["facade"]):
        factor = variant.about["factor"] if variant.about["key"] == "facade.height_m" else 1.0
        try:
            varied = stated.varied(variant).sections
            candidate = Family(varied).at(stretched_site(site, factor))
            ((_, _, by_check),) = governing([candidate], varied, demand)
        except ValueError:  # no such façade, or a confidence factor below 1
            continue
        rows += [
            {**variant.about, "check": k, "ratio": by_check[k].ratio}
            for k in SHOWN
            if k in by_check
        ]
    return pd.DataFrame(rows, columns=["key", "factor", "check", "ratio"])


def stretched_site(site, factor):
    """A `family.Site` with every height times a factor."""
    heights_m = site.hinge_m, site.held_m, site.top_m
    hinge, held, top = (None if v is None else factor * v for v in heights_m)
    return site._replace(foot_m=factor * site.foot_m, hinge_m=hinge, held_m=held, top_m=top)


def mechanism_row(candidate, by_check, tie_kn, letter_g):
    """One row of the table of mechanisms.

    `letter_g` is the PGA at which its check fails with every link, those that give way early too.
    """
    mechanism, letter = candidate.mechanism, candidate.letter
    mass, ratio, _ = mechanism.participation()
    row = {
        "part": candidate.part,
        "mechanism": candidate.name,
        "kind": AS_STATED,
        "tie_kn": tie_kn,
        "foot_m": candidate.foot_m,
        "hinge_m": candidate.hinge_m,
        "held_m": candidate.held_m,
        "side": candidate.side,
        **{key: getattr(candidate, key) for key in EXTENT},
        "at_foot": candidate.at_foot,
        "place": candidate.place,
        "multiplier": mechanism.multiplier(),
        "participating_mass_kg": mass,
        "e_star": ratio,
        "e_star_letter": mechanism.participation(letter=True)[1],
        "d0_m": mechanism.ultimate()[1],
        "d_slv_m": mechanism.limit(0.4)[0],
        "t0_s": candidate.t0_s,
        "pga_fails_g": least(by_check),
        "pga_letter_g": letter_g,
        "links_left_out": 0 if letter is None else len(letter.pulls) - len(mechanism.pulls),
    }
    return row | {k: by_check[k].ratio for k in SHOWN if k in by_check}


def mechanisms(settings, demand, ranked):
    """All mechanisms of the façade as it stands, the least first."""
    slv = Slv(settings, demand)
    stated = 1e-3 * sum(pull.force_n for pull in pulls_of(settings["facade"]))
    rows = [
        mechanism_row(candidate, by_check, stated, slv.letter(candidate))
        for _, candidate, by_check in ranked
    ]
    return pd.DataFrame(rows)


def spectra(records, settings, demand, share):
    """Demand on ground and floor, with the suite at its PGA and the exact chain, by period."""
    chain = settings["smdof"]
    n = chain["n_dof"]
    floor = floor_demand(demand, share, chain)
    exact, ground = [], []
    for record in records:
        motion = chain_motions(record, chain)
        levels = np.vstack([motion.ground_m_s2, motion.floors_m_s2])
        j = min(int(share * n), n - 1)
        weight = share * n - j
        moved = (1.0 - weight) * levels[j] + weight * levels[j + 1]
        scale = demand.pga_g / (np.abs(motion.ground_m_s2).max() / G_M_S2)
        dt = record.dt_s / motion.refine
        exact.append(response_spectrum(moved, dt, DRAWN_S, 0.05).psa_m_s2 / G_M_S2 * scale)
        spectrum = response_spectrum(record.acceleration_m_s2, record.dt_s, DRAWN_S, 0.05)
        ground.append(spectrum.psa_m_s2 / G_M_S2 * scale)
    table = {
        "period_s": DRAWN_S,
        "ground_g": [demand.acceleration(t) for t in DRAWN_S],
        "floor_formula_g": [floor.acceleration(t) for t in DRAWN_S],
    }
    for name, rows in (("ground_suite", np.array(ground)), ("floor_chain", np.array(exact))):
        for tail in (16, 50, 84):
            table[f"{name}_p{tail}_g"] = np.percentile(rows, tail, axis=0)
    return pd.DataFrame(table)


def checks_of(ranked):
    """Checks of the mechanism that fails first and of the whole façade, with every step.

    Of every other mechanism of `ranked` (`code_checks.governing`) the steps of its non-linear SLV
    checks. Returns rows with the columns CHECKS and STEPS, and the capacity curves (part,
    mechanism, d_m, multiplier).
    """
    whole = next(row for row in ranked if row[1].whole)
    told = [whole] if ranked[0] is whole else [ranked[0], whole]
    checks, steps, curves = [], [], []
    for _, candidate, by_check in told:
        which = candidate.part, candidate.name
        for key, check in by_check.items():
            values = (check.capacity, check.demand, check.unit, check.ratio, check.failing_pga_g)
            checks.append((*which, key, check.name, *values, check.demand_pga_g, check.source))
            steps += [(*which, key, *step) for step in check.steps]
        d, alpha = candidate.mechanism.curve()
        about = {"part": candidate.part, "mechanism": candidate.name}
        curves.append(pd.DataFrame({**about, "d_m": d, "multiplier": alpha}))
    parts = {candidate.part for _, candidate, _ in told}
    for _, candidate, by_check in ranked:
        which = candidate.part, candidate.name
        for key in ("slv_ground", "slv_height"):
            if candidate.part not in parts and key in by_check:
                steps += [(*which, key, *step) for step in by_check[key].steps]
    return checks, steps, pd.concat(curves)
