# The answer of codes of practice beside the dynamic one; a report for one façade.
COMPARED = f"results/{STUDY.name}/assessment"


rule assess:
    input:
        STUDY.per_run(ASSESSMENT.reports),


rule code_against_dynamics:
    input:
        f"{COMPARED}/code_against_dynamics.csv",


rule assess_collapse:
    input:
        scene="results/{run}/scenes/{model}.json",
        table=lambda w: STUDY.table_path(w.run),
        records=lambda w: STUDY.record_files(w),
        modules=code("assess/assess_collapse"),
    output:
        "results/{run}/assessment/collapse_{model}.csv",
    log:
        "results/{run}/logs/assess_collapse_{model}.log",
    benchmark:
        "results/{run}/benchmarks/assess_collapse_{model}.tsv"
    params:
        table=lambda w: STUDY.table_path(w.run),
        records=lambda w: STUDY.records[w.run],
        settings=STUDY.params_of(
            "directions", "baseline", "seed", "vertical_motion", "ida.max_pga_g"
        ),
    script:
        "../scripts/assess/assess_collapse.py"


rule assess_checks:
    input:
        table=lambda w: STUDY.table_path(w.run),
        records=lambda w: STUDY.record_files(w),
        modules=code("assess/assess_checks"),
    output:
        "results/{run}/assessment/checks_by_record.csv",
    log:
        "results/{run}/logs/assess_checks.log",
    params:
        table=lambda w: STUDY.table_path(w.run),
        records=ASSESSMENT.stations,
        settings=STUDY.params_of(
            "facade",
            "smdof",
            "assessment",
            "directions",
            "baseline",
            "seed",
            "ida.max_pga_g",
        ),
    script:
        "../scripts/assess/assess_checks.py"


rule assess_floor_spectra:
    input:
        table=lambda w: STUDY.table_path(w.run),
        records=lambda w: STUDY.record_files(w),
        facts=STUDY.record_facts,
        modules=code("assess/assess_floor_spectra"),
    output:
        **figure(
            "floor_spectra", "Code of practice", "floor spectra, formula over chain"
        ),
        table="results/{run}/assessment/floor_spectra.csv",
    log:
        "results/{run}/logs/assess_floor_spectra.log",
    params:
        table=lambda w: STUDY.table_path(w.run),
        records=lambda w: STUDY.records[w.run],
        settings=STUDY.params_of("smdof", "baseline", "seed"),
    script:
        "../scripts/assess/assess_floor_spectra.py"


rule compare_code_and_dynamics:
    input:
        tables=ASSESSMENT.compared,
        facts=STUDY.all_facts,
        modules=code("assess/code_against_dynamics"),
    output:
        table=f"{COMPARED}/code_against_dynamics.csv",
        ratios=f"{COMPARED}/code_ratios.csv",
        png=report(
            f"{COMPARED}/code_against_dynamics.png",
            caption=caption("code_against_dynamics"),
            category="Code of practice",
            labels={"run": STUDY.name, "result": "PGA of checks over PGA of collapse"},
        ),
        pdf=f"{COMPARED}/code_against_dynamics.pdf",
        groups_png=report(
            f"{COMPARED}/code_unsafe_share.png",
            caption=caption("code_against_dynamics"),
            category="Code of practice",
            labels={"run": STUDY.name, "result": "where the checks are unsafe"},
        ),
        groups_pdf=f"{COMPARED}/code_unsafe_share.pdf",
    log:
        f"results/{STUDY.name}/logs/compare_code_and_dynamics.log",
    params:
        runs=ASSESSMENT.facts,
        resamples=lambda w: next(iter(STUDY.runs.values()))["assessment"]["resamples"],
        seed=lambda w: next(iter(STUDY.runs.values()))["seed"],
    script:
        "../scripts/assess/code_against_dynamics.py"


rule assess_code:
    input:
        site=ASSESSMENT.site,
        spectrum=ASSESSMENT.spectrum,
        hazard=ASSESSMENT.hazard,
        table=lambda w: STUDY.table_path(w.run),
        records=lambda w: STUDY.record_files(w),
        modules=code("assess/assess_code"),
    output:
        checks="results/{run}/assessment/code_checks.csv",
        steps="results/{run}/assessment/code_steps.csv",
        curve="results/{run}/assessment/capacity_curve.csv",
        sensitivity="results/{run}/assessment/code_sensitivity.csv",
        mechanisms="results/{run}/assessment/mechanisms.csv",
        spectra="results/{run}/assessment/spectra.csv",
    log:
        "results/{run}/logs/assess_code.log",
    params:
        table=lambda w: STUDY.table_path(w.run),
        records=lambda w: STUDY.records[w.run],
        settings=STUDY.params_of(
            "facade", "smdof", "assessment", "baseline", "seed", "risk.site"
        ),
    script:
        "../scripts/assess/assess_code.py"


rule assess_dynamic:
    input:
        collapse=lambda w: ASSESSMENT.collapse(w.run),
        checks="results/{run}/assessment/code_checks.csv",
        hazard=ASSESSMENT.hazard,
        modules=code("assess/assess_dynamic"),
    output:
        table="results/{run}/assessment/dynamic.csv",
        curves="results/{run}/assessment/dynamic_curves.csv",
    log:
        "results/{run}/logs/assess_dynamic.log",
    params:
        stations=ASSESSMENT.stations,
        period_s=lambda w: STUDY.cfg(w)["smdof"]["period_s"],
        site=lambda w: STUDY.cfg(w)["risk"]["site"],
        resamples=lambda w: STUDY.cfg(w)["assessment"]["resamples"],
        seed=lambda w: STUDY.cfg(w)["seed"],
    script:
        "../scripts/assess/assess_dynamic.py"


rule assess_sensitivity:
    input:
        scene=ASSESSMENT.scene,
        table=lambda w: STUDY.table_path(w.run),
        records=lambda w: STUDY.record_files(w),
        modules=code("assess/assess_sensitivity"),
    output:
        "results/{run}/assessment/dynamic_sensitivity.csv",
    log:
        "results/{run}/logs/assess_sensitivity.log",
    params:
        table=lambda w: STUDY.table_path(w.run),
        records=lambda w: STUDY.records[w.run],
        settings=STUDY.params_of(
            "directions", "baseline", "seed", "vertical_motion", "ida.max_pga_g"
        ),
    script:
        "../scripts/assess/assess_sensitivity.py"


rule assess_report:
    input:
        tables=ASSESSMENT.tables,
        site=ASSESSMENT.site,
        scene=ASSESSMENT.scene,
        table=lambda w: STUDY.table_path(w.run),
        modules=code("assess/assess_report"),
    output:
        html="results/{run}/assessment/report.html",
        pdf="results/{run}/assessment/report.pdf",
    log:
        "results/{run}/logs/assess_report.log",
    params:
        run=lambda w: w.run,
        table=lambda w: STUDY.table_path(w.run),
        stations=ASSESSMENT.stations,
        settings=STUDY.params_of(
            "facade",
            "return_wall",
            "smdof",
            "damping",
            "assessment",
            "directions",
            "seed",
        ),
    script:
        "../scripts/assess/assess_report.py"
