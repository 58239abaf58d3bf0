# How far codes of practice are from the dynamic answer, over many façades; the rules of one façade are in
# assess.smk.
COMPARED = results("assessment").format(run=RUNS.name)


def compared_facades(wildcards):
    """What each run's façade is and which files are its own, as JSON."""
    facts = {}
    for run, resolved in RUNS.settings.items():
        job = Of(run=run)
        h, b = (resolved["facade"][k] for k in ("height_m", "thickness_m"))
        facts[run] = {
            "height_m": h,
            "slenderness": round(h / b, 2),
            "period_s": resolved["smdof"]["period_s"],
            "checks": of_run(rules.assess_checks.output[0])(job),
            "collapse": COLLAPSE(job),
            "parts": GOVERNING_COLLAPSE(job),
            "levels": of_run(rules.assess_levels.output[0])(job),
        }
    return json.dumps(facts, sort_keys=True)


rule assess_checks:
    input:
        **MOTIONS,
    output:
        results("assessment/checks_by_record.csv"),
    params:
        table=lambda w: RUNS.table_path(w.run),
        records=stations,
        settings=RUNS.params_of(*CHECKED, "directions", "baseline", "seed"),
    script:
        "scripts/assess_checks.py"


rule assess_governing:
    input:
        cases=of_run(rules.facade_case.output[0], model=dry),
    output:
        results("assessment/governing.csv"),
    params:
        settings=RUNS.params_of(*CHECKED),
    script:
        "scripts/assess_governing.py"


use rule assess_collapse as assess_governing_collapse with:
    input:
        **MOTIONS,
        case=rules.facade_case.output[0],
        shaken=rules.assess_governing.output[0],
    output:
        results("assessment/governing_collapse_{model}.csv"),
    benchmark:
        benchmarks("assess_governing_collapse_{model}")


GOVERNING_COLLAPSE = of_run(rules.assess_governing_collapse.output[0], model=dry)


rule assess_levels:
    input:
        **MOTIONS,
        shaken=rules.assess_governing.output[0],
        cases=of_run(rules.facade_case.output[0], model=dry),
    output:
        results("assessment/dynamic_levels.csv"),
    params:
        table=lambda w: RUNS.table_path(w.run),
        stations=stations,
        settings=RUNS.params_of(*CHECKED, "directions", "baseline", "seed", "vertical_motion"),
    script:
        "scripts/assess_levels.py"


rule compare_code_and_dynamics:
    input:
        tables=every_run(rules.assess_checks.output[0], COLLAPSE, GOVERNING_COLLAPSE),
        facts=every_run(rules.record.output.facts),
    output:
        table=f"{COMPARED}/code_against_dynamics.csv",
        ratios=f"{COMPARED}/code_ratios.csv",
        png=shown(
            f"{COMPARED}/code_against_dynamics.png",
            "code_against_dynamics",
            "Code of practice",
            "PGA of checks over PGA of collapse",
            run=RUNS.name,
        ),
        pdf=f"{COMPARED}/code_against_dynamics.pdf",
    log:
        logs("compare_code_and_dynamics").format(run=RUNS.name),
    params:
        runs=compared_facades,
        resamples=lambda w: next(iter(RUNS.settings.values()))["assessment"]["resamples"],
        seed=lambda w: next(iter(RUNS.settings.values()))["seed"],
    script:
        "scripts/code_against_dynamics.py"


rule compare_kinematic_and_dynamic:
    input:
        levels=every_run(rules.assess_levels.output[0]),
        collapse=every_run(COLLAPSE, GOVERNING_COLLAPSE),
    output:
        levels=f"{COMPARED}/dynamic_levels_all.csv",
        table=f"{COMPARED}/dynamic_against_kinematic.csv",
        parts=f"{COMPARED}/parts_against_whole.csv",
    log:
        logs("compare_kinematic_and_dynamic").format(run=RUNS.name),
    params:
        runs=compared_facades,
    script:
        "scripts/dynamic_against_kinematic.py"


rule code_against_dynamics:
    """
    With its scenario: twelve façades, how far the codes' checks are from the dynamic answer.
    Costs: 17 min, 9 on two free cores; by façades and records.
    Page: docs/assessment.md
    """
    input:
        rules.compare_code_and_dynamics.output.table,
        rules.compare_kinematic_and_dynamic.output.table,
