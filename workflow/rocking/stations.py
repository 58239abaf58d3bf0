"""Intervals over motions: stations are drawn with replacement, never records or curves.

Both components of a station come from one earthquake and one ground, and both directions of a
component from one motion, so they are not independent and are drawn together (a cluster bootstrap;
Davison and Hinkley, 1997, Bootstrap Methods and their Application, section 3.8). From fewer than
`FEWEST` stations there are so few different draws that the interval is no interval: one station
gives none, two one of no width. A table of records names the station; a record without one is its
own. For two components of one instrument that is wrong: where they are alike, the interval is too
narrow by 1/√2.
"""

import numpy as np

FEWEST = 7  # an interval drawn from fewer says nothing


def resampled(stations, resamples, seed):
    """How often each row, by its station, stands in every draw, shape (resamples, n)."""
    names, index = np.unique(np.asarray(stations), return_inverse=True)
    share = np.full(len(names), 1.0 / len(names))
    return np.random.default_rng(seed).multinomial(len(names), share, resamples)[:, index]


def turns(stations, directions):
    """Record and direction of every curve, where those of one station tell much the same.

    Of a station with several components each takes one direction in turn; a component that is alone
    takes all. `stations` has the station of every record.
    """
    by_station: dict[str, list[str]] = {}
    for record, station in stations.items():
        by_station.setdefault(station, []).append(record)
    curves = []
    for record, station in stations.items():
        of = by_station[station]
        k = of.index(record) % len(directions)
        curves += [(record, d) for d in (directions if len(of) == 1 else directions[k : k + 1])]
    return curves


def interval(values, stations, confidence):
    """Percentile interval of what the draws give, shape (resamples, ...), from so many stations.

    Values may be infinite, the confidence goes from 0 to 1. Low and high ends of shape (...), NaN
    from fewer than `FEWEST` stations.
    """
    values, tail = np.asarray(values, float), 50.0 * (1.0 - confidence)
    if stations < FEWEST:
        return np.full((2, *values.shape[1:]), np.nan)
    return np.percentile(values, (tail, 100.0 - tail), axis=0, method="inverted_cdf")


def unnamed(rows):
    """What to say of rows whose table names no station; empty where no interval hangs on it."""
    alone = sum(not row.about.get("station") for row in rows)
    if alone < 2 or len({row.station for row in rows}) < FEWEST:
        return ""
    return (
        f"{alone} of {len(rows)} records name no station, so each counts as one of its own; if two"
        " are components of one instrument, intervals come out too narrow: fill the column station"
    )


def counted(records, stations):
    """Numbers in words: "8 records of 4 stations"."""
    many = ((records, "record"), (stations, "station"))
    return " of ".join(f"{n} {word}{'' if n == 1 else 's'}" for n, word in many)


def remark(records, stations, least):
    """What to say of so few stations; empty from `least`, below which a result is an indication."""
    said = counted(records, stations)
    if stations < FEWEST:
        return f"no interval from {said}: it takes at least {FEWEST} stations"
    return f"indicative: {said}" if stations < least else ""


def heading(records, stations, words, least):
    """Heading of a figure: its motions, and `words` for its intervals where it has them."""
    if stations < FEWEST:
        return remark(records, stations, least)
    few = "; too few for more than an indication" if stations < least else ""
    return f"{counted(records, stations)}, {words}{few}"
