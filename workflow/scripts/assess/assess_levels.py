"""Kinematic and dynamic check of one façade under the code's spectrum at several intensities."""

import json

import pandas as pd
from rocking.assessment import selection
from rocking.assessment.checks import LEAST_KNOWN
from rocking.assessment.code_checks import code_checks, least, mechanism_of
from rocking.assessment.code_spectrum import CodeDemand
from rocking.assessment.dynamic_check import histories, limits_of, verdict
from rocking.collapse.quick import LONG_STEP
from rocking.records import load_as, measures
from rocking.runtime.script import run
from rocking.tables import read_json, write_table

LEVELS_G = (0.05, 0.10, 0.15, 0.20, 0.25, 0.30)  # a_g
SITE = (2.5, 0.3, "B")  # F0, T_C*, subsoil
HIGH_S, POINTS = 3.0, 20  # the motions fit from match_low_s to here


def main(job):
    settings, stations = json.loads(job.params.settings), job.params.stations
    own = settings["assessment"]
    records = {name: load_as(settings, name, job.params.table) for name in stations}
    period_s = selection.periods(own["match_low_s"], HIGH_S, POINTS)
    spectra_g = selection.spectra_of(records.values(), period_s)
    peaks = {name: measures(record)["pga_g"] for name, record in records.items()}
    whole = mechanism_of(settings)
    limits = limits_of(whole.mechanism)
    kinematic, wanted = [], {}
    for ag_g in LEVELS_G:
        demand = CodeDemand(ag_g, *SITE)
        chosen = selection.for_demand(demand, stations, spectra_g, period_s, own)
        found = {fc: code_checks(whole, settings, demand, fc) for fc in (1.0, LEAST_KNOWN)}
        row = {"ag_g": ag_g, "pga_g": demand.pga_g, "fits": int(chosen.fits)}
        row |= {
            f"kinematic_{name}": int(least(found[fc]) >= demand.pga_g)
            for name, fc in (("fc1", 1.0), ("fc", LEAST_KNOWN))
        }
        row["kinematic_ground_fc"] = int(
            found[LEAST_KNOWN]["slv_ground"].failing_pga_g >= demand.pga_g
        )
        kinematic.append(row)
        for name, factor in zip(chosen.names, chosen.factors, strict=True):
            wanted.setdefault(name, {})[ag_g] = factor * peaks[name]
    rows = []
    for path in job.input.scenes:
        scene = read_json(str(path))
        parts = []
        for name, levels in wanted.items():
            one = histories(
                scene, records[name], settings["directions"][0], levels.values(), 0, LONG_STEP
            )
            parts.append(one.assign(ag_g=list(levels)))
        table = pd.concat(parts, ignore_index=True)
        for known in kinematic:
            found = verdict(table[table["ag_g"] == known["ag_g"]], limits, settings["seed"])
            kept = ("motions", "exceed_d0", "mean_d_m", "d0_m", "d_slv_m", "failed")
            row = {key: found[key] for key in kept} | {"dynamic": int(found["slv"])}
            rows.append({"model": scene["model"], **known, **row})
    write_table(rows, job.output[0])


run(main, globals())
