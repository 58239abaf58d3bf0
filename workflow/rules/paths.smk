# Where results lie, and how a rule asks for what other rules make. A path is written once, in the rule
# that makes it; other rules name that rule: `rules.planar_ida.output.scan`, or by the functions below.
from snakemake.io import get_wildcard_names

# A module's `prefix` is of results alone: Snakemake would put it before records and the code's stamps too,
# and not into params. Kept at the modifier, which every `use rule` of one module shares.
if (modifier := workflow.modifier.path_modifier) and getattr(modifier, "prefix", None):
    modifier.of_results, modifier.prefix = modifier.prefix, None
RESULTS = getattr(modifier, "of_results", "") + "results"


class Of(dict):
    """Wildcards for an input function that is called outside a job: `Of(run="main")`."""

    __getattr__ = dict.__getitem__


def results(path):
    """Path of a run's file, for the output of a rule."""
    return f"{RESULTS}/{{run}}/{path}"


def logs(name):
    """Log file of a rule, for its directive `log`."""
    return results(f"logs/{name}.log")


def benchmarks(name):
    """Time and memory of a rule's jobs, for its directive `benchmark`."""
    return results(f"benchmarks/{name}.tsv")


def shared(path):
    """Path of a file that runs with equal motions share (rocking/runs/shared.py)."""
    return f"{RESULTS}/.shared/{{motions}}/{path}"


def of_run(*outputs, cases=None, **values):
    """Input function: outputs of rules for a job's run and all that the job leaves open.

    Models, records and directions are the job's own, else all of its run. `values` gives others: one, a
    list, or a function of the run's name. `cases` gives them together: a function of the run's name that
    returns curves, or dictionaries of wildcards. Values that are given vary slowest, the first of them
    slowest of all. Where nothing is left open, one path instead of a list.
    """

    patterns = [path for output in outputs for path in as_list(output)]

    def files(wildcards):
        run = wildcards.run
        given = {k: v(run) if callable(v) else v for k, v in values.items()}
        rest = {**RUNS.wildcards(run), **dict(wildcards)}
        known = {**given, **{k: v for k, v in rest.items() if k not in given}}
        if cases is None and is_one(patterns, known):
            return expand(patterns, **known)[0]
        rows = [{}] if cases is None else [as_wildcards(case) for case in cases(run)]
        return [path for row in rows for path in expand(patterns, **{**known, **row})]

    return files


def as_list(paths):
    """Paths as a list, where one of them may stand alone."""
    return [paths] if isinstance(paths, str) else list(paths)


def as_wildcards(case):
    """Wildcards of a curve; dictionaries as they are."""
    return case if isinstance(case, dict) else case._asdict()


def is_one(patterns, known):
    """Whether patterns are a single path once their wildcards have these values."""
    names = get_wildcard_names(patterns[0]) if len(patterns) == 1 else {""}
    return all(isinstance(known.get(name), (str, int)) for name in names)


def all_of(*outputs):
    """Input function: outputs of rules, as `of_run` expands them, and input functions, as one list."""
    functions = [entry if callable(entry) else of_run(entry) for entry in outputs]
    return lambda w: [path for f in functions for path in as_list(f(w))]


def where(asked, *outputs):
    """Like `all_of` for the runs that ask for it, by their name; else nothing."""
    return lambda w: all_of(*outputs)(w) if asked(w.run) else []


def every_run(*outputs):
    """Input function of a target: `all_of` of every run, and the report's pages of its tables."""

    def files(wildcards=None):
        jobs = [Of(run=run) for run in RUNS.settings]
        paths = [path for job in jobs for path in all_of(*outputs)(job)]
        return with_pages(list(dict.fromkeys(paths)))

    return files


def of_alike(function):
    """Input or params function of a file that runs share, from that of one of the runs."""
    return lambda w: function(Of(dict(w), run=SHARED.alike(w)[0]))
