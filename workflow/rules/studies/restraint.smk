# What a roof's load and friction are worth: collapse PGA by planar scans, YADE's realisations on them.


rule restrain:
    input:
        scene=rules.scene.output[0],
        motion=of_run(rules.floor_motions.output[0]),
        modules=code("restraint/restraint"),
    output:
        table=results("restraint/{model}/{record}_{direction}.csv"),
        plan=results("restraint/{model}/{record}_{direction}.json"),
    log:
        logs("restraint_{model}_{record}_{direction}"),
    params:
        settings=RUNS.params_of("restraint"),
    script:
        "../../scripts/restraint/restraint.py"


use rule strengthen_yade as restrain_yade with:
    input:
        scene=rules.scene.output[0],
        motion=of_run(rules.floor_motions.output[0]),
        plan=rules.restrain.output.plan,
        yade=rules.yade_check.output[0],
        modules=study_code("runs"),
    output:
        results("restraint/{model}/{record}_{direction}_yade.csv"),
    log:
        logs("restraint_yade_{model}_{record}_{direction}"),
    benchmark:
        benchmarks("restraint_yade_{model}_{record}_{direction}")
    params:
        journal=results("cache/restraint/{model}_{record}_{direction}.jsonl"),


rule figure_restraint:
    input:
        tables=of_run(rules.restrain.output.table, model=models_for("restraint")),
        yade=of_run(rules.restrain_yade.output[0], model=models_for("restraint")),
        facts=rules.own_record.output.facts,
        modules=code("restraint/figure_restraint"),
    output:
        png=shown(
            results("restraint/{record}_{direction}.png"),
            "restraint",
            "Strengthening",
            "roof, {record} {direction}",
        ),
        pdf=results("restraint/{record}_{direction}.pdf"),
    log:
        logs("figure_restraint_{record}_{direction}"),
    script:
        "../../scripts/restraint/figure_restraint.py"


rule restraint:
    """
    Collapse against load and friction of a roof.
    Costs: minutes; by loads and frictions.
    Page: docs/floors.md
    """
    input:
        every_run(rules.figure_restraint.output.png),
