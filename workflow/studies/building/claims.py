"""What the study's section 2 says of the building, as statements that a run can bear out or not."""

from studies.building.comparison import PAPER_WME
from studies.shared.statements import OURS, STUDY, statement

PERIOD_TOLERANCE_S = 0.01  # ours: the last digit of the study's periods
DIFFERENCE_S = 0.025  # the study's 0.02 s with half the last digit of both periods
SMALL_WME = max(abs(row[4] - row[3]) for row in PAPER_WME.values())  # "minimal difference"
UNDISTURBED = 0.05  # ours: WME of displacements with and without rattling


def principal(modes, model, direction):
    """Period [s] and effective mass ratio of the mode of a model that carries most in a direction.

    Modes are those of tables/building_modes.csv; directions "y" (translation out of plane of the
    façade), "rz" (rotation about the vertical), …
    """
    part = modes[(modes["model"] == model) & (modes["direction"] == direction)]
    row = part.loc[part["effective_mass_ratio"].idxmax()]
    return float(row["period_s"]), float(row["effective_mass_ratio"])


def evaluate(modes, wme, explicit):
    """Rows (`studies.shared.statements`) of every claim of section 2.

    Tables are building_modes.csv, wme.csv, and building_explicit_{record}.csv by record.
    """
    rows = _of_modes(modes)
    if len(wme):
        rows += _of_chains(wme)
    return rows + [_rattling(record, table) for record, table in explicit.items()]


def _of_modes(modes):
    period = {
        (model, direction): principal(modes, model, direction)[0]
        for model in ("CBDEM", "SBDEM")
        for direction in ("y", "rz")
    }
    rows = []
    for model, y, rz in (("CBDEM", 0.25, 0.16), ("SBDEM", 0.27, 0.17)):
        periods = period[model, "y"], period[model, "rz"]
        good = max(abs(periods[0] - y), abs(periods[1] - rz)) <= PERIOD_TOLERANCE_S + 1e-9
        rows.append(
            statement(
                f"periods of {model}: translation along y, rotation about z",
                f"{y:g} s, {rz:g} s",
                f"{periods[0]:.3f} s, {periods[1]:.3f} s (within {PERIOD_TOLERANCE_S:g} s)",
                good,
                OURS,
            )
        )
    change = [period["SBDEM", d] - period["CBDEM", d] for d in ("y", "rz")]
    rows.append(
        statement(
            "SBDEM's periods differ from CBDEM's by 0.01-0.02 s",
            "+0.02 s, +0.01 s",
            f"{change[0]:+.3f} s, {change[1]:+.3f} s",
            max(abs(c) for c in change) <= DIFFERENCE_S,
            STUDY,
        )
    )
    return rows


def _of_chains(wme):
    table = wme.pivot_table(index=["record", "quantity"], columns="n_dof", values="wme")
    records = ", ".join(sorted(wme["record"].unique()))
    difference = (table[5] - table[4]).abs()
    means = table.mean()
    gain = (table[4] - table[2]).to_numpy()
    return [
        statement(
            "4DOF and 5DOF have minimal difference",
            f"at most {SMALL_WME:.3f} (Table 2)",
            f"at most {difference.max():.3f}",
            difference.max() <= SMALL_WME + 1e-9,
            STUDY,
            records,
        ),
        statement(
            "4DOF suffices: no other chain has a lower mean error by more than that difference",
            f"mean {_paper_mean(4):.3f} at n = 4, {_paper_mean(5):.3f} at n = 5",
            f"mean {means[4]:.3f} at n = 4, lowest {means.min():.3f} at n = {means.idxmin()}",
            means[4] - means.min() <= SMALL_WME + 1e-9,
            STUDY,
            records,
        ),
        statement(
            "4DOF is closer than 2DOF with masses at the floors",
            "in all six comparisons of Table 2",
            f"in {int((gain < 0.0).sum())} of {len(gain)}; mean difference {gain.mean():+.3f}",
            bool((gain < 0.0).all()),
            STUDY,
            records,
        ),
    ]


def _paper_mean(n):
    return sum(row[n - 1] for row in PAPER_WME.values()) / len(PAPER_WME)


def _rattling(record, table):
    """WME of the explicit run under sudden gravity against the modal run that has none."""
    part = table[(table["explicit"] == "sudden gravity") & (table["modal"] == "without dead load")]
    by = part.set_index(["point", "quantity"])["wme"]
    main = by.xs("displacement", level="quantity")
    return statement(
        "rattling does not affect the main response of the building",
        "main response about 0.27 s, noise about 0.08 s",
        f"displacements change by {100 * main.max():.1f} % (limit {100 * UNDISTURBED:g} %); "
        f"the corner's acceleration by {100 * by['wall corner', 'acceleration']:.1f} %",
        main.max() <= UNDISTURBED,
        OURS,
        record,
    )
