"""The page that sets the study beside a run: its rows from docs/study.yaml, numbers from tables."""

import math

import pandas as pd
from rocking.collapse.probability import half_collapse, one_number

from studies.shared.statements import STUDY

MET = ("yes", "no", "partly", "given", "open")
COUNTED = ("met here", "not met", "met in part", "inputs, taken over", "open")
HEAD = "| | in the study | its value | here | met | why they differ |\n|---|---|---|---|---|---|"
NOT_RUN = "not part of this run"
SOURCES = {"file": "recorded", "surrogate": "surrogates"}
CLAIMS = ("claims_building", "claims_calibration", "claims")


def value(table, spec):
    """One number of a table, as text; without the table, its record or its model: not run.

    `spec` has where (column: value), column, digits; of several rows the one with the largest value
    of `largest`, or their `sum`, or their `count`. ValueError if no row, or more than one, is left.
    """
    if table is None:
        return NOT_RUN
    for column, wanted in spec["where"].items():
        if column in ("record", "model") and wanted not in set(table[column]):
            return NOT_RUN
        table = table[table[column] == wanted]
    if spec.get("largest"):
        table = table.loc[[table[spec["largest"]].idxmax()]]
    if spec.get("count"):
        return f"{len(table)}"
    if not spec.get("sum") and len(table) != 1:
        raise ValueError(f"{spec['table']}: {len(table)} rows where {spec['where']}, expected one")
    number = float(table[spec["column"]].sum())
    return "–" if math.isnan(number) else f"{number:.{spec['digits']}f}"


def row(entry, tables):
    """One row of the page: of an entry of docs/study.yaml, and tables of the run by name.

    ValueError if the entry is unknown to the tables of claims, or has no verdict.
    """
    here, met = [], entry.get("met")
    if "here" in entry:
        values = {
            key: value(tables.get(spec["table"]), spec)
            for key, spec in entry.get("values", {}).items()
        }
        here.append(entry["here"].format(**values))
    if "claim" in entry:
        verdicts, text = _claim(entry["claim"], tables)
        here.append(text)
        if met is None:
            met = "partly" if len(set(verdicts)) > 1 else verdicts[0] if verdicts else NOT_RUN
    elif met not in MET:
        raise ValueError(f"'{entry['id']}': met is '{met}', expected one of {', '.join(MET)}")
    if "table" in entry:
        here.append("below")
    cells = (entry["id"], entry["says"], entry["paper"], "; ".join(here), met, entry.get("why", ""))
    return "| " + " | ".join(str(cell).replace("|", r"\|") for cell in cells) + " |"


def _claim(start, tables):
    """Verdicts and measured text of a claim, for surrogates and recordings apart."""
    made = [tables[name] for name in CLAIMS if name in tables]
    if not made:
        return [], NOT_RUN
    claims = pd.concat(made, ignore_index=True)
    lines = claims[claims["claim"].str.startswith(start)]
    if not len(lines):
        return [], NOT_RUN
    texts = []
    for line in lines.fillna("").itertuples():
        source = line.records.split(":")[0] if ":" in line.records else ""
        source = f"{SOURCES.get(source, source)}: " if source else ""
        whose = "" if line.threshold == STUDY else "†"
        texts.append(f"{source}{line.measured}{whose}")
    return lines["holds"].tolist(), "; ".join(texts)


def markdown(heading, rows):
    """Lines of a table in Markdown, of the texts of its heading and of its rows."""
    first, *others = ["| " + " | ".join(cells) + " |" for cells in (heading, *rows)]
    return [first, "|---" * len(heading) + "|", *others]


def _source(record):
    """Where a motion of tables/records.csv comes from."""
    return "recorded" if record["source"] == "file" else record["source"]


def records(data, tables):
    """Table 1 beside the run's motions."""
    rows = []
    made = tables["records"].set_index("record") if "records" in tables else None
    for name, paper in data["table_1"].items():
        cells = [f"{p:g}" for p in paper]
        source = NOT_RUN
        if made is not None and name in made.index:
            motion = made.loc[name]
            source = _source(motion)
            columns = ("pga_g", "pgv_cm_s", "pgd_cm", "duration_s")
            cells = [f"{motion[c]:.3g} ({p:g})" for c, p in zip(columns, paper, strict=True)]
        rows.append([name, source, *cells])
    heading = ["record", "source", "PGA [g]", "PGV [cm/s]", "PGD [cm]", "duration [s]"]
    return markdown(heading, rows)


def errors(data, tables):
    """Table 2 beside the run's errors, the study's in brackets."""
    made, rows = tables.get("wme"), []
    for quantity, of_records in data["table_2"].items():
        for record, paper in of_records.items():
            cells = []
            for n, p in enumerate(paper, 1):
                where = {"record": record, "quantity": quantity, "n_dof": n}
                spec = {"table": "wme", "where": where, "column": "wme", "digits": 3}
                cells.append(f"{value(made, spec)} ({p:.3f})" if made is not None else f"({p:.3f})")
            rows.append([quantity.replace("_", " "), record, *cells])
    return markdown(["quantity", "record", "SDOF", "2DOF", "3DOF", "4DOF", "5DOF"], rows)


def collapse(data, tables):
    """Figure 9 in numbers: the PGA by which curves are compared, half collapse beside it.

    With the source of each curve's motion, for a surrogate only stands for one of the study's.
    """
    table = tables.get("ida_collapse")
    if table is None:
        return []
    table = table.assign(
        pga=one_number(table),
        half=half_collapse(table),
        curve=table["record"] + table["direction"].map({"pos": "+", "neg": "−"}),
    )
    made = tables.get("records")
    sources = (
        {} if made is None else {motion["record"]: _source(motion) for _, motion in made.iterrows()}
    )
    motions = dict(zip(table["curve"], table["record"], strict=True))
    wide = table.pivot(index="curve", columns="model", values=["pga", "half"])
    models = list(dict.fromkeys(table["model"]))
    both = "pga_equivalent_g" in table
    said = "equivalent PGA (half collapse) [g]" if both else "collapse PGA [g]"
    rows = []
    for curve in dict.fromkeys(table["curve"]):
        cells = []
        for model in models:
            pga, half = (wide.loc[curve, (of, model)] for of in ("pga", "half"))
            beside = f" ({half:.3f})" if both else ""
            cells.append("–" if math.isnan(pga) else f"{pga:.3f}{beside}")
        rows.append([curve, sources.get(motions[curve], NOT_RUN), *cells])
    return markdown([said, "motion", *models], rows)


BLOCKS = {"records": records, "wme": errors, "collapse": collapse}


def page(data, tables, about):
    """The page as Markdown; `about` says which run, and how to make the page again."""
    rows = [entry for section in data["sections"] for entry in section["rows"]]
    verdicts = [row(entry, tables).split(" | ")[-2] for entry in rows]
    count = [f"{verdicts.count(word)}" for word in MET]
    lines = ["# The 3DEC study, row by row", "", data["study"]]
    lines += [f"Of its {len(rows)} figures, tables, equations and results there are", ""]
    lines += [*markdown(COUNTED, [count]), "", about, ""]
    lines += [data["suite"]] if "suite" in data else []
    for section in data["sections"]:
        lines += [f"## {section['title']}", "", HEAD]
        lines += [row(entry, tables) for entry in section["rows"]]
        for entry in section["rows"]:
            if "table" in entry:
                block = BLOCKS[entry["table"]](data, tables)
                lines += ["", f"{entry['id'].capitalize()}: {entry['says']}", "", *block]
        for entry in section["rows"]:
            if "figure" in entry:
                title = entry["id"].rstrip("abcdef").capitalize()
                lines += ["", f"![{title}, as made here](figures/{entry['figure']}.png)"]
        lines.append("")
    return "\n".join(lines).rstrip() + "\n"
