"""What a report says first: the verdict in three sentences, what it rests on, what is next."""

import math

import pandas as pd
from rocking.stations import FEWEST

from studies.assess.dynamic_check import LEAST_DRAWS, surely
from studies.assess.held import GOVERNS
from studies.assess.shaken import CORNER, FAR, REFUSED, STOCKY
from studies.assess.walls import named as wall_named

ROUNDED = 1e-4  # relative; tables have six figures
SURE = 0.005  # of a probability that rounds to 0 or 100 %
RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
NOT_SHAKEN = {  # by why a mechanism was not shaken
    CORNER: "not over the whole width",
    STOCKY: "lower than twice the thickness there, where a wall slides before it rocks",
    FAR: "by hand far from the demand",
    REFUSED: "which the models do not take",
}
NOT_MADE = "The code's dynamic check was not made: too few motions of different stations."


def as_stated(mechanisms):
    """Rows of mechanisms.csv of the façade as it stands, the weakest by hand first."""
    return mechanisms[mechanisms["kind"] == "as stated"].sort_values("pga_fails_g")


def g3(value):
    """Three figures, a word where there is no end, or a dash."""
    if pd.isna(value):
        return "–"
    return "never" if value == float("inf") else f"{value:.3g}"


def per_cent(value):
    """Whole per cent; what is just short of the whole keeps a tenth, and is not 100 %."""
    if 0.995 <= value < 1.0:
        return f"{math.floor(1000.0 * value) / 10.0:.1f} %"
    return f"{100 * value:.0f} %".replace("-", "−")


def bends(row):
    """Whether a row of a table of mechanisms is vertical bending: a level of it stays in place."""
    return bool(pd.notna(row.held_m))


def the(row):
    """A mechanism's name within a sentence: all but vertical bending take the article."""
    return row.mechanism if bends(row) else f"the {row.mechanism}"


def short(row):
    """A mechanism's name within a list, without what stands at its foot."""
    return the(row).split(" (", 1)[0]


def powered(value):
    """Two figures of a rate: 0.0014, 8.8·10⁻⁵."""
    if not 0.0 < value < 1e-3:
        return f"{value:.2g}"
    digits, exponent = f"{value:.1e}".split("e")
    return f"{digits}·10{str(int(exponent)).translate(RAISED)}"


def collapses(row, sign=""):
    """Probability of collapse and its interval in whole per cent; no interval where both are 0."""
    if row.probability_high < SURE:
        return "under 1 %", ""
    if row.probability_low > 1.0 - SURE:
        return "over 99 %", ""
    low, high = 100 * row.probability_low, 100 * row.probability_high
    return per_cent(row.probability), f" ({low:.0f} to {high:.0f}{sign})"


def words_of(names):
    """Names in a sentence: one, two and three."""
    return " and ".join([", ".join(names[:-1]), names[-1]] if names[1:] else names)


def gives_way(row):
    """Whether d_SLV is where a tie or an anchor fails, not 0.4 d0."""
    return row["d_slv_m"] < 0.4 * row["d0_m"] * (1.0 - ROUNDED)


def relied_on(names):
    """Model that the rate rests on: W2m where it is among them, else the last; None of none."""
    names = list(dict.fromkeys(names))
    return None if not names else GOVERNS if GOVERNS in names else names[-1]


def passes(checks, mechanisms, verdicts):
    """Whether a façade passes by hand, and in the dynamic check of every model and mechanism.

    The latter is None where that check was not made. One that is fulfilled and hangs on the
    numerics (`dynamic_check.surely`) counts as not passed.
    """
    weakest_g = as_stated(mechanisms)["pga_fails_g"].iloc[0]
    by_hand = bool(weakest_g >= checks["pga_demand_g"].iloc[0])
    if verdicts.empty:
        return by_hand, None
    return by_hand, bool(surely(verdicts).all())


def headline(checks, mechanisms, verdicts, shaken, when, factor, facade, fit=None):
    """What the report says first: the verdict, the check by hand, the dynamic check, what is left.

    Of the report's tables; `when` says the demand's return period, or that it is the stated one,
    `factor` is the FC that was used, `facade` a section, `fit` as of `selection.fit_of`.
    """
    by_hand, held = passes(checks, mechanisms, verdicts)
    demand, stated = checks["pga_demand_g"].iloc[0], as_stated(mechanisms)
    share = per_cent(stated["pga_fails_g"].iloc[0] / demand)
    outcome, state = "does not pass", "lost at"
    if by_hand and held is False:
        state = "lost under recorded motions; by hand it is kept up to"
    elif by_hand:
        outcome, state = "passes by hand" if held is None else "passes", "kept up to"
    first = (
        f"{when} (PGA {g3(demand)} g) the façade {outcome}: life safety (SLV) is {state} {share} "
        f"of that shaking, with FC = {factor:g}. The wall that is shaken is {wall_named(facade)}."
    )
    governed = f"{_governed(verdicts, shaken, held, fit)}{by_hand_alone(shaken)}"
    return [first, kinematic(stated, demand), governed]


def capacity(stated, demand_g, return_years):
    """ζE and the return period of the PGA at which the weakest mechanism's check by hand fails.

    `return_years` is that of the capacity as `national.return_period_of` has it; None without rows
    of the hazard.
    """
    ratio = stated["pga_fails_g"].iloc[0] / demand_g
    said = f"By hand ζE = {ratio:.2f}, the PGA of the capacity over the demand's"
    if return_years is None:
        return f"{said}; its return period wants assessment.hazard, the rows of NTC 2018."
    return f"{said}; the capacity has a return period of {return_years} years."


def early(stated):
    """Sentence on mechanisms whose ties or anchors give way early; nothing where there are none.

    Both numbers are told: by the letter, and without these links.
    """
    own = stated[stated["links_left_out"] > 0]
    if own.empty:
        return ""
    said = "; ".join(
        f"{short(r)} {g3(r.pga_letter_g)} g by the letter, {g3(r.pga_fails_g)} g without them"
        for r in own.itertuples()
    )
    return f" Ties or anchors give way early: {said}, which counts (C8.7.1.2.1.6)."


def _governed(verdicts, shaken, held, fit):
    """The dynamic check of the model and mechanism that decide, and what the others say."""
    if held is None:
        return NOT_MADE
    model = decided_by(verdicts)
    names = {row.part: row for row in shaken.itertuples()}
    worst = deciding(verdicts).set_index("model")
    row, count = worst.loc[model], verdicts["part"].nunique()
    words = (
        f"The code's dynamic check (C8.7.1.2.1.9) of the {count} mechanism{'s' * (count > 1)} that "
        f"{'were' if count > 1 else 'was'} shaken is {'' if held else 'not '}fulfilled. The model "
        f"that governs is {model}: {moving(names[row['part']])} {1e3 * row['mean_d_m']:.0f} mm in "
        f"the mean of {row['motions']:.0f} histories, where d_SLV is {1e3 * row['d_slv_m']:.0f} mm"
    )
    if row["exceed_d0"]:
        words += f", and goes beyond d0 in {row['exceed_d0']:.0f} of them"
    if row["slv"] and not held:
        words += (
            f". With these histories it would be fulfilled, but only in {per_cent(row['agree'])} "
            "of draws of perturbed ones, so it counts as not fulfilled"
        )
    elif row["agree"] < LEAST_DRAWS:
        words += f"; {per_cent(row['agree'])} of draws of single histories say the same"
    words += "." + _others(surely(worst).drop(model))
    if fit is not None and not fit[2]:
        words += " The motions' mean spectrum does not fit the demand within the code's bounds."
    return words


def _others(sure):
    """What the check says with the other models: `sure` has by model whether it is fulfilled."""
    said = [(list(sure.index[sure]), "fulfilled"), (list(sure.index[~sure]), "not fulfilled")]
    return "".join(f" With {words_of(names)} it is {what}." for names, what in said if names)


def moving(row):
    """What the displacement of a mechanism is of, to begin a clause with."""
    name = row.mechanism
    return f"the joint of {name}, moves" if bends(row) else f"the top of the {name} moves"


def kinematic(stated, demand):
    """The non-linear kinematic check of the weakest mechanism."""
    least = next(stated.itertuples())
    share = least.pga_fails_g / demand
    verdict = "passes" if share >= 1.0 else "fails"
    return (
        f"The façade {verdict} the non-linear kinematic check of the Circolare 7/2019 for life "
        f"safety (SLV): the weakest of {len(stated)} mechanisms, {the(least)}, holds "
        f"up to a PGA of {g3(least.pga_fails_g)} g, {per_cent(share)} of the demand's "
        f"{g3(demand)} g.{early(stated)}"
    )


def deciding(verdicts):
    """Of the mechanisms of each model the one that decides, a row a model.

    Those that are not fulfilled before those that are, then by the mean over d_SLV.
    """
    if verdicts.empty:
        return verdicts
    first = _worst_first(verdicts).drop_duplicates("model").set_index("model")
    return first.loc[verdicts["model"].unique()].reset_index()


def _worst_first(verdicts):
    """Rows of verdicts in the order of `deciding`."""
    over = verdicts["mean_d_m"] / verdicts["d_slv_m"]
    order = verdicts.assign(over=over, sure=surely(verdicts))
    return order.sort_values(["slv", "sure", "over"], ascending=[True, True, False])


def decided_by(verdicts):
    """Model that governs: of those that decide (`deciding`) the worst; None without a check."""
    return None if verdicts.empty else _worst_first(deciding(verdicts))["model"].iloc[0]


def held_or_not(verdicts):
    """In words whether each row of verdicts is fulfilled for SLV."""
    sure = surely(verdicts)
    words = sure.map({True: "held", False: "not held"})
    return words.mask(~sure & verdicts["slv"].astype(bool), "in doubt")


def by_hand_alone(shaken):
    """End of a paragraph: which mechanisms were not shaken, and why; nothing where there are none.

    Each is named with the PGA at which it fails by hand.
    """
    left = shaken[shaken["shaken"] == 0]
    if left.empty:
        return ""
    said = []
    for why, part in left.groupby("why_not", sort=False):
        names = [f"{name} ({g3(pga_g)} g)" for name, pga_g in together(part)]
        reason = NOT_SHAKEN.get(why, part["why_words"].iloc[0])
        said.append(f"{words_of(names)}, {reason}")
    return f" Not shaken, judged by hand alone: {'; '.join(said)}."


def together(rows):
    """Names of mechanisms and the PGA at which each fails [g], two corners that are alike as one.

    Corners have a key of their own, `why_not`.
    """
    corners = rows["why_not"] == CORNER
    if corners.sum() == 2 and rows.loc[corners, "pga_fails_g"].round(6).nunique() == 1:
        found = [(short(r), r.pga_fails_g) for r in rows[~corners].itertuples()]
        return [*found, ("both corners", rows.loc[corners, "pga_fails_g"].iloc[0])]
    return [(short(r), r.pga_fails_g) for r in rows.itertuples()]


def dynamic_check(verdicts, fit, shaken):
    """The code's own dynamic check in one sentence.

    Verdicts are of every model and mechanism, as of `dynamic_check.verdict`; `fit` as of
    `selection.fit_of`, `shaken` of `shaken.chosen`.
    """
    if verdicts.empty:
        return NOT_MADE
    count = int(shaken["shaken"].sum())
    names = {row.part: row for row in shaken.itertuples()}
    verdicts = deciding(verdicts)
    sure = surely(verdicts)
    held, lost = (list(verdicts.loc[own, "model"]) for own in (sure, ~sure))
    row = verdicts.iloc[0]
    about = f"under {row['motions']:.0f} histories of recorded motions scaled to the demand"
    if fit is not None and not fit[2]:
        about += ", whose mean does not fit its spectrum within the code's bounds"
    said = ", ".join(
        f"{1e3 * r.mean_d_m:.0f} mm with {r.model}"
        + (f" ({r.exceed_d0:.0f} beyond d0)" if r.exceed_d0 else "")
        for r in verdicts.itertuples()
    )
    limits = []
    for _, own in verdicts.drop_duplicates("part" if count > 1 else "d_slv_m").iterrows():
        where = f" of {the(names[own['part']])}" if count > 1 else " there"
        limit = f"d_SLV{where} is {1e3 * own['d_slv_m']:.3g} mm"
        limits.append(limit + ", where a tie or an anchor gives way" * bool(gives_way(own)))
    if not lost:
        verdict = f"is fulfilled{' for every model' * (len(verdicts) > 1)}"
    elif not held:
        verdict = f"is not fulfilled{' for any model' * (len(verdicts) > 1)}"
    else:
        verdict = f"is fulfilled for {words_of(held)} and not for {words_of(lost)}"
    unsure = [r.model for r in verdicts.itertuples() if r.agree < LEAST_DRAWS]
    of = "the whole façade" if count == 1 else f"{count} mechanisms"
    top = "the top" if count == 1 else "the top of the worst of them"
    words = f"The code's dynamic check of {of} (C8.7.1.2.1.9) {verdict}, {about}: "
    words += f"mean displacements of {top} are {said}; {'; '.join(limits)}"
    if unsure:
        words += f"; for {words_of(unsure)} the verdict hangs on the numerics"
    return f"{words}.{by_hand_alone(shaken)}"


def no_rate(dynamic, config):
    """Why there is no annual rate: what has to be stated or given."""
    wants = []
    if not config["assessment"]["hazard"] and config["risk"]["hazard"] is None:
        wants.append("state assessment.hazard (the rows of NTC 2018) or risk.hazard")
    if dynamic["stations"].max() < FEWEST:
        wants.append(f"give motions of {FEWEST} stations or more")
    return f"No rate: {' and '.join(wants)}."


def suite(dynamic, several=False):
    """Collapse under all motions of the run, by the first of several parts."""
    stations = int(dynamic["stations"].max())
    if stations < FEWEST:
        said = "; ".join(
            f"{r.model} fell under {r.fell_at_demand:.0f} of {r.curves:.0f} (the first at "
            f"{g3(r.least_pga_g)} g)"
            for r in dynamic.itertuples()
        )
        return (
            f"Shaken by the motions of {stations} station{'s' if stations > 1 else ''} at the "
            f"demand's PGA, {said}; so few give no probability and no interval ({FEWEST} stations "
            "are the least)."
        )
    said = ", ".join(
        f"{share} with {r.model}{interval}"
        for r in dynamic.itertuples()
        for share, interval in [collapses(r, " %")]
    )
    return (
        f"Shaken by {stations} stations' motions, each scaled to the demand's PGA, "
        f"{'a part of it or the whole' if several else 'the whole façade'} falls with a "
        f"probability of {said}; in brackets 95 % intervals."
    )
