# What runs share (rocking/runs/shared.py), in each run's folder too. A link is dated like what it is
# a link to: where code or the link is newer, nothing follows.
# Snakemake dates the outputs of a job one after the other, and so what they are links to. Of several files
# the first alone is an input, or a tick of the clock between two would make an output older than an input.
LINK = "(ln -f {params.files:q} {params.folder:q}/ || cp -p {params.files:q} {params.folder:q}/) 2> {log:q}"
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


rule shared_files:
    input:
        files=all_of(of_run(*SHARED_FILES, cases=each_record), rules.floor_motions.output),
        modules=code("records/link_shared"),
    output:
        results("tables/shared.csv"),
    log:
        logs("shared_files"),
    script:
        "../scripts/records/link_shared.py"


rule own_record:
    input:
        of_run(rules.record.output.record),
    output:
        record=results("records/{record}.csv"),
        facts=results("records/{record}.json"),
    log:
        logs("own_record_{record}"),
    params:
        files=of_run(rules.record.output),
        folder=lambda w, output: Path(output[0]).parent,
    shell:
        LINK


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
        lambda w: of_run(PICTURES[w.picture].png)(w),
    output:
        results("figures/{picture}_{record}.png"),
        results("figures/{picture}_{record}.pdf"),
    log:
        logs("own_figure_{picture}_{record}"),
    wildcard_constraints:
        picture="record|floor_motions",
    params:
        files=lambda w: of_run(PICTURES[w.picture])(w),
