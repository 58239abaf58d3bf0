# Rate of collapse at a site, from a hazard curve and the fragility of the run.
# Ask for `risk`, with `risk: {hazard: <file>}`.
from studies.shared.hazard import HazardError
from studies.risk.stated import stated_hazard


include: "fragility.smk"


def hazard(wildcards):
    """File of a run's hazard curve; what is wrong with it ends the workflow in one line."""
    try:
        return stated_hazard(RUNS.cfg(wildcards), RUNS.find_file)
    except HazardError as error:
        stop(error)


rule risk_rate:
    input:
        collapse=rules.ida_collapse.output.collapse,
        probability=rules.ida_collapse.output.probability,
        brackets=rules.fragility_table.output.brackets,
        factors=rules.fragility_table.output.factors,
        hazard=hazard,
    output:
        table=results("tables/risk.csv"),
        deaggregation=results("risk/deaggregation.csv"),
    params:
        risk=value_of("risk"),
        fragility=value_of("fragility"),
        period_s=value_of("smdof.period_s"),
    script:
        "scripts/risk_rate.py"


figure_by(
    "studies/risk/scripts/figure_risk",
    "risk",
    "Risk",
    "hazard, fragility and rate of collapse",
    table=rules.risk_rate.output.table,
    deaggregation=rules.risk_rate.output.deaggregation,
    curves=rules.fragility_table.output.curves,
    facts=of_run(rules.record.output.facts),
    hazard=hazard,
    params=dict(
        risk=value_of("risk"),
        confidence=value_of("fragility.confidence"),
        min_stations=value_of("fragility.min_stations"),
        period_s=value_of("smdof.period_s"),
    ),
)


rule risk:
    """
    Annual rate and 50-year probability of collapse, with a hazard curve.
    Costs: as `fragility`.
    Page: docs/risk.md
    """
    input:
        every_run(rules.risk_rate.output, rules.figure_risk.output.png),
