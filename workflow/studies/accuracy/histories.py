"""Histories that fidelity is measured on: which, how far they repeat, and what is right.

Motions come in two halves: nodes and step are chosen on one and judged on the other. Intensities
are shares of the lowest collapse that a coarse scan finds. All of it is done by the compiled
planar solver (`rocking.solver`), whose converged answer is the reference.
"""

import hashlib
import math

import numpy as np
from rocking.collapse import search
from rocking.collapse.scan import driving
from rocking.solver import peaks, stable_step, to_plane

from yade_scripts.commands.search import drive
from yade_scripts.model import models
from yade_scripts.model.motion import amplitude

CHOOSING, REPORTING = "choosing", "reporting"
AMPLITUDE_CHANGES = (1e-6, 1e-4)
SCAN_NODES, SCAN_STEP, SCAN_RATIO = 9, 0.15, 1.15  # of the coarse scan
TWIN_NODES, TWIN_STEP = 17, 2.0  # nodes, and steps over the reference's, of the changes
COLUMNS = (
    *("case", "half", "model", "record", "direction", "share", "pga_g", "d_over_b"),
    *("change_1e-6", "change_1e-4", "change_nodes", "change_step", "amplification", "repeats"),
)


def half(number):
    """Half of the records that a row of the table belongs to: rows 1, 2 choose, 3, 4 report, …

    Rows come in pairs, the components of one motion, which stay together.
    """
    return REPORTING if number // 2 % 2 else CHOOSING


class PeakSolver:
    """Peak d/b of one case, motion and direction at any nodes and step, by the compiled solver.

    Times and columns of floor motions are as `yade_scripts.model.floor_motions.read` gives them.
    """

    def __init__(self, case, time_s, columns, direction):
        """Keep the scene and its motion."""
        self.case, self.direction, self.ground = case, direction, columns["ground"]
        self.planes = {}
        scene = models.build_scene(models.with_nodes(case, SCAN_NODES))
        self.motions = driving(scene, time_s, columns)

    def plane(self, nodes):
        """Scene with n nodes a return wall, and the stable step [s] of the scheme."""
        if nodes not in self.planes:
            plane = to_plane(models.build_scene(models.with_nodes(self.case, nodes)))
            self.planes[nodes] = plane, float(stable_step(plane))
        return self.planes[nodes]

    def peaks(self, pga_g, nodes, step_fraction):
        """Outcomes (`solver.Peaks`) at some intensities; step over the stable one."""
        plane, stable = self.plane(nodes)
        factors = [amplitude(self.ground, self.direction, g) for g in np.atleast_1d(pga_g)]
        h = step_fraction * stable
        return peaks(plane, self.motions, self.case["numerics"], factors, step_s=h)

    def d_over_b(self, pga_g, nodes, step_fraction):
        """Peak d/b at one intensity, 1 where the façade overturns, NaN where the run failed."""
        return float(np.minimum(self.peaks(pga_g, nodes, step_fraction).d_over_b[0], 1.0))

    def lowest_collapse(self, highest_g):
        """Lowest collapse of a climb by SCAN_RATIO from half the static capacity [g]."""
        start = 0.5 * models.static_multiplier(self.case)
        count = max(0, 1 + math.ceil(math.log(highest_g / start, SCAN_RATIO)))
        levels = np.cumprod([start, *[SCAN_RATIO] * count])

        def run(ask):
            fell = self.peaks(ask.pga_g, SCAN_NODES, SCAN_STEP).overturned
            return np.where(fell, "overturned", "ok")

        lowest = drive(search.first(levels[levels < highest_g]), run)
        return highest_g if math.isnan(lowest) else lowest


def reference_of(solver, pga_g, settings):
    """Reference of one history and how it answers small changes, as columns of COLUMNS.

    It repeats where a change of amplitude moves d/b by at most `trusted` times that change, and a
    change of nodes, and one of step, by at most `repeat_tolerance` of its value; `settings` has
    these beside reference_nodes and reference_step. A history that overturns repeats trivially and
    is left out, as is what does not: its `repeats` is 0. Changes of nodes and step are relative,
    NaN where they are not needed any more.
    """
    nodes, step = settings["reference_nodes"], settings["reference_step"]
    trusted = settings["trusted"]
    value = solver.d_over_b(pga_g, TWIN_NODES, TWIN_STEP * step)
    changes = [
        abs(solver.d_over_b(pga_g * (1.0 + change), TWIN_NODES, TWIN_STEP * step) - value)
        for change in AMPLITUDE_CHANGES
    ]
    reference = by_nodes = by_step = float("nan")
    ratio = max(c / a for c, a in zip(changes, AMPLITUDE_CHANGES, strict=True))
    if value < 1.0 and ratio <= trusted:
        reference = solver.d_over_b(pga_g, nodes, step)
        by_nodes = abs(solver.d_over_b(pga_g, TWIN_NODES, step) / reference - 1.0)
        by_step = abs(solver.d_over_b(pga_g, nodes, TWIN_STEP * step) / reference - 1.0)
    repeats = reference < 1.0 and max(by_nodes, by_step) <= settings["repeat_tolerance"]
    return {
        "d_over_b": reference,
        "change_1e-6": changes[0],
        "change_1e-4": changes[1],
        "change_nodes": by_nodes,
        "change_step": by_step,
        "amplification": ratio,
        "repeats": int(repeats),
    }


def histories(solver, labels, settings):
    """Rows (COLUMNS) of one curve: shares of its lowest collapse.

    `labels` are half, model, record and direction; `settings` has shares and max_pga_g besides
    those of `reference_of`.
    """
    lowest = solver.lowest_collapse(settings["max_pga_g"])
    rows = []
    for share in settings["shares"]:
        pga_g = round(share * lowest, 4)
        name = f"{labels['model']} {labels['record']} {labels['direction']} {pga_g:g} g"
        row = {"case": name, **labels, "share": share, "pga_g": pga_g}
        rows.append({**row, **reference_of(solver, pga_g, settings)})
    return rows


def sampled(table, count):
    """Cases that YADE runs: so many repeating ones of each model and half.

    Their order is that of a hash of their names: it follows neither motion nor intensity.
    """
    key = [hashlib.sha1(case.encode()).hexdigest() for case in table["case"]]
    order = table.assign(key=key).sort_values(["model", "half", "key"])
    mine = order[order["repeats"] == 1].groupby(["model", "half"], sort=False)
    return mine.head(count).drop(columns="key")
