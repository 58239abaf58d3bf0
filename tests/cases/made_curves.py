"""Records, curves and tables of collapse as runs write them, made up."""

import numpy as np
import pandas as pd
from rocking.collapse.ida import curve_key
from rocking.records import Record, write_csv
from run_script import script

HEAD = "model,record,direction,pga_g,d_over_b,collapsed,status,dt_s,steps,wall_s\n"


def record(folder, name, scale=1.0, period_s=1.0):
    """A sine of 0.3 g times `scale`; PGV is proportional to the period."""
    t = np.arange(0.0, 10.0, 0.01)
    motion = Record(name, scale * 2.94 * np.sin(2 * np.pi * t / period_s), 0.01, "surrogate")
    write_csv(motion, folder / f"{name}.csv")
    return str(folder / f"{name}.csv")


def curve(path, model, name, direction, safe, collapse):
    """An IDA table with one safe and, unless None, one collapsing intensity."""
    rows = f"{model},{name},{direction},{safe},0.4,0,ok,1e-4,1000,0.5\n"
    if collapse is not None:
        rows += f"{model},{name},{direction},{collapse},1,1,overturned,1e-4,1000,0.5\n"
    path.write_text(HEAD + rows)
    return str(path)


def collapse_tables(folder, curves, ending="", scans=()):
    """Tables of collapse intensities and probability; without scans, of YADE's runs alone."""
    names = {k: str(folder / f"{k}{ending}.csv") for k in ("collapse", "probability")}
    lists = {"ida": curves, "ensemble": [], "scans": scans}
    keys = [list(curve_key(pd.read_csv(path))) for path in scans or curves]
    params = {"spread": 0.01, "slope": 2.0, "curves": keys}
    script("table_ida_collapse", folder, input=lists, output=names, params=params)
    return names
