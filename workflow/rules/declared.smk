# Rules that differ in names alone: a figure by a script of its own, a study's table, runs in YADE, a figure of it.


def figure_by(source, title, category, result, about=None, params=None, **inputs):
    """Rule of the script's name: a figure that a script of its own draws.

    Parameters
    ----------
    source : str
        Folder of `workflow/scripts` and name of the script, or `studies/` with the study's folder and
        name, without `.py`. A job calls Snakemake's `script` here: no
        argument may have that name.
    title : str
        Name of the picture, with the wildcards that the rule has.
    category, result, about : str
        What the report says of it, and the caption where it is not the title's.
    params : dict, optional
        What the script takes besides; a change of it draws anew.
    **inputs
        Tables and facts that it takes.
    """
    rule_name = source.rpartition("/")[2]
    folder = BASE / "workflow" if source.startswith("studies/") else BASE / "workflow" / "scripts"

    rule:
        name:
            rule_name
        input:
            **inputs,
        output:
            **figure(title, category, result, about=about),
        params:
            **(params or {}),
        script:
            str(folder / f"{source}.py")


def table_of(study, rule_name, tables=None, digits="%.6g", **outputs):
    """Rule `rule_name`: curves of a study in one table, and what its module makes of them.

    Parameters
    ----------
    study : str
        Its folder of `workflow/studies`.
    rule_name : str
        Also the name of its log.
    tables : callable, optional
        Input function: a table a curve; without one the outputs are made of nothing.
    digits : str
        Form of floating-point numbers.
    **outputs
        Names of the tables, by `table` or the module's function that makes them.
    """

    rule:
        name:
            rule_name
        input:
            **({"tables": tables} if tables else {}),
        output:
            **{function: results(f"tables/{table}.csv") for function, table in outputs.items()},
        params:
            study=study,
            digits=digits,
        script:
            str(BASE / "workflow/scripts/studies/table.py")


def yade_runs_of(study, rule_name, plan, path):
    """Rule `rule_name`: what YADE says of the runs that a study's plan lists for one curve.

    Parameters
    ----------
    study : str
        Folder of its journals.
    plan : str
        What the rule that finds collapse wrote: runs for YADE's command `runs`.
    path : str
        Its table; its wildcards are model, record and direction.
    """
    curve = "{model}_{record}_{direction}"

    rule:
        name:
            rule_name
        input:
            case=rules.facade_case.output[0],
            motion=of_run(rules.floor_motions.output[0]),
            plan=plan,
            yade=rules.yade_check.output[0],
            modules=command_code("runs"),
        output:
            path,
        log:
            logs(f"{rule_name}_{curve}"),
        benchmark:
            benchmarks(f"{rule_name}_{curve}")
        params:
            yade=YADE,
            journal=results(f"cache/{study}/{curve}.jsonl"),
        shell:
            "{params.yade} runs --scene {input.case:q} --motion {input.motion:q}"
            " --record {wildcards.record:q} --direction {wildcards.direction}"
            " --list {input.plan:q} --journal {params.journal:q} --output {output:q} 2> {log:q}"


def walls_of(rule_name, cases, path, **needed):
    """Rule `rule_name`: what YADE says of walls alone, each as a list of cases describes it.

    Parameters
    ----------
    rule_name : str
        Also the name of its log, with the wildcards of its archive.
    cases : str
        The list, for YADE's command `walls`.
    path : str
        Archive of the histories.
    **needed
        Files that the list names.
    """
    log_name = "_".join([rule_name, *(f"{{{n}}}" for n in get_wildcard_names(path) if n != "run")])

    rule:
        name:
            rule_name
        input:
            **needed,
            cases=cases,
            yade=rules.yade_check.output[0],
            modules=command_code("walls"),
        output:
            path,
        log:
            logs(log_name),
        benchmark:
            benchmarks(log_name)
        params:
            yade=YADE,
        shell:
            "{params.yade} walls --list {input.cases:q} --output {output:q} 2> {log:q}"


def figure_of(study, title, category, result, caption, facts=None, **inputs):
    """Rule `figure_<title>`: a figure that the module of a study draws from tables.

    Parameters
    ----------
    study : str
        Its folder of `workflow/studies`.
    title : str
        Name of the picture.
    category, result, caption : str
        What the report says of it.
    facts : callable, optional
        Input function: provenance of the motions; by default of the run's records.
    **inputs
        Tables that it takes.
    """

    rule:
        name:
            f"figure_{title}"
        input:
            **inputs,
            facts=facts or of_run(rules.record.output.facts),
        output:
            **figure(title, category, result, about="study"),
        params:
            study=study,
            caption=caption,
        script:
            str(BASE / "workflow/scripts/studies/figure.py")
