# Tables that the report shows as pages: category, label and text of each; functions only.

REPORT_STYLE = str(BASE / "workflow" / "report" / "table.css")

REPORT_TABLES = {
    "records": (
        "Records",
        "records",
        "Records of this run with their source (file or surrogate), step, duration and peaks.",
    ),
    "ida_collapse": (
        "Incremental dynamic analyses",
        "collapse intensities",
        "Highest standing intensity below the first collapse and lowest collapsing intensity of"
        " every curve; median and band come from the perturbed ensemble where one was run.",
    ),
    "run_times": (
        "Run times",
        "run times of the analyses",
        "Wall and processor time and memory of every analysis; runs and steps that YADE made in"
        " it, and their wall time. The rest of the job is start-up and output.",
    ),
    "fragility": (
        "Fragility",
        "fitted curves",
        "Median and dispersion (standard deviation of the logarithm) of the lognormal collapse"
        " intensity, by maximum likelihood with censoring; interval of the median from records"
        " drawn with replacement; curves in all and without collapse.",
    ),
    "intensity_measures": (
        "Fragility",
        "efficiency of intensity measures",
        "Dispersion of the collapse intensity and its interval; share of the draws in which it is"
        " below that of PGA.",
    ),
    "capacity_reduction": (
        "Capacity reduction",
        "W2/W1 of every record",
        "Collapse PGA with floor motions over that with the ground motion everywhere. Censored: one"
        " of the two never collapsed, and the ratio is not used.",
    ),
    "building_modes": (
        "Building",
        "periods beside the study's",
        "Periods and effective mass ratios of the lowest modes, with the study's periods where the"
        " mode corresponds to one.",
    ),
    "wme": (
        "Building",
        "2: weighted mean error beside the study's",
        "Weighted mean error (eq. 1) of equal chains against SBDEM, with Table 2 of the study.",
    ),
    "building_alternatives": (
        "Building",
        "periods of alternative plans",
        "The four periods that the study gives, for the plan in use and for others that its text"
        " allows.",
    ),
    "beta_fit": (
        "Calibration of the damping",
        "best-fitting β beside eq. 5",
        "β whose rebounds come closest to the observed ones, beside eq. 5 of the study.",
    ),
    "claims": (
        "The study beside these results",
        "claims",
        "What the study states, and what was measured here.",
    ),
}


def with_pages(targets):
    """Targets, and a page of the report for every table among them that the report knows."""
    pages = []
    for path in targets:
        run, folder, name = Path(path).parts[-3:]
        table = name.removesuffix(".csv")
        if folder == "tables" and table in REPORT_TABLES:
            pages.append(f"results/{run}/report/{table}.html")
        if folder == "tables" and table == "records":
            pages.append(f"results/{run}/report/provenance.html")
        if folder == "tables" and table == "ida_collapse":
            pages.append(f"results/{run}/report/run_times.html")
    return [*targets, *pages]


wildcard_constraints:
    table="|".join(REPORT_TABLES),
