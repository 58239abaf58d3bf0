"""Vary a façade or its motion and find collapse: the experiment that most targets are."""

from rocking.collapse.case import Variant
from rocking.collapse.curve import collapse_curve
from rocking.collapse.equivalent import SLOPE
from rocking.collapse.quick import crossings

AS_IT_IS = Variant()


def intensities(case, motion, direction, search="scan", slope=SLOPE, **settings):
    """Collapse intensities of a curve, as of `Curve.summary`; settings as of `collapse_curve`."""
    return collapse_curve(case, motion, direction, search=search, settings=settings).summary(slope)


def collapses(cases, motion, directions, find=crossings, variants=(AS_IT_IS,)):
    """What is found of the collapse of every case, with every variant, in every direction.

    `find` takes a case, a motion and a direction and returns columns: `crossings`, `intensities`,
    or a study's own. A row has model (of the case before it is varied), record, direction, what the
    variant is `about`, and what `find` says.
    """
    rows = []
    for case in cases:
        for variant in variants:
            varied, shaken = case.varied(variant), motion.varied(variant)
            for direction in directions:
                key = {"model": case.model, "record": motion.name, "direction": direction}
                rows.append({**key, **variant.about, **find(varied, shaken, direction)})
    return rows
