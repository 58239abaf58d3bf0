# Fragility curves of the run's collapse intensities, efficiency of intensity measures, and the fragilities
# as OpenQuake reads them. Not part of the main job; ask for `fragility`.
from studies.shared.hazard import imt_of


wildcard_constraints:
    im="|".join(MEASURES),
    form="continuous|discrete",


def openquake_measures(run):
    """Intensity measures of a run that OpenQuake knows."""
    resolved = RUNS.settings[run]
    period_s = resolved["smdof"]["period_s"]
    return [im for im in resolved["fragility"]["measures"] if imt_of(im, period_s)]


rule fragility_table:
    input:
        collapse=rules.ida_collapse.output.collapse,
        probability=rules.ida_collapse.output.probability,
        records=of_run(rules.record.output.record),
    output:
        fragility=results("tables/fragility.csv"),
        measures=results("tables/intensity_measures.csv"),
        sufficiency=results("tables/im_sufficiency.csv"),
        brackets=results("fragility/brackets.csv"),
        curves=results("fragility/curves.csv"),
        factors=results("fragility/factors.csv"),
    params:
        stations=stations,
        fragility=value_of("fragility"),
        hazard_slope=value_of("risk.hazard_slope"),
        facade=values_of("facade", "height_m", "thickness_m"),
        smdof=values_of("smdof", "period_s", "damping_ratio"),
    script:
        "scripts/fragility_table.py"


figure_by(
    "studies/risk/scripts/fragility_figure",
    "fragility",
    "Fragility",
    "fragility curves",
    fragility=rules.fragility_table.output.fragility,
    curves=rules.fragility_table.output.curves,
    brackets=rules.fragility_table.output.brackets,
    facts=of_run(rules.record.output.facts),
    params=dict(
        confidence=value_of("fragility.confidence"),
        min_stations=value_of("fragility.min_stations"),
        facade=value_of("facade"),
        smdof=value_of("smdof"),
    ),
)


figure_by(
    "studies/risk/scripts/figure_intensity_measures",
    "intensity_measures",
    "Fragility",
    "efficiency of intensity measures",
    measures=rules.fragility_table.output.measures,
    sufficiency=rules.fragility_table.output.sufficiency,
    facts=of_run(rules.record.output.facts),
    params=dict(
        confidence=value_of("fragility.confidence"), min_stations=value_of("fragility.min_stations")
    ),
)


rule fragility_nrml:
    input:
        fragility=rules.fragility_table.output.fragility,
    output:
        results("fragility/nrml_{im}_{form}.xml"),
    params:
        period_s=value_of("smdof.period_s"),
    script:
        "scripts/fragility_nrml.py"


rule fragility:
    """
    Fragility curves and intensity measures from the run's IDA.
    Costs: 5 min on two free cores for 264 curves of the elastic wall; by curves.
    """
    input:
        every_run(
            rules.fragility_table.output.fragility,
            rules.fragility_table.output.measures,
            rules.fragility_table.output.sufficiency,
            rules.fragility_figure.output.png,
            rules.figure_intensity_measures.output.png,
            of_run(
                rules.fragility_nrml.output,
                im=openquake_measures,
                form=["continuous", "discrete"],
            ),
        ),
