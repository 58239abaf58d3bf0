"""What the study says about boundary conditions, as statements that a run can bear out or not.

Each claim compares collapse intensities of the run (tables/ida_collapse.csv) or peak
static capacities (pushover). A collapse intensity is known to the width of its bracket,
so "not stronger" means: not by more than that. Where an ensemble was run its median is
taken instead. A façade that never collapsed counts as stronger than its largest intensity.
Claims are made for surrogates and for recorded motions separately.
"""

import numpy as np
import pandas as pd
from rocking.collapse.probability import half_collapse, one_number

from studies.shared.statements import COLUMNS, OURS, STUDY, statement

MARGINAL = ("BUCAR0-", "BUCAR0+", "1ST280-", "HVSC1+", "RRS228+")
# ours: "matched well" and "much higher", as ratios to the pushover; "did not help", W2c over W2;
# "good agreement" of pushover and kinematic curve
CLOSE, HIGHER, HELP, AGREEMENT = 1.3, 1.3, 1.1, 0.10
SMALL = 0.10  # a "very small margin"
REDUCTION, TOLERANCE = 0.60, 0.10  # the study's 60 %, and how near to it is called that: ours


def capacities(collapse, number=one_number):
    """Collapse PGA [g] by case ("RRS228-") and model, the width of its bracket, and its bound.

    `number` says by what a curve is compared. Capacity is NaN where nothing collapsed; the bound is
    the largest intensity that was survived there, NaN elsewhere.
    """
    table = collapse.copy()
    sign = table["direction"].map({"pos": "+", "neg": "-"})
    table["case"] = table["record"] + sign
    numbers = ["pga_safe_g", "pga_collapse_g", "pga_median_g", "pga_p10_g", "pga_p90_g"]
    table[numbers] = table[numbers].astype(float)
    table["capacity"] = number(table)
    table["bound"] = table["pga_safe_g"].where(table["capacity"].isna())
    band = table["pga_p90_g"] - table["pga_p10_g"]
    table["width"] = band.fillna(table["pga_collapse_g"] - table["pga_safe_g"].fillna(0.0))
    return tuple(
        table.pivot(index="case", columns="model", values=v) for v in ("capacity", "width", "bound")
    )


def _pair(capacity, first, second):
    """Cases in which both models collapsed, as two series; None if a model is missing."""
    if first not in capacity or second not in capacity:
        return None
    both = capacity[[first, second]].dropna()
    return (both[first], both[second]) if len(both) else None


def _compare(curves, first, second, want, strict=False):
    """Whether `first` is below ("<") or above (">") `second` in every case; text and verdict."""
    capacity, width, bound = curves
    if first not in capacity or second not in capacity:
        return None
    pair = capacity[[first, second]]
    ratio = (pair[first] / pair[second]).dropna()
    slack = 0.0 if strict else 0.5 * (width[first] + width[second]).reindex(ratio.index)
    difference = (pair[first] - pair[second]).dropna()
    good = difference <= slack if want == "<" else difference >= (slack if strict else -slack)
    text = f"{first}/{second} {ratio.min():.2f} to {ratio.max():.2f}, " if len(ratio) else ""
    # one that stood throughout is stronger than another that fell below its largest intensity
    strong, weak = (first, second) if want == ">" else (second, first)
    stood = bound[strong] > capacity[weak]
    good = pd.concat([good, stood[stood]])
    if not len(good):
        return None
    text += f"as claimed in {int(good.sum())} of {len(good)}"
    if stood.any():
        text += f" ({strong} never fell in {', '.join(sorted(stood.index[stood]))})"
    if not good.all():
        text += f"; not in {', '.join(sorted(good.index[~good.astype(bool)]))}"
    return text, bool(good.all())


def evaluate(collapse, static_peak, agreement=None):
    """Statements of every claim of section 4 on one set of records' curves, if its models were run.

    `static_peak` is the peak λ of the pushover by model, `agreement` λ0 of it over the kinematic
    one, and the rule it was pushed with.
    """
    curves = capacities(collapse)
    capacity, peak, rows = curves[0], static_peak.get("W3"), []

    def claim(words, paper, result, threshold=OURS):
        if result is not None:
            rows.append(statement(words, paper, result[0], result[1], threshold))

    def order(first, want, second, words, paper, strict=False):
        """Add a statement that the order of two models decides."""
        claim(words, paper, _compare(curves, first, second, want, strict), STUDY)

    order("W2", "<", "W1", "W2 is equally or more vulnerable than W1", "all eight curves")
    claim(
        "amplification reduces the capacity by as much as 60 %",
        f"60 % (here within {100 * TOLERANCE:g} points)",
        _largest_reduction(capacity, capacities(collapse, half_collapse)[0]),
    )
    claim(
        "the reduction comes from the building's motion, not from walls that cannot be pushed",
        f"not checked (here: W2 and W2m within {100 * TOLERANCE:g} points)",
        _assumption(capacity),
    )
    claim(
        "the reduction is small for five curves and marked for the others",
        f"small for {', '.join(MARGINAL)} (here: at most {100 * SMALL:g} %)",
        _marginal(capacity),
    )
    raises = "cohesion clearly raises the capacity of W1"
    order("W1c", ">", "W1", raises, "W1c above W1", strict=True)
    detaches = "with cohesion W2 detaches early: W2c collapses prematurely"
    order("W2c", "<", "W1c", detaches, "W2c below W1c")
    claim(
        "cohesion does not help W2",
        f"premature collapse (here: below {HELP:g} times)",
        _no_help(capacity),
    )
    interlocks = "interlocking and friction raise the capacity"
    order("W3", ">", "W2", interlocks, "W3 above W2", strict=True)
    claim(
        "the pushover of W3 agrees with the kinematic curve",
        f"good agreement (here: λ0 within {100 * AGREEMENT:g} %)",
        _agreement((agreement or {}).get("W3")),
    )
    claim(
        "W3 is near its pushover for BUCAR0 and RRS228",
        f"matched well (here: within a factor {CLOSE:g})",
        _against_static(capacity, peak, ("BUCAR0", "RRS228"), near=True),
    )
    claim(
        "W3 is much higher than its pushover for 1ST280 and HVSC1",
        f"much higher (here: above {HIGHER:g} times)",
        _against_static(capacity, peak, ("1ST280", "HVSC1"), near=False),
    )
    return rows


def _agreement(pushed):
    """λ0 of the pushover over the kinematic one; text and verdict."""
    if pushed is None:
        return None
    ratio, rule = pushed
    by = ", by construction" if rule == "hinged" else ""
    return f"λ0 {ratio:.2f} times (header joint {rule}{by})", bool(abs(ratio - 1.0) <= AGREEMENT)


def _reduction(capacity):
    """Share of its capacity under W1 that a façade lacks under W2, by case."""
    pair = _pair(capacity, "W2", "W1")
    return None if pair is None else 1.0 - pair[0] / pair[1]


def _largest_reduction(capacity, half):
    """By the equivalent PGA, which decides, and by half collapse; text and verdict."""
    reduction, by_half = _reduction(capacity), _reduction(half)
    if reduction is None:
        return None
    said = [
        f"{100 * loss.max():.0f} % ({loss.idxmax()}); median {100 * loss.median():.0f} %"
        for loss in (reduction, by_half)
    ]
    return (
        f"{said[0]}; by half collapse {said[1]}",
        bool(abs(reduction.max() - REDUCTION) <= TOLERANCE),
    )


def _assumption(capacity):
    """Reduction by one-way coupled walls less that by two-way coupled ones, in points of W1."""
    if not {"W1", "W2", "W2m"} <= set(capacity):
        return None
    known = capacity[["W1", "W2", "W2m"]].dropna()
    if not len(known):
        return None
    driven, felt = (100.0 * (1.0 - known[m] / known["W1"]) for m in ("W2", "W2m"))
    gap, where = driven - felt, driven.idxmax()
    text = (
        f"{where}: {driven[where]:.0f} % driven, {felt[where]:.0f} % where walls feel the façade; "
        f"the assumption: {gap.min():.0f} to {gap.max():.0f} points, median {gap.median():.0f}"
    )
    return text, bool(gap.abs().max() <= 100.0 * TOLERANCE)


def _marginal(capacity):
    reduction = _reduction(capacity)
    if reduction is None:
        return None
    small = reduction[reduction.index.isin(MARGINAL)]
    marked = reduction[~reduction.index.isin(MARGINAL)]
    if not len(small) or not len(marked):
        return None
    text = (
        f"small: {100 * small.min():.0f} to {100 * small.max():.0f} %; "
        f"marked: {100 * marked.min():.0f} to {100 * marked.max():.0f} %"
    )
    return text, bool(small.max() <= min(SMALL, marked.min()))


def _no_help(capacity):
    """W2c over W2: premature means that the bond buys less than it does in W1."""
    helped, plain = _pair(capacity, "W2c", "W2"), _pair(capacity, "W1c", "W1")
    if helped is None or plain is None:
        return None
    gain, gain_w1 = helped[0] / helped[1], plain[0] / plain[1]
    text = f"W2c/W2 {gain.min():.2f} to {gain.max():.2f}, median {gain.median():.2f}; " + (
        f"W1c/W1 median {gain_w1.median():.2f}"
    )
    return text, bool(gain.median() < HELP)


def _against_static(capacity, peak, records, near):
    if peak is None or "W3" not in capacity:
        return None
    of_w3 = capacity["W3"].dropna()
    of_w3 = of_w3[[case[:-1] in records for case in of_w3.index]]
    if not len(of_w3):
        return None
    ratio = of_w3 / peak
    text = (
        f"{ratio.min():.2f} to {ratio.max():.2f} times λ = {peak:.3f} ("
        + ", ".join(f"{case} {value:.2f}" for case, value in ratio.items())
        + ")"
    )
    if near:
        return text, bool(np.all((ratio < CLOSE) & (ratio > 1.0 / CLOSE)))
    return text, bool((ratio > HIGHER).all())


def table(collapse, static_peak, sources, agreement=None):
    """Contract of tables/claims.csv: `evaluate` by source of the records, with their names."""
    rows = []
    for source in sorted(set(sources.values())):
        names = [name for name, where in sources.items() if where == source]
        part = collapse[collapse["record"].isin(names)]
        if not len(part):
            continue
        for row in evaluate(part, static_peak, agreement):
            rows.append({**row, "records": f"{source}: {', '.join(names)}"})
    return pd.DataFrame(rows, columns=COLUMNS)
