# The least tie that keeps the façade standing at a stated intensity: planar search, YADE confirms.


rule strengthen:
    input:
        scene="results/{run}/scenes/{model}.json",
        motion=STUDY.ida_motion,
        modules=code("strengthening/strengthen"),
    output:
        search="results/{run}/strengthening/{model}/{record}_{direction}.csv",
        least="results/{run}/strengthening/{model}/{record}_{direction}_least.csv",
        curve="results/{run}/strengthening/{model}/{record}_{direction}_curve.csv",
        plan="results/{run}/strengthening/{model}/{record}_{direction}.json",
    log:
        "results/{run}/logs/strengthen_{model}_{record}_{direction}.log",
    benchmark:
        "results/{run}/benchmarks/strengthen_{model}_{record}_{direction}.tsv"
    params:
        settings=STUDY.params_of("strengthening"),
    script:
        "../scripts/strengthening/strengthen.py"


rule strengthen_yade:
    input:
        scene="results/{run}/scenes/{model}.json",
        motion=STUDY.ida_motion,
        plan="results/{run}/strengthening/{model}/{record}_{direction}.json",
        yade="results/{run}/yade.txt",
        modules=study_code("strengthening"),
    output:
        "results/{run}/strengthening/{model}/{record}_{direction}_yade.csv",
    log:
        "results/{run}/logs/strengthen_yade_{model}_{record}_{direction}.log",
    benchmark:
        "results/{run}/benchmarks/strengthen_yade_{model}_{record}_{direction}.tsv"
    params:
        yade=YADE,
        journal="results/{run}/cache/strengthening/{model}_{record}_{direction}.jsonl",
    shell:
        "{params.yade} strengthening --scene {input.scene:q} --motion {input.motion:q}"
        " --record {wildcards.record:q} --direction {wildcards.direction}"
        " --plan {input.plan:q} --journal {params.journal:q} --output {output:q} 2> {log:q}"


rule figure_strengthening:
    input:
        search="results/{run}/strengthening/{model}/{record}_{direction}.csv",
        least="results/{run}/strengthening/{model}/{record}_{direction}_least.csv",
        curve="results/{run}/strengthening/{model}/{record}_{direction}_curve.csv",
        yade="results/{run}/strengthening/{model}/{record}_{direction}_yade.csv",
        facts="results/{run}/records/{record}.json",
        modules=code("strengthening/figure_strengthening"),
    output:
        png=shown(
            "results/{run}/strengthening/{model}/{record}_{direction}.png",
            "strengthening",
            "Strengthening",
            "{model}, {record} {direction}",
        ),
        pdf="results/{run}/strengthening/{model}/{record}_{direction}.pdf",
    log:
        "results/{run}/logs/figure_strengthening_{model}_{record}_{direction}.log",
    params:
        settings=STUDY.params_of("strengthening"),
        height_m=lambda w: STUDY.cfg(w)["facade"]["height_m"],
    script:
        "../scripts/strengthening/figure_strengthening.py"


rule table_strengthening:
    input:
        least=lambda w: STRENGTHENING.curves(w.run, "strengthening", "_least.csv"),
        yade=lambda w: STRENGTHENING.curves(w.run, "strengthening", "_yade.csv"),
        modules=code("strengthening/table_strengthening"),
    output:
        "results/{run}/tables/strengthening.csv",
    log:
        "results/{run}/logs/table_strengthening.log",
    params:
        settings=STUDY.params_of("strengthening"),
    script:
        "../scripts/strengthening/table_strengthening.py"


rule strengthening:
    input:
        lambda w: with_pages(STUDY.per_run(STRENGTHENING.results)),
