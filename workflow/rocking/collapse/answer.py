"""What a run says at its end: at what shaking the façade falls, with what probability.

One row a model, over the curves of all motions and directions of a run, each of which counts alike.
"""

import math

import numpy as np
import pandas as pd

LEVELS_G = (0.1, 0.2, 0.3, 0.4, 0.5)  # at which the table says the probability
SAID_G = LEVELS_G[1:4]  # on the terminal
SHARES = {"pga_low_g": 0.16, "pga_half_g": 0.5, "pga_high_g": 0.84}
COLUMNS = [
    *("model", "walls", "stations", "motions", "curves", *SHARES),
    *(f"p_at_{level:g}g" for level in LEVELS_G),
    *("pga_building_g", "building_first", "yade_fell", "yade_stood", "yade_otherwise"),
]


def at(table, at_g, column="probability"):
    """Collapse probability of one curve at amplitudes, between those of its table.

    Parameters
    ----------
    table : DataFrame
        pga_g and `column` of one curve, as in tables/collapse_probability.csv.
    at_g : array_like, shape (n,)
    column : str

    Returns
    -------
    ndarray, shape (n,)
        Below the lowest amplitude that was run zero, above the highest its own; NaN of a curve that
        does not say it.
    """
    known = table.reindex(columns=["pga_g", column]).astype(float).dropna().sort_values("pga_g")
    if known.empty:
        return np.full(len(at_g), math.nan)
    return np.interp(at_g, known["pga_g"], known[column], left=0.0)


def over_curves(tables, at_g, column="probability"):
    """Mean of `at` over the curves that say it; NaN where none does."""
    rows = [at(table, at_g, column) for table in tables]
    rows = [row for row in rows if not np.isnan(row).any()]
    return np.mean(rows, axis=0) if rows else np.full(len(at_g), math.nan)


SHARED = ["pga_g", "probability", "probability_building"]


def shares(tables, at_g):
    """Table of `SHARED` at amplitudes: means over the curves of a model, NaN where none says it."""
    columns = {name: over_curves(tables, at_g, name) for name in SHARED[1:]}
    return pd.DataFrame({"pga_g": at_g, **columns})


def of_runs(curve):
    """Table of a curve without a scan, by its single runs in YADE, as `at` takes it.

    What the highest run up to an amplitude did holds there: between two runs nothing is known.
    """
    known = curve[curve["status"] != "failed"].sort_values("pga_g")
    pga_g, fell = known["pga_g"].to_numpy(float), known["collapsed"].to_numpy(float)
    before = pga_g[1:] * (1.0 - 1e-9)
    step = pd.DataFrame({"pga_g": [*pga_g, *before], "probability": [*fell, *fell[:-1]]})
    return step.sort_values("pga_g", ignore_index=True)


def grid(tables):
    """Amplitudes [g] of a drawing: from zero to where all curves have all that they have."""
    top = max((float(table["pga_g"].max()) for table in tables), default=1.0)
    return np.linspace(0.0, top, 601)


def reached(probability, at_g, share):
    """Lowest amplitude at which a share of the curves' probability is reached; NaN if never."""
    over = np.flatnonzero(probability >= share)
    return float(at_g[over[0]]) if over.size else math.nan


def told_by_yade(scan, runs):
    """Of YADE's single runs of a curve those that fell and stood as in the scan, and the others.

    Each is compared with the scan's history nearest in amplitude.

    Parameters
    ----------
    scan, runs : DataFrame
        pga_g and status: ok or overturned; others count for nothing.

    Returns
    -------
    DataFrame
        pga_g, fell and foretold (0 or 1), a row a run.
    """
    valid = runs[runs["status"].isin(("ok", "overturned"))]
    known = scan[scan["status"].isin(("ok", "overturned"))].sort_values("pga_g")
    at_g = known["pga_g"].to_numpy(float)
    nearest = [int(np.abs(at_g - g).argmin()) for g in valid["pga_g"]] if len(known) else []
    foretold = known["status"].to_numpy()[nearest] if nearest else valid["status"].to_numpy()[:0]
    return pd.DataFrame(
        {
            "pga_g": valid["pga_g"].to_numpy(float)[: len(nearest)],
            "fell": (valid["status"].to_numpy()[: len(nearest)] == "overturned").astype(int),
            "foretold": (foretold == "overturned").astype(int),
        }
    )


def row(model, walls, motions, stations, tables, collapse, checked):
    """Row of the table (`COLUMNS`) of one model.

    Parameters
    ----------
    model, walls : str
        Its name, and in words how its return walls move.
    motions, stations : int
    tables : list of DataFrame
        Collapse probabilities, one a curve.
    collapse : DataFrame
        Rows of tables/ida_collapse.csv of these curves.
    checked : DataFrame
        `told_by_yade` of these curves together.

    Returns
    -------
    dict
        pga_low_g, pga_half_g, pga_high_g: amplitudes from which 16, 50, 84 in a hundred fall;
        pga_building_g: amplitude from which the building is down in half of the curves, as
        drawn; building_first: share of curves in which it is down before the façade.
    """
    at_g = grid(tables)
    share = over_curves(tables, at_g)
    building = over_curves(tables, at_g, "probability_building")
    told = collapse["building_first"].dropna()
    as_told = checked["fell"] == checked["foretold"]
    return (
        dict(model=model, walls=walls, stations=stations, motions=motions, curves=len(tables))
        | {name: reached(share, at_g, level) for name, level in SHARES.items()}
        | {f"p_at_{g:g}g": over_curves(tables, [g])[0] for g in LEVELS_G}
        | {
            "pga_building_g": reached(building, at_g, 0.5),
            "building_first": told.mean() if len(told) else math.nan,
            "yade_fell": int((as_told & (checked["fell"] == 1)).sum()),
            "yade_stood": int((as_told & (checked["fell"] == 0)).sum()),
            "yade_otherwise": int((~as_told).sum()),
        }
    )


def _counted(number, what):
    return f"{number} {what}" + ("s" if number != 1 else "")


def lines(table):
    """What the table says in plain words, a line a model, for the terminal."""
    first = table.iloc[0]
    ways = ", in both directions" if first["curves"] > first["motions"] else ""
    said = [
        f"half of the histories fell from this PGA on ({_counted(first['motions'], 'motion')} of "
        f"{_counted(first['stations'], 'station')}{ways}):"
    ]
    for answer in table.to_dict("records"):
        half = answer["pga_half_g"]
        value = f"{half:.2f} g" if math.isfinite(half) else "more than was run"
        near = ", ".join(f"{100 * answer[f'p_at_{g:g}g']:.0f} % at {g:g} g" for g in SAID_G)
        yade = f"YADE: {answer['yade_fell']} fell and {answer['yade_stood']} stood as foretold"
        yade += f", {answer['yade_otherwise']} otherwise" if answer["yade_otherwise"] else ""
        ran = answer["yade_fell"] + answer["yade_stood"] + answer["yade_otherwise"]
        said.append(
            f"  {answer['model']:4} {value} ({near}); {answer['walls']}{f'; {yade}' * (ran > 0)}"
        )
    building = table["pga_building_g"].dropna()
    if len(building):
        said.append(f"  the building itself is down from {building.iloc[0]:.2f} g in half of them")
    return said
