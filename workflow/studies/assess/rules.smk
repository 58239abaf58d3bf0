# The answer of codes of practice compared with the dynamic one: a report for one façade. Over many façades:
# code_against_dynamics.smk.
from studies.assess import inputs as assessed
from studies.assess.held import GOVERNS, SETTLED
from rocking.stations import turns

COMMIT = version.commit(40) or "none"


def checked(function):
    """Input function: a file of the configuration that `function` finds, in a list; none for None."""

    def files(wildcards):
        try:
            path = function(RUNS.cfg(wildcards), RUNS.find_file)
        except ValueError as error:
            stop(error)
        return [] if path is None else [path]

    return files


SPECTRUM = checked(assessed.spectrum_file)
HAZARD = checked(assessed.hazard_file)


SITES: dict[str, list] = {}


def site(wildcards):
    """Files that say how the site shakes; what is missing ends the workflow in one line."""
    if wildcards.run not in SITES:
        try:
            assessed.check_stated(RUNS.stated[wildcards.run], RUNS.cfg(wildcards)["models"])
            assessed.check_mechanisms(RUNS.cfg(wildcards))
            files = SPECTRUM(wildcards) + HAZARD(wildcards)
            assessed.check_demand(RUNS.cfg(wildcards), *files)
        except ValueError as error:
            stop(error)
        SITES[wildcards.run] = files
    return SITES[wildcards.run]


def printed(wildcards):
    """The same for the report, whose PDF needs a package that `make run` does not install."""
    try:
        assessed.check_printer()
    except ValueError as error:
        stop(error)
    return site(wildcards)


def stated(wildcards):
    """Keys that a run's configuration states, to be told from defaults."""
    return sorted(assessed.every_value(RUNS.stated[wildcards.run]))


def numbers_of(*paths):
    """`RUNS.params_of` without what the report alone shows: other words compute nothing anew."""
    read = RUNS.params_of(*paths)
    return lambda wildcards: assessed.without_words(read(wildcards))


CHECKED = ("facade", "return_wall", "smdof", "assessment")  # what a code's checks read
OF_CODE = numbers_of(*CHECKED, "baseline", "seed", "risk.site")
HELD_BY = [f"assessment.{key}" for key in SETTLED]
MOTIONS = {  # the records table and its files, as inputs
    "table": lambda w: RUNS.table_path(w.run),
    "records": RUNS.record_files,
}


def dry(run):
    """Models of a run that the planar solver stands in for and whose joint is dry."""
    return [model for model in RUNS.compiled(run) if not MODELS[model].bonded]


def governing(run):
    """Model that the rate rests on: W2m where it is among them, else the last of them."""
    models = dry(run)
    if not models:
        stop("models: expected W1, W2 or W2m among them for assess")
    return GOVERNS if GOVERNS in models else models[-1]


def curves(wildcards):
    """Record and direction of every curve of collapse: each component of a station in one."""
    return turns(stations(wildcards), RUNS.cfg(wildcards)["directions"])


rule assess_collapse:
    input:
        **MOTIONS,
        case=rules.facade_case.output[0],
    output:
        results("assessment/collapse_{model}.csv"),
    benchmark:
        benchmarks("assess_collapse_{model}")
    params:
        table=lambda w: RUNS.table_path(w.run),
        curves=curves,
        settings=RUNS.params_of("baseline", "seed", "vertical_motion", "ida.max_pga_g", *HELD_BY),
    script:
        "scripts/assess_collapse.py"


COLLAPSE = of_run(rules.assess_collapse.output[0], model=dry)


rule assess_code:
    input:
        **MOTIONS,
        site=site,
        spectrum=SPECTRUM,
        hazard=HAZARD,
        cases=of_run(rules.facade_case.output[0], model=dry),
    output:
        checks=results("assessment/code_checks.csv"),
        steps=results("assessment/code_steps.csv"),
        curve=results("assessment/capacity_curve.csv"),
        sensitivity=results("assessment/code_sensitivity.csv"),
        mechanisms=results("assessment/mechanisms.csv"),
        spectra=results("assessment/spectra.csv"),
        shaken=results("assessment/shaken.csv"),
    benchmark:
        benchmarks("assess_code")
    priority: 2  # the longest jobs wait for it
    params:
        table=lambda w: RUNS.table_path(w.run),
        records=lambda w: RUNS.records[w.run],
        settings=OF_CODE,
    script:
        "scripts/assess_code.py"


# The same of the mechanisms that are shaken beside the whole façade, which the hand calculation names.
use rule assess_collapse as assess_parts_collapse with:
    input:
        **MOTIONS,
        case=rules.facade_case.output[0],
        shaken=rules.assess_code.output.shaken,
        whole=rules.assess_collapse.output[0],  # parts are followed no further than it stood
    output:
        results("assessment/parts_collapse_{model}.csv"),
    benchmark:
        benchmarks("assess_parts_collapse_{model}")
    priority: 1  # the longest go first


PARTS_COLLAPSE = of_run(rules.assess_parts_collapse.output[0], model=dry)


rule assess_dynamic:
    input:
        collapse=COLLAPSE,
        parts=PARTS_COLLAPSE,
        checks=rules.assess_code.output.checks,
        shaken=rules.assess_code.output.shaken,
        hazard=HAZARD,
    output:
        table=results("assessment/dynamic.csv"),
        curves=results("assessment/dynamic_curves.csv"),
        rates=results("assessment/rate.csv"),
        parts=results("assessment/parts_dynamic.csv"),
        left_out=results("assessment/rate_left_out.csv"),
        first=results("assessment/building_first.csv"),
    benchmark:
        benchmarks("assess_dynamic")
    params:
        stations=stations,
        period_s=value_of("smdof.period_s"),
        site=value_of("risk.site"),
        years=value_of("risk.years"),
        settings=numbers_of("assessment"),
        resamples=value_of("assessment.resamples"),
        seed=value_of("seed"),
    script:
        "scripts/assess_dynamic.py"


rule assess_selection:
    input:
        **MOTIONS,
        site=site,
        spectrum=SPECTRUM,
        hazard=HAZARD,
    output:
        motions=results("assessment/selected_motions.csv"),
        spectra=results("assessment/selected_spectra.csv"),
    benchmark:
        benchmarks("assess_selection")
    params:
        table=lambda w: RUNS.table_path(w.run),
        stations=stations,
        settings=OF_CODE,
    script:
        "scripts/assess_selection.py"


OF_HISTORIES = numbers_of("directions", "baseline", "seed", "vertical_motion", "assessment")


rule assess_histories:
    input:
        **MOTIONS,
        case=rules.facade_case.output[0],
        motions=rules.assess_selection.output.motions,
        shaken=rules.assess_code.output.shaken,
    output:
        histories=results("assessment/dynamic_check_{model}_histories.csv"),
        verdict=results("assessment/dynamic_check_{model}.csv"),
    benchmark:
        benchmarks("assess_histories_{model}")
    priority: 2  # assess_friction waits for them
    params:
        table=lambda w: RUNS.table_path(w.run),
        settings=OF_HISTORIES,
        whole=True,
    script:
        "scripts/assess_histories.py"


use rule assess_histories as assess_parts_histories with:
    output:
        histories=results("assessment/parts_check_{model}_histories.csv"),
        verdict=results("assessment/parts_check_{model}.csv"),
    benchmark:
        benchmarks("assess_parts_histories_{model}")
    priority: 1  # YADE waits for them
    params:
        table=lambda w: RUNS.table_path(w.run),
        settings=OF_HISTORIES,
        whole=False,


CHECKED_PARTS = rules.assess_histories.output, rules.assess_parts_histories.output


rule assess_confirm:
    input:
        **MOTIONS,
        cases=of_run(rules.facade_case.output[0], model=dry),
        histories=of_run(*(files.histories for files in CHECKED_PARTS), model=dry),
        verdicts=of_run(*(files.verdict for files in CHECKED_PARTS), model=dry),
        shaken=rules.assess_code.output.shaken,
        yade=rules.yade_check.output[0],
        study=command_code("ida"),
    output:
        results("assessment/dynamic_check_yade.csv"),
    benchmark:
        benchmarks("assess_confirm")
    params:
        yade=YADE,
        folder=results("cache/assessment"),
        table=lambda w: RUNS.table_path(w.run),
        settings=numbers_of("baseline", "seed", "vertical_motion", "assessment", "facade.courses"),
    script:
        "scripts/assess_confirm.py"


def threads_of_ties(wildcards):
    """Half of the cores, up to 4: the others do what else the report takes meanwhile."""
    sought = RUNS.cfg(wildcards)["assessment"]["tie_levels_m"] != []
    return max(1, min(4, (workflow.resource_settings.cores or 2) // 2)) if sought else 1


rule assess_ties:
    input:
        **MOTIONS,
        site=site,
        spectrum=SPECTRUM,
        hazard=HAZARD,
        cases=of_run(rules.facade_case.output[0], model=dry),
        motions=rules.assess_selection.output.motions,
    output:
        rows=results("assessment/ties.csv"),
        models=results("assessment/ties_models.csv"),
        after=results("assessment/ties_mechanisms.csv"),
        tried=results("assessment/ties_tried.csv"),
        share=results("assessment/ties_share.csv"),
        yaml=results("assessment/ties.yaml"),
    benchmark:
        benchmarks("assess_ties")
    priority: 3  # as long as all else on another core
    threads: threads_of_ties
    params:
        run=lambda w: w.run,
        table=lambda w: RUNS.table_path(w.run),
        records=lambda w: RUNS.records[w.run],
        settings=numbers_of(
            *CHECKED, "strengthening", "directions", "baseline", "seed", "risk.site"
        ),
    script:
        "scripts/assess_ties.py"


# What floors that hold by friction would change: with it where it does not count, else without it.
rule assess_friction:
    input:
        **MOTIONS,
        case=of_run(rules.facade_case.output[0], model=governing),
        motions=rules.assess_selection.output.motions,
        whole=of_run(rules.assess_collapse.output[0], model=governing),
        parts=of_run(rules.assess_parts_collapse.output[0], model=governing),
        verdicts=of_run(*(files.verdict for files in CHECKED_PARTS), model=governing),
        checks=rules.assess_code.output.checks,
        shaken=rules.assess_code.output.shaken,
        hazard=HAZARD,
    output:
        results("assessment/friction.csv"),
    benchmark:
        benchmarks("assess_friction")
    priority: 2
    params:
        table=lambda w: RUNS.table_path(w.run),
        model=lambda w: governing(w.run),
        curves=curves,
        stations=stations,
        period_s=value_of("smdof.period_s"),
        site=value_of("risk.site"),
        settings=numbers_of(
            "directions", "baseline", "seed", "vertical_motion", "ida.max_pga_g", "assessment"
        ),
    script:
        "scripts/assess_friction.py"


rule assess_sensitivity:
    input:
        **MOTIONS,
        case=of_run(rules.facade_case.output[0], model=governing),
        collapse=of_run(rules.assess_collapse.output[0], model=governing),
        parts=of_run(rules.assess_parts_collapse.output[0], model=governing),
        shaken=rules.assess_code.output.shaken,
    output:
        results("assessment/dynamic_sensitivity.csv"),
    benchmark:
        benchmarks("assess_sensitivity")
    params:
        table=lambda w: RUNS.table_path(w.run),
        settings=RUNS.params_of("baseline", "seed", "vertical_motion", "ida.max_pga_g", *HELD_BY),
    script:
        "scripts/assess_sensitivity.py"


def motions_files(wildcards):
    """Accelerograms of a run, and the file that surrogates are made of where it has some."""
    jobs = [Of(run=wildcards.run, record=record) for record in RUNS.records[wildcards.run]]
    made = {path for path in map(RUNS.surrogate_parameters, jobs) if path}
    return [*RUNS.record_files(wildcards), *sorted(made)]


rule assess_report:
    input:
        tables=all_of(
            rules.assess_code.output,
            rules.assess_dynamic.output,
            rules.assess_sensitivity.output,
            rules.assess_selection.output,
            rules.assess_ties.output.rows,
            rules.assess_ties.output.models,
            rules.assess_ties.output.after,
            rules.assess_ties.output.tried,
            rules.assess_friction.output,
        ),
        ties=rules.assess_ties.output.yaml,
        verdicts=of_run(*(files.verdict for files in CHECKED_PARTS), model=dry),
        yade=[rules.assess_confirm.output[0]],
        site=printed,
        table=lambda w: RUNS.table_path(w.run),
        records=motions_files,
    output:
        html=results("assessment/report.html"),
        pdf=results("assessment/report.pdf"),
        values=results("assessment/values.csv"),
    benchmark:
        benchmarks("assess_report")
    params:
        run=lambda w: w.run,
        given=stated,
        commit=COMMIT,
        config=lambda w: RUNS.cfg(w),
    script:
        "scripts/assess_report.py"


rule assess:
    """
    Codes of practice compared with the dynamic answer, one façade: a report in HTML and PDF.
    Costs: 2 to 8 minutes for three models and 44 motions; by records, mechanisms, courses and ties.
    Page: docs/assessment.md
    """
    input:
        every_run(rules.assess_report.output),


include: "code_against_dynamics.smk"
