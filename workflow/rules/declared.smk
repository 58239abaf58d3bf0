# Rules of a study that differ in names alone: its table, and a figure of it.


def table_of(study, rule_name, tables=None, **outputs):
    """Rule `rule_name`: curves of a study in one table, and what its module makes of them.

    Parameters
    ----------
    study : str
        Module of `rocking.studies`.
    rule_name : str
        Also the name of its log.
    tables : callable, optional
        Input function: a table a curve; without one the outputs are made of nothing.
    **outputs
        Names of the tables, by `table` or the module's function that makes them.
    """

    rule:
        name:
            rule_name
        input:
            **({"tables": tables} if tables else {}),
            modules=code("studies/table", study=study),
        output:
            **{function: results(f"tables/{table}.csv") for function, table in outputs.items()},
        log:
            logs(rule_name),
        params:
            study=study,
        script:
            str(BASE / "workflow/scripts/studies/table.py")


def figure_of(study, title, category, result, caption, facts=None, draw="draw", **inputs):
    """Rule `figure_<title>`: a figure that the module of a study draws from tables.

    Parameters
    ----------
    study : str
        Module of `rocking.studies`.
    title : str
        Name of the picture.
    category, result, caption : str
        What the report says of it.
    facts : callable, optional
        Input function: provenance of the motions; by default of the run's records.
    draw : str
        The module's function.
    **inputs
        Tables that it takes.
    """

    rule:
        name:
            f"figure_{title}"
        input:
            **inputs,
            facts=facts or of_run(rules.record.output.facts),
            modules=code("studies/figure", study=study),
        output:
            **figure(title, category, result, about="study"),
        log:
            logs(f"figure_{title}"),
        params:
            study=study,
            draw=draw,
            caption=caption,
        script:
            str(BASE / "workflow/scripts/studies/figure.py")
