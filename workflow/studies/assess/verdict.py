"""What a report says first: the verdict in three sentences, what it rests on, what is next."""

from rocking.stations import FEWEST

from studies.assess import names
from studies.assess.catalogue import SAY
from studies.assess.dynamic_check import LEAST_DRAWS, surely
from studies.assess.held import GOVERNS
from studies.assess.shaken import CORNER

ROUNDED = 1e-4  # relative; tables have six figures
SURE = 0.005  # of a probability that rounds to 0 or 100 %
HELD, LOST, DOUBT = "held", "lost", "doubt"  # of a dynamic check


def as_stated(mechanisms):
    """Rows of mechanisms.csv, the weakest by hand first."""
    return mechanisms.sort_values("pga_fails_g")


def collapses(row, say=SAY, bare=False):
    """Probability of collapse and its interval in whole per cent; no interval where both are 0.

    A `bare` interval leaves the sign of per cent out.
    """
    if row.probability_high < SURE:
        return say("verdict.share.under"), ""
    if row.probability_low > 1.0 - SURE:
        return say("verdict.share.over"), ""
    ends = {"low": 100 * row.probability_low, "high": 100 * row.probability_high}
    key = "verdict.share.interval_bare" if bare else "verdict.share.interval"
    return say.number(row.probability, "percent"), say(key, **ends)


def gives_way(row):
    """Whether d_SLV is where a tie or an anchor fails, not 0.4 d0."""
    return row["d_slv_m"] < 0.4 * row["d0_m"] * (1.0 - ROUNDED)


def relied_on(models):
    """Model that the rate rests on: W2m where it is among them, else the last; None without any."""
    models = list(dict.fromkeys(models))
    return None if not models else GOVERNS if GOVERNS in models else models[-1]


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


def outcome(by_hand, held):
    """Key of the first sentence, by what `passes` says."""
    if not by_hand:
        return "fails"
    return "by_hand" if held is None else "passes" if held else "under_motions"


def headline(tables, about, fit=None, say=SAY):
    """What the report says first: the verdict, the check by hand, the dynamic check, what is left.

    Tables are the report's by name: code_checks, mechanisms, verdicts and shaken. `about` has when
    (`when`), factor (the FC that was used) and wall (`walls.named`), `fit` is of
    `selection.fit_of`.
    """
    checks, mechanisms, verdicts, shaken = (
        tables[key] for key in ("code_checks", "mechanisms", "verdicts", "shaken")
    )
    by_hand, held = passes(checks, mechanisms, verdicts)
    demand_g, stated = checks["pga_demand_g"].iloc[0], as_stated(mechanisms)
    share = stated["pga_fails_g"].iloc[0] / demand_g
    key = f"verdict.first.{outcome(by_hand, held)}"
    first = say(key, demand_g=demand_g, share=share, **about)
    governed = _governed(verdicts, shaken, held, fit, say)
    return [first, kinematic(stated, demand_g, say), governed + by_hand_alone(shaken, say)]


def when(assessment, say=SAY):
    """What the demand is, to begin a sentence with; of section assessment."""
    stated = assessment["spectrum"] or (assessment["ag_g"] is not None)
    if stated and not assessment["hazard"]:
        return say("verdict.when.stated")
    return say("verdict.when.return_period", years=assessment["return_period_years"])


def capacity(stated, demand_g, period, say=SAY):
    """ζE and the return period of the PGA at which the weakest mechanism's check by hand fails.

    `period` is that of the capacity as `national.return_period_of` has it; None without rows of the
    hazard.
    """
    ratio = stated["pga_fails_g"].iloc[0] / demand_g
    told = say("verdict.capacity.ratio", ratio=ratio)
    if period is None:
        return say("verdict.capacity.unknown", ratio=told)
    key, years = period
    return say(f"verdict.capacity.{key}", ratio=told, years=years)


def early(stated, say=SAY):
    """Sentence on mechanisms whose ties or anchors give way early; nothing where there are none.

    Both numbers are told: by the letter, and without these links.
    """
    rows = stated[stated["links_left_out"] > 0]
    each = [
        say(
            "verdict.kinematic.early_one",
            name=names.short(r, say),
            letter_g=r.pga_letter_g,
            pga_g=r.pga_fails_g,
        )
        for r in rows.itertuples()
    ]
    return say("verdict.kinematic.early", each="; ".join(each)) if each else ""


def _governed(verdicts, shaken, held, fit, say):
    """The dynamic check of the model and mechanism that decide, and what the others say."""
    if held is None:
        return say("verdict.dynamic.not_made")
    model = decided_by(verdicts)
    rows = {row.part: row for row in shaken.itertuples()}
    worst = deciding(verdicts).set_index("model")
    row = worst.loc[model]
    key = "verdict.dynamic.fulfilled" if held else "verdict.dynamic.failed"
    words = say.count(key, verdicts["part"].nunique())
    mechanism = rows[row["part"]]
    about = {"model": model, "name": names.the(mechanism, say), "motions": row["motions"]}
    moves = "joint" if names.kind_of(mechanism) == names.BENDING else "top"
    lengths = {"mean_m": row["mean_d_m"], "slv_m": row["d_slv_m"]}
    words += " " + say(f"verdict.dynamic.governs_{moves}", **about, **lengths)
    if row["exceed_d0"]:
        words += say("verdict.dynamic.beyond", count=row["exceed_d0"])
    if row["slv"] and not held:
        words += say("verdict.dynamic.doubt", share=row["agree"])
    elif row["agree"] < LEAST_DRAWS:
        words += say("verdict.dynamic.draws", share=row["agree"])
    words += "." + _others(surely(worst).drop(model), say)
    if fit is not None and not fit[2]:
        words += say("verdict.dynamic.misfit")
    return words


def _others(sure, say):
    """What the check says with the other models: `sure` has by model whether it is fulfilled."""
    told = {"fulfilled": list(sure.index[sure]), "failed": list(sure.index[~sure])}
    return "".join(
        say(f"verdict.dynamic.others_{key}", models=say.all_of(models))
        for key, models in told.items()
        if models
    )


def kinematic(stated, demand_g, say=SAY):
    """The non-linear kinematic check of the weakest mechanism."""
    least = next(stated.itertuples())
    share = least.pga_fails_g / demand_g
    about = {"count": len(stated), "name": names.the(least, say), "pga_g": least.pga_fails_g}
    key = "verdict.kinematic.passes" if share >= 1.0 else "verdict.kinematic.fails"
    return say(key, **about, share=share, demand_g=demand_g) + early(stated, say)


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
    """Key of whether each row of verdicts is fulfilled for SLV: HELD, LOST, DOUBT."""
    sure = surely(verdicts)
    keys = sure.map({True: HELD, False: LOST})
    return keys.mask(~sure & verdicts["slv"].astype(bool), DOUBT)


def by_hand_alone(shaken, say=SAY):
    """End of a paragraph: which mechanisms were not shaken, and why; nothing where there are none.

    Each is named with the PGA at which it fails by hand.
    """
    left, told = shaken[shaken["shaken"] == 0], []
    for why, part in left.groupby("why_not", sort=False):
        each = [
            say("verdict.left.name", name=name, pga_g=pga_g) for name, pga_g in together(part, say)
        ]
        reason = say(f"verdict.why.{why}")
        told.append(say("verdict.left.one", names=say.all_of(each), why=reason))
    return say("verdict.left.all", each="; ".join(told)) if told else ""


def together(rows, say=SAY):
    """Names of mechanisms and the PGA at which each fails [g], two corners that are alike as one.

    Corners have a key of their own, `why_not`.
    """
    corners = rows["why_not"] == CORNER
    if corners.sum() == 2 and rows.loc[corners, "pga_fails_g"].round(6).nunique() == 1:
        named = [(names.short(r, say), r.pga_fails_g) for r in rows[~corners].itertuples()]
        both = say("mechanism.both_corners")
        return [*named, (both, rows.loc[corners, "pga_fails_g"].iloc[0])]
    return [(names.short(r, say), r.pga_fails_g) for r in rows.itertuples()]


def no_rate(dynamic, config, say=SAY):
    """Why there is no annual rate: what has to be stated or given."""
    wants = []
    if not config["assessment"]["hazard"] and config["risk"]["hazard"] is None:
        wants.append(say("verdict.no_rate.hazard"))
    if dynamic["stations"].max() < FEWEST:
        wants.append(say("verdict.no_rate.motions", fewest=FEWEST))
    return say("verdict.no_rate.all", wants=say.all_of(wants))


def suite(dynamic, several=False, say=SAY):
    """Collapse under all motions of the run, by the first of several parts."""
    stations = int(dynamic["stations"].max())
    if stations < FEWEST:
        each = [
            say(
                "verdict.suite.fell",
                model=r.model,
                fell=r.fell_at_demand,
                curves=r.curves,
                least_g=r.least_pga_g,
            )
            for r in dynamic.itertuples()
        ]
        return say.count("verdict.suite.few", stations, each="; ".join(each), fewest=FEWEST)
    each = []
    for r in dynamic.itertuples():
        share, interval = collapses(r, say)
        each.append(say("verdict.suite.of_model", share=share, model=r.model, interval=interval))
    key = "verdict.suite.several" if several else "verdict.suite.whole"
    return say(key, stations=stations, each=", ".join(each))
