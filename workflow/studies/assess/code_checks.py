"""All checks of one façade under one demand, and which mechanism of it they are applied to."""

from studies.assess import checks
from studies.assess.demand import RecordDemand
from studies.assess.family import Family
from studies.assess.slv import Slv, read_as
from yade_scripts.model.facades import Facade

CHECKS = (  # keys of the tables; their names are `table.check` of the catalogue
    *("linear_ground", "linear_height", "slv_ground", "slv_height", "slc_ground", "slc_height"),
    *("slv_both", "slc_both", "slv_both_fc"),
    *("en_sd_ground", "en_sd_height", "en_nc_ground", "en_nc_height"),
    *("parts_ground", "parts_height", "parts_slow"),
    "housner",
)


def code_checks(candidate, sections, demand, confidence_factor=None):
    """Every check of one mechanism under one demand of the ground.

    By the keys of `CHECKS`; those on the ground only where the mechanism stands on it. `sections`
    are facade, smdof and assessment of a configuration. FC is as stated, but that of knowledge
    level 1 where the hinge does not crush.
    """
    facade, settings = Facade.of(sections["facade"]), sections["assessment"]
    mechanism, place, t0 = candidate.mechanism, candidate.place, candidate.t0_s
    inset, q = settings["hinge_inset_m"], settings["behaviour_factor"]
    fc = confidence_factor or checks.confidence(settings["confidence_factor"], inset)
    places = Slv(sections, demand).places(candidate)
    by_check = {}
    for key, (at, where) in places.items():
        by_check[f"linear_{key}"] = checks.linear(
            mechanism, at, where, confidence_factor=fc, behaviour=q, t0_s=t0
        )
        for limit in checks.LIMITS:
            by_check[f"{limit.lower()}_{key}"] = checks.nonlinear(
                mechanism, at, where, limit, confidence_factor=fc, t0_s=t0
            )
        for limit in checks.EUROCODE:
            by_check[f"en_{limit.lower()}_{key}"] = checks.eurocode(
                mechanism,
                at,
                where,
                limit,
                knowledge=settings["knowledge_level"],
                crushes=inset > 0.0,
            )
    slow = next(v for s, _, v, _ in by_check["slv_height"].steps if s == "T_SLV")
    high = facade.building_top_m
    rows = [("parts_height", place * high, 0.0), ("parts_slow", place * high, slow)]
    if candidate.on_ground:
        rows.insert(0, ("parts_ground", 0.0, 0.0))
    for key, height, period in rows:
        by_check[key] = checks.parts(
            mechanism, demand, height, high, period, response_factor=settings["response_factor"]
        )
    if candidate.foot_m == 0.0 and candidate.on_ground:
        by_check["housner"] = checks.housner(facade.height_m, facade.thickness_m, demand)
    return by_check


def least(by_check, limit="slv"):
    """PGA at which the non-linear check fails, of ground and floor the less [g]."""
    keys = (f"{limit}_ground", f"{limit}_height")
    return min(by_check[key].failing_pga_g for key in keys if key in by_check)


def family_of(sections, demand):
    """`Family` of sections, whose feet, hinges and corners are the weakest under a demand."""
    return Family(sections, slv=Slv(sections, demand))


def governing(candidates, sections, demand):
    """Mechanisms by the PGA at which SLV fails by hand: (pga_g, it, checks), the least first.

    Each as it counts (`slv.readings`).
    """
    rows, slv = [], Slv(sections, demand)
    for candidate in candidates:
        read = read_as(candidate, slv.reading(candidate))
        by_check = code_checks(read, sections, demand)
        rows.append((least(by_check), read, by_check))
    return sorted(rows, key=lambda row: row[0])


def mechanism_of(sections):
    """Overturning of the whole façade with its loads and ties, as a `Candidate`."""
    return Family(sections).part(0.0)


def failing_pga(whole, sections, record):
    """PGA at which each check just fails under one record, its own spectrum scaled [g].

    By the keys of `CHECKS`. FC is 1, for the dynamic answer knows its façade, but where a key says
    otherwise.
    """
    demand = RecordDemand(record.acceleration_m_s2, record.dt_s)
    by_code = code_checks(whole, sections, demand, 1.0)
    failing_g = {key: check.failing_pga_g for key, check in by_code.items() if key in CHECKS}
    for limit in ("slv", "slc"):  # whoever applies both takes the larger demand
        failing_g[f"{limit}_both"] = least(by_code, limit)
    known = code_checks(whole, sections, demand, checks.LEAST_KNOWN)
    return {**failing_g, "slv_both_fc": least(known)}
