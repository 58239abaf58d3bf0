# Runs side by side: a grid, scenarios, or finished runs by name.
import yaml
from rocking.configuration.differences import differences
from studies.compare import finished

RESOLVED = results("config.yaml")  # configuration of a finished run


def compared():
    """Runs side by side: those of a grid or scenarios, and the finished ones that are named."""
    named = next(iter(RUNS.settings.values()))["compare"]
    several = list(RUNS.settings) if len(RUNS.settings) > 1 or not named else []
    return list(dict.fromkeys([*several, *named]))


def collapse_of(run):
    """Collapse table of a run."""
    return expand(rules.ida_collapse.output.collapse, run=run)[0]


def compared_tables(wildcards):
    """Collapse tables of the runs; a finished run without one ends the workflow in one line."""
    for run in compared():
        path = Path(collapse_of(run))
        resolved = Path(RESOLVED.format(run=run))
        missing = [needed for needed in (path, resolved) if not needed.is_file()]
        if run not in RUNS.settings and missing:
            tables = Path().glob(collapse_of("*"))
            names = sorted(p.parents[1].name for p in tables if p.is_file())
            there = [name for name in names if Path(RESOLVED.format(run=name)).is_file()]
            stop(
                f"compare: no finished run '{run}' (no file {missing[0]}); "
                f"there are {listed(there) or 'none'}"
            )
        if run not in RUNS.settings and (gone := finished.models_gone(path)):
            stop(f"compare: {gone}")
    if len(compared()) < 2:
        stop(
            "compare: one run only; give a grid, scenarios, or finished runs, as in"
            " --config compare=main,tall -- compare"
        )
    return [collapse_of(run) for run in compared()]


def compared_facts(wildcards):
    """Provenance files of the runs' records; of a finished run those that it still has."""
    facts = []
    for run in compared():
        if run in RUNS.settings:
            job = Of(run=run)
            facts += of_run(rules.record.output.facts)(job)
            continue
        rows = finished.curves_of(collapse_of(run))
        names = list(dict.fromkeys(row["record"] for row in rows))
        paths = expand(rules.own_record.output.facts, run=run, record=names)
        facts += [path for path in paths if Path(path).is_file()]
    return list(dict.fromkeys(facts))


def compared_settings(wildcards):
    """What differs between the configurations of the runs."""
    return differences(
        {
            run: RUNS.settings.get(run)
            or yaml.safe_load(Path(RESOLVED.format(run=run)).read_text("utf-8"))
            for run in compared()
        }
    )


rule compare_runs:
    input:
        tables=compared_tables,
        facts=compared_facts,
    output:
        table=results("compare/collapse.csv").format(run=RUNS.name),
        png=shown(
            results("compare/collapse.png").format(run=RUNS.name),
            "compare",
            "Answer",
            "runs side by side",
            run=RUNS.name,
        ),
        pdf=results("compare/collapse.pdf").format(run=RUNS.name),
    log:
        logs("compare_runs").format(run=RUNS.name),
    params:
        differing=compared_settings,
    script:
        "scripts/figure_compare.py"


rule compare:
    """
    Several runs side by side, of a `grid`, of `scenarios` or finished ones: `compare/collapse.csv`
    and a figure.
    Costs: what its runs cost.
    """
    input:
        rules.compare_runs.output.table,
