"""The crossed design of an uncertainty study: its motions, and collapse over its sample."""

import math

from rocking.collapse.case import Variant
from rocking.collapse.quick import LONG_STEP, crossings
from rocking.records import load_as

from studies.uncertainty import sampling
from yade_scripts.model import models

BELOW = 0.5  # of the medians' first collapse: where the climb of another point begins
OTHER = {"start": 1.007, "step": 0.9}  # of a cell that is run again
COLUMNS = ["record", "direction", "model", "sample", "replicate"]
COLUMNS += ["pga_p10_g", "pga_median_g", "pga_max_g", "runs_planar"]


def forms(case, bases, law):
    """A case on each base that is equally probable, by the name of the form.

    The name is the model's; that of another base has the base behind. Without `bases`, values of
    facade.base, the case's own alone. The law of β may differ by base.
    """
    cases, given = {}, case["facade"]["base"]
    for base in bases or [given]:
        if base == given:
            cases[case.model] = case
        else:
            other = case.varied(Variant(base, {"facade.base": base}))
            cases[f"{case.model} {base}"] = other.calibrated(law)
    return cases


def collapse(name, case, motion, direction, factors, settings):
    """Collapse (COLUMNS) of a case over the sample, the first `replicates` of it twice.

    `name` is that of the form, `factors` of `sampling.factors`; settings are max_pga_g, replicates.
    """
    rows, first, limit = [], None, settings["max_pga_g"]
    for number, factor in enumerate(factors.to_dict("records")):
        cell = case.varied(sampling.variant(case, factor))
        lowest = cell.kind.climb_from * models.static_multiplier(cell.sections)
        start = max(lowest, BELOW * first) if first else lowest
        for again in range(1 + (0 < number <= settings["replicates"])):
            step = LONG_STEP * OTHER["step"] if again else LONG_STEP
            how = {"max_pga_g": limit, "from_g": start * OTHER["start"] if again else start}
            crossed = crossings(cell, motion, direction, how, step)
            if number == sampling.MEDIAN:
                first = crossed["pga_p10_g"] if math.isfinite(crossed["pga_p10_g"]) else None
            key = {"record": motion.name, "direction": direction, "model": name}
            key |= {"sample": number, "replicate": again, "pga_max_g": limit}
            rows.append(key | crossed)
    return rows


def sampled_motions(runs, run):
    """Direction of every motion of a run's design, by record.

    A ValueError of one line where the sample cannot be drawn, or fewer than three records are short
    enough.
    """
    resolved = runs.settings[run]
    settings = resolved["uncertainty"]
    drawn = [row["parameter"] for row in settings["parameters"]]
    if "base_shear_ratio" in drawn and resolved["smdof"]["base_shear_ratio"] is None:
        raise ValueError(
            "uncertainty.parameters: base_shear_ratio of a building that stays elastic; expected "
            "smdof.base_shear_ratio, the V/W that is multiplied"
        )
    sampling.scores(settings)
    longest = settings["max_duration_s"]
    short = [name for name in runs.records[run] if _duration_s(runs, run, name) <= longest]
    if len(short) < 3:
        raise ValueError(
            f"uncertainty: {len(short)} records of at most {longest:g} s; expected 3 or more "
            "(uncertainty.max_duration_s)"
        )
    return sampling.motions(short, resolved["directions"], settings)


def _duration_s(runs, run, name):
    """Duration of a record, as its table states it or by reading it."""
    targets = runs.tables[run][name].targets
    if "duration_s" in targets:
        return targets["duration_s"]
    return load_as(runs.settings[run], name, runs.table_path(run)).duration_s
