# Uncertainty of material and model compared with that of the motion: ask for `uncertainty`.


@cache
def design(run):
    """Direction of every motion of the design, by record."""
    from studies.uncertainty.design import sampled_motions  # slow to load

    try:
        return sampled_motions(RUNS, run)
    except ValueError as error:
        stop(error)


def sampled(run):
    """Records of the design."""
    return list(design(run))


def sample_settings(*more):
    """Params function: what the sample depends on and the keys of `more`, as JSON."""
    keys = ("samples", "sampling", "seed", "replicates", "bases", "parameters", *more)

    def text(wildcards):
        section, limit = (RUNS.cfg(wildcards)[key] for key in ("uncertainty", "ida"))
        settings = {key: section[key] for key in keys}
        return json.dumps({**settings, "max_pga_g": limit["max_pga_g"]}, sort_keys=True)

    return text


rule uncertainty_collapse:
    input:
        record=rules.own_record.output.record,
        cases=of_run(rules.facade_case.output[0], model=RUNS.key("uncertainty.models")),
        law=LAW_FILE,
    output:
        results("uncertainty/{record}.csv"),
    log:
        logs("uncertainty_{record}"),
    benchmark:
        benchmarks("uncertainty_{record}")
    params:
        settings=sample_settings(),
        direction=lambda w: design(w.run)[w.record],
    script:
        "scripts/uncertainty_collapse.py"


rule uncertainty_confirm:
    input:
        tables=of_run(rules.uncertainty_collapse.output[0], record=sampled),
        records=of_run(rules.own_record.output.record, record=sampled),
        cases=of_run(rules.facade_case.output[0], model=RUNS.key("uncertainty.models")),
        law=LAW_FILE,
        yade=rules.yade_check.output[0],
        command=command_code("runs"),
    output:
        results("tables/uncertainty_confirm.csv"),
    log:
        logs("uncertainty_confirm"),
    params:
        settings=sample_settings("confirm"),
    script:
        "scripts/uncertainty_confirm.py"


rule uncertainty_tables:
    input:
        tables=of_run(rules.uncertainty_collapse.output[0], record=sampled),
    output:
        samples=results("uncertainty/samples.csv"),
        parts=results("tables/uncertainty_parts.csv"),
        sensitivity=results("tables/uncertainty_sensitivity.csv"),
        fragility=results("tables/uncertainty_fragility.csv"),
    params:
        settings=sample_settings("confidence"),
    script:
        "scripts/uncertainty_tables.py"


figure_of(
    "uncertainty",
    "uncertainty",
    "Fragility",
    "motion, material and model form",
    caption="Where the scatter of collapse comes from. Left: share of each part in the variance of"
    " the logarithm of the collapse PGA, with intervals from motions and points of the sample left"
    " out one at a time. Middle: change of the collapse PGA for one standard deviation of each"
    " parameter, all else as drawn, by form of the model. Right: probability of collapse with the"
    " scatter of the motion alone, with that of the material added, and with everything.",
    facts=of_run(rules.own_record.output.facts, record=sampled),
    parts=rules.uncertainty_tables.output.parts,
    sensitivity=rules.uncertainty_tables.output.sensitivity,
    fragility=rules.uncertainty_tables.output.fragility,
)


rule uncertainty:
    """
    Scatter by motion, material and model form.
    Costs: 6 min for 70,000 histories.
    """
    input:
        every_run(
            rules.uncertainty_tables.output.parts,
            rules.uncertainty_tables.output.sensitivity,
            rules.uncertainty_tables.output.fragility,
            where(RUNS.key("uncertainty.confirm"), rules.uncertainty_confirm.output),
            rules.figure_uncertainty.output.png,
        ),
