"""The code's answer for one façade: checks with every number, sensitivity, ties, spectra."""

import json

import numpy as np
import pandas as pd
from rocking.assessment import site
from rocking.assessment.battery import battery, facade_of, mechanism_of, ties_of
from rocking.assessment.demand import floor_demand
from rocking.assessment.mechanism import lowest_two_blocks, overturning
from rocking.records import G_M_S2, load
from rocking.risk.hazard import read_hazard
from rocking.runtime.script import run
from rocking.tables import write_table

from smdof.chain import floor_motions
from smdof.spectra import response_spectrum

TIE_SHARES = (0.02, 0.05, 0.10, 0.20)  # of the façade's weight
VARIED = (
    ("facade", "height_m", 0.05),
    ("facade", "thickness_m", 0.05),
    ("facade", "density_kg_m3", 0.10),
    ("smdof", "period_s", 0.25),
    ("smdof", "damping_ratio", 0.40),
    ("assessment", "confidence_factor", 0.10),
    ("assessment", "height_ratio", 0.25),
)
SHOWN = ("linear_ground", "linear_height", "slv_ground", "slv_height", "slc_ground", "slc_height")


def sensitivity(settings, demand):
    """Capacity over demand of the Circolare's checks, one key at a time up and down."""
    rows = []
    for section, key, share in VARIED:
        for factor in (1.0 - share, 1.0 + share):
            changed = {name: dict(settings[name]) for name in ("facade", "smdof", "assessment")}
            value = changed[section][key] * factor
            if key == "confidence_factor" and value < 1.0 or key == "height_ratio" and value > 1.0:
                continue
            changed[section][key] = value
            facade, chain, own = (changed[k] for k in ("facade", "smdof", "assessment"))
            found = battery(mechanism_of(facade, own), facade, chain, own, demand)
            rows += [(f"{section}.{key}", factor, k, found[k].ratio) for k in SHOWN]
    return pd.DataFrame(rows, columns=["key", "factor", "check", "ratio"])


def mechanisms(settings, demand):
    """The mechanism as stated, with more ties, and the one left when the top is held."""
    facade, chain, own = (settings[k] for k in ("facade", "smdof", "assessment"))
    wall = facade_of(facade, own)
    stated = 1e-3 * sum(force for force, *_ in ties_of(facade))
    found = [("as stated", stated, mechanism_of(facade, own))]
    for share in TIE_SHARES:
        force = 1e-3 * share * wall.weight_n
        tied = overturning(wall, ties_of(facade, 1e3 * force))
        found.append((f"one more row, {100 * share:g} % of the weight", stated + force, tied))
    height, bent = lowest_two_blocks(wall)
    found.append((f"top held: hinge at {height:.2f} m", np.nan, bent))
    rows = []
    for name, force, mechanism in found:
        checks = battery(mechanism, facade, chain, own, demand)
        mass, ratio, _ = mechanism.participation()
        rows.append(
            {
                "mechanism": name,
                "tie_kn": force,
                "multiplier": mechanism.multiplier(),
                "participating_mass_kg": mass,
                "e_star": ratio,
                "d0_m": mechanism.ultimate()[1],
                "linear_ground": checks["linear_ground"].ratio,
                "linear_height": checks["linear_height"].ratio,
                "slv_ground": checks["slv_ground"].ratio,
                "slv_height": checks["slv_height"].ratio,
            }
        )
    return pd.DataFrame(rows)


def spectra(records, settings, demand):
    """Demand on ground and floor, with the suite at its PGA and the exact chain, by period."""
    chain, share = settings["smdof"], settings["assessment"]["height_ratio"]
    n = chain["n_dof"]
    floor = floor_demand(demand, share, chain)
    periods = site.PERIODS_S[1:]
    exact = []
    for record in records:
        motion = floor_motions(
            record.acceleration_m_s2,
            record.dt_s,
            n,
            chain["period_s"],
            chain["damping_ratio"],
            chain["damping_model"],
            tail_s=chain["tail_s"],
        )
        levels = np.vstack([motion.ground_m_s2, motion.floors_m_s2])
        j = min(int(share * n), n - 1)
        weight = share * n - j
        moved = (1.0 - weight) * levels[j] + weight * levels[j + 1]
        scale = demand.pga_g / (np.abs(motion.ground_m_s2).max() / G_M_S2)
        dt = record.dt_s / motion.refine
        exact.append(response_spectrum(moved, dt, periods, 0.05).psa_m_s2 / G_M_S2 * scale)
    ground = demand.pga_g * site.shapes(records)[:, 1:]
    table = {
        "period_s": periods,
        "ground_g": [demand.acceleration(t) for t in periods],
        "floor_formula_g": [floor.acceleration(t) for t in periods],
    }
    for name, rows in (("ground_suite", ground), ("floor_chain", np.array(exact))):
        for tail in (16, 50, 84):
            table[f"{name}_p{tail}_g"] = np.percentile(rows, tail, axis=0)
    return pd.DataFrame(table)


def main(job):
    settings = json.loads(job.params.settings)
    records = [
        load(name, job.params.table, baseline=settings["baseline"], seed=settings["seed"])
        for name in job.params.records
    ]
    if job.input.spectrum:
        demand = site.read_spectrum(str(job.input.spectrum))
    else:
        hazard = read_hazard(
            str(job.input.hazard), settings["smdof"]["period_s"], settings["risk.site"]
        )
        years = settings["assessment"]["return_period_years"]
        demand = site.at_pga(site.shapes(records), site.pga_at(hazard, years))
    facade, chain, own = (settings[k] for k in ("facade", "smdof", "assessment"))
    mechanism = mechanism_of(facade, own)
    found = battery(mechanism, facade, chain, own, demand)
    checks, steps = [], []
    for key, check in found.items():
        values = (check.capacity, check.demand, check.unit, check.ratio, check.failing_pga_g)
        checks.append((key, check.name, *values, check.demand_pga_g, check.source))
        steps += [(key, *step) for step in check.steps]
    names = ["check", "name", "capacity", "demand", "unit", "ratio", "pga_fails_g"]
    out = job.output
    write_table(checks, out.checks, [*names, "pga_demand_g", "source"])
    columns = ["check", "symbol", "meaning", "value", "unit"]
    write_table(steps, out.steps, columns)
    d, alpha = mechanism.curve()
    write_table({"d_m": d, "multiplier": alpha}, out.curve)
    write_table(sensitivity(settings, demand), out.sensitivity)
    write_table(mechanisms(settings, demand), out.mechanisms)
    write_table(spectra(records, settings, demand), out.spectra)


run(main, globals())
