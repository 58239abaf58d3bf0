# Pictures of the models, and what the study says about boundary conditions.
BRICKS_PUSHED = of_run(rules.pushover_curve.output[0], pushed="W3")


figure_by(
    "studies/paper/scripts/fig07_models",
    "fig07_models",
    "Boundary conditions",
    "7: the five models",
    frames=of_run(rules.frames.output[0], model=WITH_WALLS),
    facts=of_run(rules.own_record.output.facts, record=picture_record),
    params=dict(config=RUNS.params_of("facade", "return_wall", "w3", "pictures")),
)


rule table_claims:
    input:
        collapse=rules.ida_collapse.output.collapse,
        facts=of_run(rules.record.output.facts),
        pushover=where(lambda run: "W3" in RUNS.settings[run]["models"], BRICKS_PUSHED),
    output:
        shown_table("claims", "Boundary conditions", "claims of the study"),
    params:
        w3=RUNS.params_of("w3"),
    script:
        "scripts/table_claims.py"


rule boundary:
    """
    With the file that `study` takes: cohesion, interlocking, pushover, Figures 7, 8, 9,
    `tables/claims.csv`.
    Costs: 6 min on two free cores; W3 most.
    """
    input:
        every_run(
            rules.table_pushover.output,
            rules.table_claims.output,
            rules.fig07_models.output.png,
            rules.fig08_w3.output.png,
            rules.fig09_ida.output.png,
        ),
