# The answer of codes of practice beside the dynamic one; a report for one façade.
COMPARED = f"results/{STUDY.name}/assessment"


rule code_against_dynamics:
    input:
        f"{COMPARED}/code_against_dynamics.csv",


rule assess_collapse:
    input:
        scene="results/{run}/scenes/{model}.json",
        table=lambda w: STUDY.table_path(w.run),
        records=lambda w: STUDY.record_files(w),
        modules=code("assess_collapse"),
    output:
        "results/{run}/assessment/collapse_{model}.csv",
    log:
        "results/{run}/logs/assess_collapse_{model}.log",
    benchmark:
        "results/{run}/benchmarks/assess_collapse_{model}.tsv"
    params:
        table=lambda w: STUDY.table_path(w.run),
        records=lambda w: STUDY.records[w.run],
        settings=STUDY.params_of("directions", "baseline", "seed", "ida.max_pga_g"),
    script:
        "../scripts/assess_collapse.py"


rule assess_checks:
    input:
        table=lambda w: STUDY.table_path(w.run),
        records=lambda w: STUDY.record_files(w),
        modules=code("assess_checks"),
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
        "../scripts/assess_checks.py"


rule assess_floor_spectra:
    input:
        table=lambda w: STUDY.table_path(w.run),
        records=lambda w: STUDY.record_files(w),
        modules=code("assess_floor_spectra"),
    output:
        table="results/{run}/assessment/floor_spectra.csv",
        png=report(
            "results/{run}/figures/floor_spectra.png",
            caption=caption("floor_spectra"),
            category="Code of practice",
            labels={"run": "{run}", "result": "floor spectra, formula over chain"},
        ),
        pdf="results/{run}/figures/floor_spectra.pdf",
    log:
        "results/{run}/logs/assess_floor_spectra.log",
    params:
        table=lambda w: STUDY.table_path(w.run),
        records=lambda w: STUDY.records[w.run],
        settings=STUDY.params_of("smdof", "baseline", "seed"),
    script:
        "../scripts/assess_floor_spectra.py"


rule compare_code_and_dynamics:
    input:
        tables=ASSESSMENT.compared,
        modules=code("code_against_dynamics"),
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
        "../scripts/code_against_dynamics.py"
