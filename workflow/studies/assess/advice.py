"""What a report recommends next."""

from studies.assess.code_tables import DAMAGED_KEYS
from studies.assess.dynamic_check import LEAST_DRAWS, surely
from studies.assess.verdict import (
    as_stated,
    deciding,
    g3,
    gives_way,
    per_cent,
    short,
    the,
    words_of,
)

THINNER = 0.99  # of the ratio of a thinner wall that a thicker one falls short of
OTHERS = {"en": "EN 1998-3"}  # by the first part of a check's key


def damage(sensitivity, mechanisms, demand_g):
    """A line where the check passes as stated and fails before a damaged building; else nothing.

    Of the sensitivity's rows of DAMAGED_KEYS: C8.7.1.2.1.4 has the period grow by 50 to 100 %
    at ultimate states.
    """
    weakest_g = as_stated(mechanisms)["pga_fails_g"].iloc[0]
    slv = sensitivity["check"].isin(("slv_ground", "slv_height"))
    rows = sensitivity[slv & sensitivity["key"].isin(DAMAGED_KEYS.values())]
    if rows.empty or weakest_g < demand_g or rows["ratio"].min() >= 1.0:
        return ""
    worst = rows.sort_values("ratio").iloc[0]
    return (
        "The check passes as stated and fails with the building's period times "
        f"{worst['factor']:g} ({worst['key']} damping), at {per_cent(worst['ratio'])} of the "
        "demand's PGA. The Circolare has such damage at ultimate states: judge how far "
        "the building's goes and state assessment.building_period_factor and building_damping."
    )


def thinner_is_better(sensitivity):
    """A line where the check allows a thinner wall more than the next thicker one; else nothing.

    Of the sensitivity's factors in turn the two between which it falls most. d_SLV = 0.4 d0 grows
    with the thickness, and so passes the displacement up to which a tie or an anchor holds: there
    the curve has lost it.
    """
    slv = sensitivity["check"].isin(("slv_ground", "slv_height"))
    rows = sensitivity[slv & (sensitivity["key"] == "facade.thickness_m")]
    ratio = rows.groupby("factor")["ratio"].min().sort_index()
    grows = (ratio.shift(-1) / ratio).iloc[:-1].to_numpy()
    if not len(grows) or grows.min() >= THINNER:
        return ""
    (thin, low), (thick, high) = list(ratio.items())[grows.argmin() :][:2]
    return (
        f"The check does not grow with the thickness: at {thin:g} times it is passed up "
        f"to {per_cent(low)} of the demand's PGA, at {thick:g} times up to "
        f"{per_cent(high)}. There d_SLV = 0.4 d0 passes the displacement up to which a "
        "tie or an anchor holds (C8.7.1.2.1.6): rest on the lesser, or lengthen the rods."
    )


def next_steps(checks, mechanisms, verdicts, shaken, *more):
    """What is recommended next, a line each; `more`: lines of others, empty ones left out.

    `verdicts` and `shaken` as of `dynamic_check`.
    """
    fails = mechanisms["pga_fails_g"] < checks["pga_demand_g"].iloc[0]
    weak = as_stated(mechanisms[fails])
    lines = _by_hand_next(checks, weak) + _shaken_next(deciding(verdicts), weak.empty)
    least = next(as_stated(mechanisms).itertuples())
    if least.part not in set(shaken.loc[shaken["shaken"] == 1, "part"]):
        lines.append(
            f"The weakest mechanism, {the(least)}, was not shaken: it is judged by the kinematic "
            "checks alone."
        )
    lines += [line for line in more if line]
    if not lines:
        lines.append("Keep the assumptions below verified on site; nothing else is asked for.")
    return lines


def _by_hand_next(checks, weak):
    """Lines on the checks by hand; `weak` are the mechanisms that fail by them."""
    if len(weak):
        listed = [f"{short(r)} ({g3(r.pga_fails_g)} g)" for r in weak.itertuples()]
        return [
            f"Tie or hold the façade against: {'; '.join(listed)}.",
            "Verify on site what the checks leave out: the bond with the return walls, the anchors "
            "of floors and roof, the quality of the masonry.",
        ]
    lines = []
    linear = checks[checks["check"].isin(("linear_ground", "linear_height"))]
    if (linear["ratio"] < 1.0).any():
        lines.append(
            "The linear check with q = 2 fails, the non-linear one passes. The Circolare takes the "
            "first where no capacity curve is at hand, so the second stands."
        )
    fails = checks[checks["ratio"] < 1.0]
    worst = fails.groupby(fails["check"].str.split("_").str[0])["ratio"].min()
    failed = [f"{OTHERS[k]} at {per_cent(r)}" for k, r in worst.items() if k in OTHERS]
    if failed:
        lines.append(
            f"Checks outside the Circolare do not pass: {', '.join(failed)} of the demand's PGA. "
            "They were read at second hand and decide nothing here; know why before you sign."
        )
    return lines


def _shaken_next(verdicts, by_hand):
    """Lines on the dynamic check; `by_hand`: whether the façade passes by hand."""
    if verdicts.empty:
        return [
            "Give motions of as many stations as the code's dynamic check wants "
            "(assessment.motions); it was not made."
        ]
    lines, lost = [], list(verdicts.loc[~surely(verdicts), "model"])
    if lost and by_hand:
        lines.append(
            f"The kinematic check passes and the dynamic one does not ({words_of(lost)}): do not "
            "rest on the kinematic check alone; tie the façade or find what the building's motion "
            "really is."
        )
    yields = [row["d_slv_m"] for _, row in verdicts.iterrows() if lost and gives_way(row)]
    if yields:
        lines.append(
            "Anchors stronger than their rods let the rods yield: now a tie or an anchor gives way "
            f"at {1e3 * min(yields):.3g} mm, the d_SLV of the dynamic check."
        )
    if (verdicts["agree"] < LEAST_DRAWS).any():
        lines.append(
            "Run the dynamic check with more motions: its verdict hangs on single histories."
        )
    return lines
