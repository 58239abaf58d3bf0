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
        "Highest intensity up to which nothing fell, lowest that fell, and the intensities at which 10,"
        " 50 and 90 % collapse is first reached, with the range in which that may be; the threshold that falls as"
        " often in a year; how often the outcome reverses, how many runs of the"
        " planar solver and of YADE stand behind the row, and at how many levels they disagree.",
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
        " intensity, by maximum likelihood with censoring; interval of the median from stations"
        " drawn with replacement, none from fewer than seven; curves in all and without collapse.",
    ),
    "intensity_measures": (
        "Fragility",
        "efficiency of intensity measures",
        "Dispersion of the collapse intensity and its interval; share of the draws in which it is"
        " below that of PGA.",
    ),
    "im_sufficiency": (
        "Fragility",
        "sufficiency of intensity measures",
        "Slope of the logarithm of the collapse intensity on that of a property of the motion, with its"
        " interval; sufficient: the interval holds zero, the measure says all that the property does.",
    ),
    "risk": (
        "Risk",
        "rate of collapse",
        "Annual rate of collapse and its probability within the stated years, from the hazard curve and"
        " the fitted fragility; intervals from stations drawn with replacement, none from fewer than seven. They hold neither the"
        " uncertainty of the hazard nor that of the façade. Outside share: part of the rate from"
        " intensities beyond the hazard table, where its outer slopes go on.",
    ),
    "surrogate_trust": (
        "Records",
        "surrogates compared with their records",
        "Ratio of the collapse PGA of surrogates to that of their records, by half of the stations: its"
        " median, percentiles and scatter (standard deviation of the logarithm); share within 20 %;"
        " share of records whose weak side is that of the surrogate, and the median |ln(pos/neg)| of"
        " both. Pulses: how many of the record's own velocity pulses the surrogate keeps.",
    ),
    "surrogate_scatter": (
        "Records",
        "draws of surrogates",
        "PGA of collapse over draws of a surrogate that differ in their noise: median, percentiles and"
        " scatter (standard deviation of the logarithm); beside it that of the recorded motion, and the"
        " share of draws that collapse below it. Pulses: blank where a table gives the parameters.",
    ),
    "capacity_reduction": (
        "Capacity reduction",
        "W2/W1 of every record",
        "Collapse PGA with floor motions over that with the ground motion everywhere: half collapse, and the"
        " equivalent PGA, which counts every range of collapse and which the figure shows. Censored: one of"
        " the two never collapsed.",
    ),
    "strengthening": (
        "Strengthening",
        "least ties",
        "Least force at which a row of ties has to yield so that the collapse probability at the"
        " stated intensity is at most the accepted one, by height of the row, with its interval;"
        " share of YADE's realisations that fell where it was confirmed. Blank: no tie tried holds.",
    ),
    "claims": (
        "Compared with the study",
        "claims of the study",
        "What the study says about boundary conditions compared with what this run measured. Collapse"
        " intensities are those at which half collapse, else the middle of their bracket.",
    ),
    "claims_building": (
        "Compared with the study",
        "claims of the study, building",
        "What the study's section 2 says of the building and its equivalent chain compared with what this"
        " run measured; whose number decides stands in the column threshold.",
    ),
    "claims_calibration": (
        "Compared with the study",
        "claims of the study, damping",
        "What the study's section 3 says of damping compared with what this run measured; whose number"
        " decides stands in the column threshold.",
    ),
    "building_modes": (
        "Compared with the study",
        "periods of the building",
        "Periods and effective mass ratios of the lowest modes, with the study's periods where the"
        " mode corresponds to one. Only the floor load was fitted, to the period of CBDEM along y.",
    ),
    "building_alternatives": (
        "Building",
        "periods of alternative plans",
        "The four periods that the study gives, for the plan in use and for others that its text"
        " allows.",
    ),
    "wme": (
        "Compared with the study",
        "2: weighted mean error of chains",
        "Weighted mean error (eq. 1) of equal chains against SBDEM, with Table 2 of the study.",
    ),
    "beta_fit": (
        "Compared with the study",
        "best-fitting β and eq. 5",
        "β whose rebounds come closest to the observed ones, compared with eq. 5 of the study.",
    ),
    "free_rocking": (
        "Calibration of the damping",
        "rebounds and e_exp",
        "Time of each of the first three impacts, the rotation |θn|/α reached after it, and e_exp"
        " (eq. 4) compared with |e_1SR| (eq. 3). A blank row is an impact without a rebound.",
    ),
    "pushover": (
        "Boundary conditions",
        "static capacities",
        "Static capacities as pushed in YADE, compared with the kinematic values.",
    ),
    "accuracy_summary": (
        "Accuracy and stability",
        "spread of errors by method",
        "Share of histories within 1 %, median and worst error by half, method, nodes and step.",
    ),
    "speed_accuracy": (
        "Accuracy and stability",
        "speed against accuracy",
        "Error against a converged reference and speed, by scene, method, nodes and step.",
    ),
    "stability": (
        "Accuracy and stability",
        "critical step",
        "Whether a step is stable by prediction and as observed, on both sides of the critical one.",
    ),
    "stability_limits": (
        "Accuracy and stability",
        "how large a step is stable",
        "Critical step found by bisection in YADE and as predicted from the scene's stiffness and mass, by"
        " damping and stiffness of the joints (1: the façade's own).",
    ),
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
