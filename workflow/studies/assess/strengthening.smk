# The least tie that keeps the façade standing at a stated intensity: planar search, YADE confirms.


@with_planar_models("strengthening")
def strengthened_models(resolved):
    """The façade with a tie of the least force, at every height that is tried."""
    from studies.assess.strengthening import tie, trial_heights  # slow to load

    settings = resolved["strengthening"]
    heights = trial_heights(settings, resolved["facade"]["height_m"])
    return [tie(settings, z, settings["forces_kn"][0]) for z in heights]


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
        "scripts/strengthen.py"


yade_runs_of(
    "strengthening",
    "strengthen_yade",
    plan=rules.strengthen.output.plan,
    path=results("strengthening/{model}/{record}_{direction}_yade.csv"),
)


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
        "scripts/figure_strengthening.py"


rule table_strengthening:
    input:
        least=of_run(rules.strengthen.output.least, model=strengthened_models),
        yade=of_run(rules.strengthen_yade.output[0], model=strengthened_models),
    output:
        table=results("tables/strengthening.csv"),
        share=results("tables/strengthening_share.csv"),
    params:
        settings=RUNS.params_of("strengthening"),
    script:
        "scripts/table_strengthening.py"


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
                model=strengthened_models,
            ),
        ),
