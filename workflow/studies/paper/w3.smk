# Static capacities beside kinematic ones, and W3 with one thing changed at a time.
from rocking.pushover import DRAWN, VARIANTS, laid

DRAWN_VARIANTS = [*(f"header_{rule}" for rule in DRAWN), "default"]  # of Figure 8


def pushover_curves(wildcards):
    """Capacity curves compared with kinematic ones, which are known of plain façades alone."""
    RUNS.needs_plain(wildcards.run, "the kinematic curve")
    models = RUNS.cfg(wildcards)["pushover"]["models"]
    return of_run(rules.pushover_curve.output[0], pushed=models)(wildcards)


def laid_variants(run):
    """Variants of W3 whose bricks can be laid in a run's façade."""
    try:
        return laid(RUNS.settings[run])
    except ValueError as error:
        stop(error)


wildcard_constraints:
    variant="|".join(re.escape(name) for name in VARIANTS),


use rule pushover_case as pushover_variant_case with:
    output:
        results("w3/cases/{variant}.json"),
    log:
        logs("w3_case_{variant}"),


use rule pushover as pushover_variant with:
    input:
        case=rules.pushover_variant_case.output[0],
        yade=rules.yade_check.output[0],
        modules=command_code("pushover"),
    output:
        curve=results("w3/{variant}.csv"),
        forces=results("w3/{variant}_forces.csv"),
    log:
        logs("w3_{variant}"),
    benchmark:
        benchmarks("w3_{variant}")


rule table_pushover:
    input:
        curves=pushover_curves,
        cases=of_run(rules.pushover_variant_case.output[0], variant=laid_variants),
        raw=of_run(rules.pushover_variant.output.curve, variant=laid_variants),
        forces=of_run(rules.pushover_variant.output.forces, variant=laid_variants),
    output:
        shown_table("pushover", "Boundary conditions", "static capacities"),
    script:
        "scripts/table_pushover.py"


figure_by(
    "studies/paper/scripts/fig08_w3",
    "fig08_w3",
    "Boundary conditions",
    "8: W3 and its capacity curve",
    cases=of_run(rules.pushover_variant_case.output[0], variant=DRAWN_VARIANTS),
    raw=of_run(rules.pushover_variant.output.curve, variant=DRAWN_VARIANTS),
    forces=of_run(rules.pushover_variant.output.forces, variant=DRAWN_VARIANTS),
)
