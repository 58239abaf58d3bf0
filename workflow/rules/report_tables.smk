# Tables that the report shows as pages.
import yaml

REPORT_STYLE = str(BASE / "workflow" / "report" / "table.css")
REPORT_TABLES = {
    name: about
    for path in (
        BASE / "workflow" / "report" / "tables.yaml",
        *sorted(STUDIES.glob("*/tables.yaml")),
    )
    for name, about in yaml.safe_load(path.read_text("utf-8")).items()
}


def with_pages(paths):
    """Paths, and pages of the report for the tables among them that the report knows."""
    pages = []
    for path in map(Path, paths):
        run, folder, table = path.parts[-3], path.parts[-2], path.stem
        if folder == "tables" and table in REPORT_TABLES:
            pages.append((rules.report_table.output[0], run, table))
        if folder == "tables" and table == "records":
            pages.append((rules.report_provenance.output[0], run, table))
        if folder == "tables" and table == "ida_collapse":
            pages.append((rules.report_table.output[0], run, "run_times"))
            pages.append((rules.report_summary.output.page, run, table))
    return [*paths, *(p.format(run=run, table=table) for p, run, table in pages)]


wildcard_constraints:
    table="|".join(REPORT_TABLES),
