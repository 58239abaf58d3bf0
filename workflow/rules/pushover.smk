# Static capacity curves in YADE: one job a model.


wildcard_constraints:
    pushed="|".join(PUSHED),


rule pushover_case:
    input:
        law=LAW_FILE,
    output:
        results("pushover/cases/{pushed}.json"),
    params:
        sections=RUNS.params_of(
            "facade", "return_wall", "damping", "smdof", "numerics", "pushover", "w3"
        ),
    script:
        str(BASE / "workflow/scripts/pushover/pushover_case.py")


rule pushover:
    input:
        case=rules.pushover_case.output[0],
        yade=rules.yade_check.output[0],
        modules=command_code("pushover"),
    output:
        curve=results("pushover/raw/{pushed}.csv"),
        forces=results("pushover/raw/{pushed}_forces.csv"),
    log:
        logs("pushover_{pushed}"),
    benchmark:
        benchmarks("pushover_{pushed}")
    params:
        yade=YADE,
    shell:
        "{params.yade} pushover --scene {input.case:q} --output {output.curve:q}"
        " --forces {output.forces:q} 2> {log:q}"


rule pushover_curve:
    input:
        case=rules.pushover_case.output[0],
        raw=rules.pushover.output.curve,
    output:
        results("pushover/{pushed}.csv"),
    script:
        "../scripts/pushover/pushover_curve.py"
