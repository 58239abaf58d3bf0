"""The least tie that keeps a façade standing at a stated intensity, by the planar solver.

At a height and a force of the tie the collapse probability is the share that falls of realisations
that differ in amplitude, node layout and step, as near collapse elsewhere. It does not fall
steadily with the force: a stronger tie changes the rhythm of the rocking. So the least tie is the
weakest from which on all stronger ones that were tried hold.

That decides which need be tried. Each height goes down from the strongest tie, every second force
first, and ends at the first that certainly does not hold: what lies below cannot be the least. Then
come the forces between, from the weakest with all above it certain to hold. A tie's realisations
come in parts that each span the amplitudes, and end as soon as they have decided: more have fallen
than may of all, or none of so many that the interval's upper end is within what is accepted.
"""

import math
import time
from functools import partial

import numpy as np
import pandas as pd
from rocking.collapse.case import Variant
from rocking.collapse.curve import collapse_curve
from scipy.stats import binomtest

from yade_scripts.commands.journal import Journal, run_key

CONFIDENCE = 0.95
NORMAL_95 = 1.959964  # two-sided
AHEAD = {"height_m": ".6g", "force_kn": ".6g"}  # columns of YADE's table
PARTS = 5  # in which a tie's realisations come: 37 of 61 are the first to be enough at 0.1
STRIDE = 2  # of the forces that are tried first
# of the scans behind the chart: probabilities are wanted, so no search for what hides below
CHART = {"level_ratio": 0.03, "realisations": 7, "power": 0}
ROD_KEYS = ("count", "length_m", "yield_mpa", "elongation", "slack_mm")


def trial_heights(settings, height_m):
    """Heights of the row [m]: as stated, or a half, three quarters and all of the façade's."""
    return settings["heights_m"] or [share * height_m for share in (0.5, 0.75, 1.0)]


def trial_forces(settings, levels):
    """Forces of the row [kN]: none, then equal ratios between the stated ones."""
    low, high = settings["forces_kn"]
    return np.concatenate(([0.0], np.geomspace(low, high, levels)))


def row_of_rods(settings, height_m, force_kn):
    """Entry of facade.ties that yields at a force, by section strengthening: φ = 2 √(F/(nπf_y))."""
    area_mm2 = 1e3 * force_kn / (settings["count"] * settings["yield_mpa"])
    return {
        "height_m": float(height_m),
        "diameter_mm": 2.0 * math.sqrt(area_mm2 / math.pi),
        "e_mpa": 2e5,
        "anchor_kn": None,
        **{key: settings[key] for key in ROD_KEYS},
    }


def tie(settings, height_m, force_kn):
    """Variant of a façade with one more row of ties; without force, as it is."""
    rows = [row_of_rods(settings, height_m, force_kn)] if force_kn else []
    about = {"height_m": height_m, "force_kn": force_kn}
    return Variant("tie", added={"facade.ties": rows}, about=about)


def enough(probability):
    """Realisations of which none may fall for Wilson's 95 % interval to end at `probability`."""
    return math.ceil(NORMAL_95**2 * (1.0 - probability) / probability)


def most_histories(settings, height_m):
    """Histories that a search takes at most, and at least if every tie holds at once."""
    heights, levels = len(trial_heights(settings, height_m)), settings["levels"]
    few = min(enough(settings["probability"]), settings["realisations"])
    first = len(range(levels - 1, -1, -STRIDE))
    return (heights * levels + 1) * settings["realisations"], (heights * first + 1) * few


def forecast(settings, height_m, seconds):
    """What the whole search takes at most, in words, at so many processor seconds a history.

    How many histories it takes depends on where ties cease to hold: no more is known before one
    height is through.
    """
    most = most_histories(settings, height_m)[0] * seconds / 60.0
    return f"{seconds:.2g} s a history: at most {most:.3g} min of processor time in all"


def forecast_of_heights(histories, left, seconds):
    """What the heights take that are left, in words, if each takes what those before did."""
    minutes = left * np.mean(histories) * seconds / 60.0
    heights = "height that is" if left == 1 else f"{left} heights that are"
    return f"about {minutes:.2g} min of processor time for the {heights} left"


def realisations(case, motion, direction, settings):
    """How many realisations fell at the stated intensity, and of how many; failed ones apart."""
    spread, probability = case["ensemble"]["amplitude_spread"], settings["probability"]
    pga_g = settings["pga_g"] * np.linspace(1.0 - spread, 1.0 + spread, settings["realisations"])
    fell = valid = 0
    for k in range(PARTS):
        how = {"pga_g": pga_g[k::PARTS], "scatter": True}
        if not how["pga_g"].size:
            continue
        found = collapse_curve(case, motion, direction, search="list", settings=how)
        fell += int((found.status == "overturned").sum())
        valid += int((found.status != "failed").sum())
        if fell > probability * settings["realisations"]:
            break
        if fell == 0 and valid >= enough(probability):
            break
    return fell, valid


class Kept:
    """What was found of each tie, in a journal, so that a broken search goes on; None: in memory.

    `key` is that of what the results depend on; others in the file are left alone.
    """

    def __init__(self, path, key):
        """Read what is there."""
        self.key, self.journal = f"{key}|", Journal(path) if path else None
        rows = self.journal.rows if self.journal else {}
        own = (place for place in rows if place.startswith(self.key))
        self.known = {place.removeprefix(self.key): rows[place] for place in own}

    def get(self, height_m, force_kn):
        """What is known of a tie, or None."""
        return self.known.get(f"{height_m:.6f}|{force_kn:.6f}")

    def put(self, height_m, force_kn, found):
        """Keep what was found, as JSON has it."""
        place = f"{height_m:.6f}|{force_kn:.6f}"
        self.known[place] = found
        if self.journal:
            self.journal.put(self.key + place, found)


def key_of(case, motion, direction, settings, code=""):
    """Key of everything that a search's results depend on; `code` stands for the programs."""
    time_s, columns = motion.columns(case)
    sampled = (time_s, *(columns[name] for name in sorted(columns)))
    shaken = [np.ascontiguousarray(values).tobytes() for values in sampled]
    return run_key(case.sections, direction, settings, code, *shaken)


def search(case, motion, direction, settings, kept=None, say=lambda text: None):
    """Collapse probability at the stated intensity, by height and force of the row.

    Without a tie, then at each height every second force from the strongest down to the first that
    certainly does not hold (the lower end of its interval is above what is accepted), then those
    between about where the ties cease to hold. low and high are Wilson's, 95 %. `say` receives a
    line a tie.
    """
    kept = kept or Kept(None, "")
    heights = trial_heights(settings, case["facade"]["height_m"])
    none, *forces = trial_forces(settings, settings["levels"])
    taken: list[tuple[float, int]] = []  # processor seconds and histories of what is new

    def tried(height, force):
        if (known := kept.get(height, force)) is None:
            began = time.process_time()
            known = realisations(
                case.varied(tie(settings, height, force)), motion, direction, settings
            )
            seconds = time.process_time() - began
            kept.put(height, force, known)
            say(f"tie of {force:.3g} kN at {height:.2f} m: {known[0]} of {known[1]} fell")
            taken.append((seconds, known[1]))
            if len(taken) == 2:  # the first compiles
                say(forecast(settings, case["facade"]["height_m"], seconds / max(known[1], 1)))
        fell, n = known
        band = binomtest(fell, n).proportion_ci(CONFIDENCE, "wilson") if n else None
        low, high = (band.low, band.high) if band else (np.nan, np.nan)
        return height, force, fell, n, fell / n if n else np.nan, low, high

    bare = tried(heights[0], none)
    rows: list[tuple] = []
    through: list[int] = []  # histories of each height
    for number, height in enumerate(heights, 1):
        say(f"height {number} of {len(heights)}: {height:.2f} m")
        own = down(partial(tried, height), forces, settings["probability"])
        rows += [(height, *bare[1:]), *own]
        through.append(sum(row[3] for row in own))
        if number < len(heights) and len(taken) > 1:
            seconds, histories = map(sum, zip(*taken[1:], strict=True))
            say(forecast_of_heights(through, len(heights) - number, seconds / max(histories, 1)))
    names = ["height_m", "force_kn", "fell", "realisations", "probability", "low", "high"]
    return pd.DataFrame(rows, columns=names).sort_values(names[:2], ignore_index=True)


def down(tried, forces, probability):
    """Rows of one height, see `search`; `tried` says what is found of a force, its band last."""
    own: dict[int, tuple] = {}

    def lost(k):
        """Whether a tie certainly does not hold."""
        if k not in own:
            own[k] = tried(forces[k])
        return not own[k][-2] <= probability

    coarse = range(len(forces) - 1, -1, -STRIDE)
    end = next((k for k in coarse if lost(k)), -1)
    sure = len(forces)  # all from here on are certain to hold
    for k, row in own.items():
        if not row[-1] <= probability:
            break
        sure = k
    for k in range(sure - 1, end, -1):
        if lost(k):
            break
    return list(own.values())


def least(table, probability):
    """Least force at each height from which on all stronger ones hold, and its interval.

    Of a table of `search`: force_kn by the share itself, force_low_kn and force_high_kn by the
    lower and the upper end of its interval; NaN where even the largest does not hold.
    """
    rows = []
    for height, part in table.groupby("height_m", sort=True):
        part = part.sort_values("force_kn")
        found = []
        for column in ("probability", "low", "high"):
            holds = (part[column] <= probability).to_numpy()
            last = np.flatnonzero(~holds)
            k = 0 if not last.size else int(last[-1]) + 1
            found.append(part["force_kn"].iloc[k] if k < len(part) else np.nan)
        rows.append((height, *found))
    names = ["height_m", "force_kn", "force_low_kn", "force_high_kn"]
    return pd.DataFrame(rows, columns=names)


def together(table):
    """Share of all motions of a run under which the façade stands with a row of ties, by its force.

    A motion counts from its least force on; one under which even the strongest tie does not hold
    never does. Force 0 is the façade as it is. The table has rows of `least` of every curve, with
    model.
    """
    rows = []
    for (model, height), part in table.groupby(["model", "height_m"], sort=True):
        own = part["force_kn"]
        for force in sorted({0.0, *own.dropna()}):
            rows.append((model, height, force, len(own), float((own <= force).mean())))
    return pd.DataFrame(rows, columns=["model", "height_m", "force_kn", "curves", "share_stands"])


def best(table):
    """Row of `least` with the least force, the highest of equals; None where none holds."""
    held = table.dropna(subset="force_kn").sort_values(["force_kn", "height_m"])
    weakest = held[held["force_kn"] == held["force_kn"].min()]
    return None if weakest.empty else weakest.iloc[-1]


def weakest(table, choice):
    """Height and forces that YADE confirms: the least tie, and the strongest weaker one."""
    if choice is None:
        return []
    part = table[table["height_m"] == choice["height_m"]].sort_values("force_kn")
    weaker = part.loc[part["force_kn"] < choice["force_kn"], "force_kn"].tail(1).tolist()
    return [(float(choice["height_m"]), float(f)) for f in (*weaker, choice["force_kn"])]


def to_confirm(case, table, choice, settings):
    """For YADE's command `runs`: the ties of `weakest`, realisations of an ensemble each."""
    return [
        {
            "about": {"height_m": round(z, 6), "force_kn": round(force, 6)},
            "pga_g": [settings["pga_g"]],
            "changes": {"facade": case.varied(tie(settings, z, force))["facade"]},
            "realisations": True,
        }
        for z, force in weakest(table, choice)
    ]


def curve(case, motion, direction, settings, height_m, kept=None, say=lambda text: None):
    """Collapse intensities against the force of a row at one height.

    The strongest tie goes first: its scan takes longest, so the others' cost is known from above.
    `kept` is of these scans alone: its key differs from that of a search. `say` receives how many
    scans are due, and a line a scan.
    """
    kept = kept or Kept(None, "")
    names = [f"pga_{name}_g" for name in ("safe", "collapse", "p10", "median", "p90", "all", "max")]
    forces = trial_forces(settings, settings["curve_levels"])
    due = [force for force in forces[::-1] if kept.get(height_m, force) is None]
    say(f"chart of {len(forces)} scans at {height_m:.2f} m, {len(forces) - len(due)} known")
    for left, force in zip(range(len(due) - 1, -1, -1), due, strict=True):
        began = time.process_time()
        varied = case.varied(tie(settings, height_m, force))
        summary = collapse_curve(varied, motion, direction, settings=CHART).summary()
        kept.put(height_m, force, [float(summary[name]) for name in names])
        seconds = time.process_time() - began
        say(f"scan with a tie of {force:.3g} kN: {seconds:.2g} s of processor time, {left} left")
        if left and force == due[0]:
            say(f"the {left} left take at most about {left * seconds / 60.0:.2g} min")
    rows = [(height_m, force, *kept.get(height_m, force)) for force in forces]
    return pd.DataFrame(rows, columns=["height_m", "force_kn", *names])
