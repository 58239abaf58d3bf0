"""What a report recommends next."""

from studies.assess import names
from studies.assess.catalogue import SAY
from studies.assess.code_tables import DAMAGED_KEYS
from studies.assess.dynamic_check import LEAST_DRAWS, surely
from studies.assess.verdict import as_stated, deciding, gives_way

OTHERS = {"en": "eurocode"}  # keys by the first part of a check's key


def damage(sensitivity, mechanisms, demand_g, say=SAY):
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
    damping = next(damping for damping, key in DAMAGED_KEYS.items() if key == worst["key"])
    about = {"factor": worst["factor"], "damping": damping, "share": worst["ratio"]}
    return say("advice.damage", **about)


def next_steps(tables, *more, say=SAY):
    """What is recommended next, a line each; `more`: lines of others, empty ones left out.

    Tables are the report's by name, as of `verdict.headline`.
    """
    checks, mechanisms, verdicts, shaken = (
        tables[key] for key in ("code_checks", "mechanisms", "verdicts", "shaken")
    )
    fails = mechanisms["pga_fails_g"] < checks["pga_demand_g"].iloc[0]
    weak = as_stated(mechanisms[fails])
    lines = _by_hand_next(checks, weak, say) + _shaken_next(deciding(verdicts), weak.empty, say)
    least = next(as_stated(mechanisms).itertuples())
    if least.part not in set(shaken.loc[shaken["shaken"] == 1, "part"]):
        lines.append(say("advice.not_shaken", name=names.the(least, say)))
    lines += [line for line in more if line]
    return lines or [say("advice.nothing")]


def _by_hand_next(checks, weak, say):
    """Lines on the checks by hand; `weak` are the mechanisms that fail by them."""
    if len(weak):
        each = [
            say("verdict.left.name", name=names.short(r, say), pga_g=r.pga_fails_g)
            for r in weak.itertuples()
        ]
        return [say("advice.hold", each="; ".join(each)), say("advice.on_site")]
    lines = []
    linear = checks[checks["check"].isin(("linear_ground", "linear_height"))]
    if (linear["ratio"] < 1.0).any():
        lines.append(say("advice.linear"))
    fails = checks[checks["ratio"] < 1.0]
    worst = fails.groupby(fails["check"].str.split("_").str[0])["ratio"].min()
    failed = [
        say("advice.other", name=say(f"advice.{OTHERS[key]}"), share=ratio)
        for key, ratio in worst.items()
        if key in OTHERS
    ]
    return [*lines, say("advice.others", each=", ".join(failed))] if failed else lines


def _shaken_next(verdicts, by_hand, say):
    """Lines on the dynamic check; `by_hand`: whether the façade passes by hand."""
    if verdicts.empty:
        return [say("advice.motions")]
    lines, lost = [], list(verdicts.loc[~surely(verdicts), "model"])
    if lost and by_hand:
        lines.append(say("advice.dynamic", models=say.all_of(lost)))
    yields = [row["d_slv_m"] for _, row in verdicts.iterrows() if lost and gives_way(row)]
    if yields:
        lines.append(say("advice.anchors", slv_m=min(yields)))
    if (verdicts["agree"] < LEAST_DRAWS).any():
        lines.append(say("advice.more_motions"))
    return lines
