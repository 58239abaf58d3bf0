# Façades in three dimensions under both horizontal components, beside the planar scene under one.


rule two_components:
    input:
        with_pages(STUDY.per_run(TWO_COMPONENTS.results)),


rule two_components_curves:
    input:
        scenes=TWO_COMPONENTS.scenes,
        motion=STUDY.ida_motion,
        second=TWO_COMPONENTS.motion_along,
        modules=code("two_components/two_components"),
    output:
        "results/{run}/two_components/{record}.csv",
    log:
        "results/{run}/logs/two_components_{record}.log",
    benchmark:
        "results/{run}/benchmarks/two_components_{record}.tsv"
    params:
        settings=lambda w: STUDY.cfg(w)["two_components"],
        directions=lambda w: STUDY.cfg(w)["directions"],
        second=TWO_COMPONENTS.second,
    script:
        "../scripts/two_components/two_components.py"


rule two_components_table:
    input:
        tables=TWO_COMPONENTS.tables,
        modules=code("two_components/table_two_components"),
    output:
        table="results/{run}/tables/two_components.csv",
        summary="results/{run}/tables/two_components_summary.csv",
    log:
        "results/{run}/logs/two_components.log",
    script:
        "../scripts/two_components/table_two_components.py"


rule figure_two_components:
    input:
        table="results/{run}/tables/two_components.csv",
        facts=STUDY.record_facts,
        modules=code("two_components/figure_two_components"),
    output:
        **figure("two_components", "Two components", "both components beside one"),
    log:
        "results/{run}/logs/figure_two_components.log",
    script:
        "../scripts/two_components/figure_two_components.py"


rule two_components_scene:
    input:
        scene="results/{run}/scenes/{model}.json",
        modules=code("two_components/two_components_scene"),
    output:
        "results/{run}/scenes/{model}_two_components.json",
    log:
        "results/{run}/logs/scene_{model}_two_components.log",
    params:
        settings=lambda w: STUDY.cfg(w)["two_components"],
    script:
        "../scripts/two_components/two_components_scene.py"


# One curve at the intensities of the compiled solver, in YADE: ask for the file.
rule two_components_yade:
    input:
        scene="results/{run}/scenes/{model}_two_components.json",
        motion=STUDY.ida_motion,
        second=TWO_COMPONENTS.motion_along,
        curves="results/{run}/two_components/{record}.csv",
        yade="results/{run}/yade.txt",
        modules=study_code("two_components"),
    output:
        "results/{run}/two_components/{model}_{record}_{direction}_yade.csv",
    log:
        "results/{run}/logs/two_components_{model}_{record}_{direction}_yade.log",
    params:
        yade=YADE,
    shell:
        "{params.yade} two_components --scene {input.scene:q} --motion {input.motion:q}"
        " --second {input.second:q} --curves {input.curves:q} --record {wildcards.record:q}"
        " --direction {wildcards.direction} --output {output:q} 2> {log:q}"
