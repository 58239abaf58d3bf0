"""Kinematic and dynamic check of one façade under the code's spectrum at several intensities.

Of the whole façade, and of the mechanism that governs by hand where that is another.
"""

import json

import pandas as pd
from rocking import Case, Motion
from rocking.collapse.quick import LONG_STEP
from rocking.records import load_as, measures
from rocking.runtime.script import run
from rocking.tables import read_frame, write_table
from studies.assess import selection
from studies.assess.anchors import completed_settings
from studies.assess.checks import LEAST_KNOWN
from studies.assess.code_checks import code_checks, least
from studies.assess.code_spectrum import CodeDemand
from studies.assess.comparison import CHECKED_AG_G, SITE
from studies.assess.dynamic_check import histories, limits_with, verdict
from studies.assess.family import Family
from studies.assess.shaken import cases, settled
from studies.assess.sites import site_of
from studies.assess.slv import Slv, read_as

HIGH_S, POINTS = 3.0, 20  # the motions fit from match_low_s to here
KEPT = ("motions", "exceed_d0", "mean_d_m", "d0_m", "d_slv_m", "failed")


def by_hand(candidate, settings, demand):
    """Whether a mechanism passes the kinematic SLV check with and without FC, and on the ground."""
    candidate = read_as(candidate, Slv(settings, demand).reading(candidate))
    checks = {fc: code_checks(candidate, settings, demand, fc) for fc in (1.0, LEAST_KNOWN)}
    row = {
        f"kinematic_{name}": int(least(checks[fc]) >= demand.pga_g)
        for name, fc in (("fc1", 1.0), ("fc", LEAST_KNOWN))
    }
    ground = checks[LEAST_KNOWN].get("slv_ground")
    passes = ground is None or ground.failing_pga_g >= demand.pga_g
    return row | {"kinematic_ground_fc": int(passes)}


def main(job):
    settings = completed_settings(json.loads(job.params.settings))
    stations = job.params.stations
    assessment = settings["assessment"]
    records = {name: load_as(settings, name, job.params.table) for name in stations}
    period_s = selection.periods(assessment["match_low_s"], HIGH_S, POINTS)
    spectra_g = selection.spectra_of(records.values(), period_s)
    peaks = {name: measures(record)["pga_g"] for name, record in records.items()}
    levels, wanted = [], {}
    for ag_g in CHECKED_AG_G:
        demand = CodeDemand(ag_g, *SITE)
        chosen = selection.for_demand(demand, stations, spectra_g, period_s, assessment)
        levels.append((demand, {"ag_g": ag_g, "pga_g": demand.pga_g, "fits": int(chosen.fits)}))
        for name, factor in zip(chosen.names, chosen.factors, strict=True):
            wanted.setdefault(name, {})[ag_g] = factor * peaks[name]
    family, rows, shaken = Family(settings), [], read_frame(job.input.shaken)
    mechanisms = {row.part: family.at(site_of(row)) for row in shaken.itertuples()}
    known = {
        part: [row | by_hand(mechanisms[part], settings, demand) for demand, row in levels]
        for part in shaken.loc[shaken["shaken"] == 1, "part"]
    }
    turns, at_g = [], []
    for name, pga_g in wanted.items():
        motion = Motion(records[name])
        turns += [((motion, own_g), settings["directions"][0]) for own_g in pga_g.values()]
        at_g += pga_g.keys()
    for path in job.input.cases:
        for about, case in cases(settled(Case.read(str(path)), assessment), shaken):
            by_turn = histories(case.sections, turns, LONG_STEP)
            tables = [table.assign(ag_g=ag_g) for table, ag_g in zip(by_turn, at_g, strict=True)]
            table = pd.concat(tables, ignore_index=True)
            limits = limits_with(mechanisms[about.part])
            for row in known[about.part]:
                outcome = verdict(table[table["ag_g"] == row["ag_g"]], limits, settings["seed"])
                said = {key: outcome[key] for key in KEPT} | {"dynamic": int(outcome["slv"])}
                rows.append({"part": about.part, "model": case.model, **row, **said})
    write_table(rows, job.output[0])


run(main, globals())
