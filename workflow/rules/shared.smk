# Files that runs share (rocking/runs/shared.py) lie in each run's folder too. A shared file that is asked
# for alone, or was deleted, comes back as a copy. A link would not do: Snakemake sets the date of a job's
# output to the present, a link passes that date on to its target, and all that was computed from the target
# would be due again. The next `shared_files` replaces the copy by a link.
COPY = "cp -p {params.files:q} {params.folder:q}/ 2> {log:q}"
SHARED_FILES = (
    rules.record.output,
    rules.figure_record.output,
    rules.figure_floor_motions.output,
)
PICTURES = {
    "record": rules.figure_record.output,
    "floor_motions": rules.figure_floor_motions.output,
}


def each_record(run):
    """Wildcards of the records of a run, one after the other."""
    return [{"record": record} for record in RUNS.records[run]]


of_records = all_of(of_run(*SHARED_FILES, cases=each_record), rules.floor_motions.output)


rule shared_files:
    input:
        files=of_records,
    output:
        results("tables/shared.csv"),
    script:
        "../scripts/records/link_shared.py"


rule own_record:
    input:
        of_run(rules.record.output),
    output:
        record=results("records/{record}.csv"),
        facts=results("records/{record}.json"),
    log:
        logs("own_record_{record}"),
    params:
        files=of_run(rules.record.output),
        folder=lambda w, output: Path(output[0]).parent,
    shell:
        COPY


use rule own_record as own_floor_motions with:
    input:
        of_run(rules.floor_motions.output),
    output:
        results("smdof/{record}_{n}dof.csv"),
    log:
        logs("own_floor_motions_{record}_{n}"),
    params:
        files=of_run(rules.floor_motions.output),


use rule own_record as own_figure with:
    input:
        lambda w: of_run(PICTURES[w.picture])(w),
    output:
        results("figures/{picture}_{record}.png"),
        results("figures/{picture}_{record}.pdf"),
    log:
        logs("own_figure_{picture}_{record}"),
    wildcard_constraints:
        picture="record|floor_motions",
    params:
        files=lambda w: of_run(PICTURES[w.picture])(w),


def deleted_links(wildcards):
    """Input function: a run's own names for shared files that are gone or another file since.

    No rule takes them as input, so Snakemake would not miss them; which of the others differ,
    digests tell.
    """
    (made,) = expand(rules.shared_files.output, run=wildcards.run)
    if not Path(made).exists():
        return []
    kept = [Path(path) for path in of_records(wildcards)]
    named = [(path, Path(made).parents[1].joinpath(*path.parts[-2:])) for path in kept]
    return [name.as_posix() for path, name in named if not name.exists() or is_other(name, path)]


def is_other(name, kept):
    """Whether a run's name is of another file than the shared one that is there."""
    return kept.exists() and not name.samefile(kept)
