"""Collapse under one record without, with a hundredth of, and with its vertical motion."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
from rocking.assessment.collapse import collapse_pga
from rocking.records import load
from rocking.runtime.script import run
from rocking.studies.vertical import COLUMNS, SHARES
from rocking.tables import write_table


def main(job):
    p = job.params
    settings = json.loads(p.settings)
    how = {key: settings[key] for key in ("baseline", "seed")}
    record = load(job.wildcards.record, p.table, vertical_motion="on", **how)
    up = record.vertical_m_s2
    size = np.abs(up).max() / np.abs(record.acceleration_m_s2).max()
    rows = []
    for path in job.input.scenes:
        scene = json.loads(Path(path).read_text())
        for name, share in SHARES.items():
            shaken = replace(record, vertical_m_s2=share * up if share else None)
            limit = settings["ida.max_pga_g"]
            for direction, *found in collapse_pga(scene, shaken, settings["directions"], limit):
                key = (record.name, p.station, scene["model"], direction, name, size)
                rows.append((*key, *found))
    table = pd.DataFrame(rows, columns=COLUMNS)
    write_table(table, job.output[0])


run(main, globals())
