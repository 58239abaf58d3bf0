# Rules that differ in names alone: a figure by a script of its own, a study's table, and a figure of it.


def figure_by(source, title, category, result, about=None, params=None, **inputs):
    """Rule of the script's name: a figure that a script of its own draws.

    Parameters
    ----------
    source : str
        Folder and name of the script, without `.py`. A job calls Snakemake's `script` here: no
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
    own = source.partition("/")[2]

    rule:
        name:
            own
        input:
            **inputs,
        output:
            **figure(title, category, result, about=about),
        params:
            **(params or {}),
        script:
            str(BASE / f"workflow/scripts/{source}.py")


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
        output:
            **{function: results(f"tables/{table}.csv") for function, table in outputs.items()},
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
        output:
            **figure(title, category, result, about="study"),
        params:
            study=study,
            draw=draw,
            caption=caption,
        script:
            str(BASE / "workflow/scripts/studies/figure.py")
