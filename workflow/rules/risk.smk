# Rate of collapse at a site, from a hazard curve and the fragility of the run; fragilities as OpenQuake
# reads them. Ask for `risk`, with `risk: {hazard: <file>}`.
wildcard_constraints:
    im="|".join(MEASURES),
    form="continuous|discrete",


rule risk:
    input:
        with_pages(STUDY.per_run(RISK.results)),


rule risk_rate:
    input:
        brackets="results/{run}/fragility/brackets.csv",
        hazard=RISK.hazard,
        modules=code("risk/risk_rate"),
    output:
        table="results/{run}/tables/risk.csv",
        deaggregation="results/{run}/risk/deaggregation.csv",
    log:
        "results/{run}/logs/risk_rate.log",
    params:
        risk=lambda w: STUDY.cfg(w)["risk"],
        fragility=lambda w: STUDY.cfg(w)["fragility"],
        period_s=lambda w: STUDY.cfg(w)["smdof"]["period_s"],
    script:
        "../scripts/risk/risk_rate.py"


rule figure_risk:
    input:
        table="results/{run}/tables/risk.csv",
        deaggregation="results/{run}/risk/deaggregation.csv",
        curves="results/{run}/fragility/curves.csv",
        facts=STUDY.record_facts,
        hazard=RISK.hazard,
        modules=code("risk/figure_risk"),
    output:
        **figure("risk", "Risk", "hazard, fragility and rate of collapse"),
    log:
        "results/{run}/logs/figure_risk.log",
    params:
        risk=lambda w: STUDY.cfg(w)["risk"],
        confidence=lambda w: STUDY.cfg(w)["fragility"]["confidence"],
        period_s=lambda w: STUDY.cfg(w)["smdof"]["period_s"],
    script:
        "../scripts/risk/figure_risk.py"


rule fragility_nrml:
    input:
        fragility="results/{run}/tables/fragility.csv",
        modules=code("fragility/fragility_nrml"),
    output:
        "results/{run}/fragility/nrml_{im}_{form}.xml",
    log:
        "results/{run}/logs/fragility_nrml_{im}_{form}.log",
    params:
        period_s=lambda w: STUDY.cfg(w)["smdof"]["period_s"],
    script:
        "../scripts/fragility/fragility_nrml.py"
