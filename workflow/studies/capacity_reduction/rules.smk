# How far the building behind a façade lowers its capacity: W2 over W1 against T1 and the façade's place.
# Not part of the main job; ask for `capacity_reduction`.
BUILDINGS = {
    "t1": lambda run: [f"{t1:g}" for t1 in RUNS.settings[run]["capacity_reduction"]["periods_s"]],
    "below": RUNS.key("capacity_reduction.masses_below"),
}


wildcard_constraints:
    t1=r"[0-9.]+",
    below=r"\d+",


# The building's period and the façade's place in it, with the façade itself unchanged. A case is
# T<period>_below<masses>: a chain of masses_below + n_dof masses, the façade's base on mass
# number masses_below (on the ground for 0).
rule reduction_motion:
    input:
        record=rules.own_record.output.record,
    output:
        motion=results("capacity_reduction/T{t1}_below{below}/{record}.csv"),
        facts=results("capacity_reduction/T{t1}_below{below}/{record}.json"),
    log:
        logs("reduction_motion_T{t1}_below{below}_{record}"),
    params:
        smdof=lambda w: {k: v for k, v in RUNS.cfg(w)["smdof"].items() if k != "period_s"},
    script:
        "scripts/capacity_reduction_motion.py"


use rule planar_ida as reduction_planar with:
    input:
        case=of_run(rules.facade_case.output[0], model="W2"),
        motion=rules.reduction_motion.output.motion,
    output:
        scan=results("capacity_reduction/T{t1}_below{below}/scan_{record}_{direction}.csv"),
        plan=results("capacity_reduction/T{t1}_below{below}/plan_{record}_{direction}.json"),
    log:
        logs("reduction_planar_T{t1}_below{below}_{record}_{direction}"),
    benchmark:
        benchmarks("reduction_planar_T{t1}_below{below}_{record}_{direction}")


use rule ida as reduction_ida with:
    input:
        case=of_run(rules.facade_case.output[0], model="W2"),
        motion=rules.reduction_motion.output.motion,
        plan=rules.reduction_planar.output.plan,
        yade=rules.yade_check.output[0],
        modules=command_code("ida"),
    output:
        curve=results("capacity_reduction/T{t1}_below{below}/{record}_{direction}.csv"),
    log:
        logs("reduction_T{t1}_below{below}_{record}_{direction}"),
    benchmark:
        benchmarks("reduction_T{t1}_below{below}_{record}_{direction}")
    params:
        ensemble="",
        journal=results("cache/reduction/T{t1}_below{below}_{record}_{direction}.jsonl"),


rule figure_capacity_reduction:
    input:
        w1=of_run(rules.ida.output[0], model="W1", record=RUNS.confirmed),
        w1_scans=of_run(rules.planar_ida.output.scan, model="W1"),
        w2=of_run(rules.reduction_ida.output[0], **BUILDINGS, record=RUNS.confirmed),
        w2_scans=of_run(rules.reduction_planar.output.scan, **BUILDINGS),
        facts=of_run(rules.reduction_motion.output.facts, **BUILDINGS),
        records=of_run(rules.record.output.facts),
    output:
        **figure("capacity_reduction", "Capacity reduction", "W2/W1 against T1 and position"),
        table=results("tables/capacity_reduction.csv"),
    params:
        w1=of_run(rules.ida.output[0], model="W1"),
        w2=of_run(rules.reduction_ida.output[0], **BUILDINGS),
        spread=value_of("ensemble.amplitude_spread"),
        hazard_slope=value_of("risk.hazard_slope"),
        facade=value_of("facade"),
        smdof=value_of("smdof"),
    script:
        "scripts/figure_capacity_reduction.py"


rule capacity_reduction:
    """
    W2 over W1 against the building's period and the façade's place.
    Costs: 30 min for 22 records.
    """
    input:
        every_run(
            rules.figure_capacity_reduction.output.table,
            rules.figure_capacity_reduction.output.png,
        ),
