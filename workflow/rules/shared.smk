# What runs share (rocking/study/shared.py), in each run's folder too. A link is dated like what it is
# a link to: where code or the link is newer, nothing follows.
LINK = "(ln -f {input:q} {params.folder:q}/ || cp -p {input:q} {params.folder:q}/) 2> {log:q}"


rule shared_files:
    input:
        files=lambda w: SHARED.all_of(w.run, STUDY.records[w.run]),
        modules=code("records/link_shared"),
    output:
        "results/{run}/tables/shared.csv",
    log:
        "results/{run}/logs/shared_files.log",
    script:
        "../scripts/records/link_shared.py"


rule own_record:
    input:
        lambda w: [
            SHARED.path(w.run, f"records/{w.record}.{end}") for end in ("csv", "json")
        ],
    output:
        "results/{run}/records/{record}.csv",
        "results/{run}/records/{record}.json",
    log:
        "results/{run}/logs/own_record_{record}.log",
    params:
        folder=lambda w, output: Path(output[0]).parent,
    shell:
        LINK


use rule own_record as own_floor_motions with:
    input:
        lambda w: SHARED.path(w.run, f"smdof/{w.record}_{w.n}dof.csv"),
    output:
        "results/{run}/smdof/{record}_{n}dof.csv",
    log:
        "results/{run}/logs/own_floor_motions_{record}_{n}.log",


use rule own_record as own_figure with:
    input:
        lambda w: [
            SHARED.path(w.run, f"figures/{w.picture}_{w.record}.{end}")
            for end in ("png", "pdf")
        ],
    output:
        "results/{run}/figures/{picture}_{record}.png",
        "results/{run}/figures/{picture}_{record}.pdf",
    log:
        "results/{run}/logs/own_figure_{picture}_{record}.log",
    wildcard_constraints:
        picture="record|floor_motions",
