# The least tie that keeps the façade standing at a stated intensity: planar search, YADE confirms.


def models_for(target):
    """Function of a run's name: models that a target searches with, if the façade allows it."""

    @cache
    def models(run):
        from rocking.studies.additions import planar_models  # slow to load

        try:
            return planar_models(RUNS.settings[run], target)
        except configuration.ConfigError as error:
            stop(f"{target}: {error.detail}")

    return models


rule strengthen:
    input:
        case=rules.facade_case.output[0],
        motion=of_run(rules.floor_motions.output[0]),
    output:
        search=results("strengthening/{model}/{record}_{direction}.csv"),
        least=results("strengthening/{model}/{record}_{direction}_least.csv"),
        curve=results("strengthening/{model}/{record}_{direction}_curve.csv"),
        plan=results("strengthening/{model}/{record}_{direction}.json"),
    benchmark:
        benchmarks("strengthen_{model}_{record}_{direction}")
    params:
        settings=RUNS.params_of("strengthening"),
        kept=results("cache/strengthening/{model}_{record}_{direction}_planar.jsonl"),
    script:
        "../scripts/strengthening/strengthen.py"


rule strengthen_yade:
    input:
        case=rules.facade_case.output[0],
        motion=of_run(rules.floor_motions.output[0]),
        plan=rules.strengthen.output.plan,
        yade=rules.yade_check.output[0],
        modules=command_code("runs"),
    output:
        results("strengthening/{model}/{record}_{direction}_yade.csv"),
    log:
        logs("strengthen_yade_{model}_{record}_{direction}"),
    benchmark:
        benchmarks("strengthen_yade_{model}_{record}_{direction}")
    params:
        yade=YADE,
        journal=results("cache/strengthening/{model}_{record}_{direction}.jsonl"),
    shell:
        "{params.yade} runs --scene {input.case:q} --motion {input.motion:q}"
        " --record {wildcards.record:q} --direction {wildcards.direction}"
        " --list {input.plan:q} --journal {params.journal:q} --output {output:q} 2> {log:q}"


rule figure_strengthening:
    input:
        search=rules.strengthen.output.search,
        least=rules.strengthen.output.least,
        curve=rules.strengthen.output.curve,
        yade=rules.strengthen_yade.output[0],
        facts=rules.own_record.output.facts,
    output:
        png=shown(
            results("strengthening/{model}/{record}_{direction}.png"),
            "strengthening",
            "Strengthening",
            "{model}, {record} {direction}",
        ),
        pdf=results("strengthening/{model}/{record}_{direction}.pdf"),
    params:
        settings=RUNS.params_of("strengthening"),
        height_m=value_of("facade.height_m"),
    script:
        "../scripts/strengthening/figure_strengthening.py"


rule table_strengthening:
    input:
        least=of_run(rules.strengthen.output.least, model=models_for("strengthening")),
        yade=of_run(rules.strengthen_yade.output[0], model=models_for("strengthening")),
    output:
        table=results("tables/strengthening.csv"),
        share=results("tables/strengthening_share.csv"),
    params:
        settings=RUNS.params_of("strengthening"),
    script:
        "../scripts/strengthening/table_strengthening.py"


rule strengthening:
    """
    The least row of ties that keeps the façade standing.
    Costs: minutes a direction; by forces tried.
    Page: docs/ties.md
    """
    input:
        every_run(
            rules.table_strengthening.output,
            of_run(
                rules.figure_strengthening.output.png,
                model=models_for("strengthening"),
            ),
        ),
