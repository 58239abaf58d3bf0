"""Cases of a free-rocking experiment: every block of every variant, as YADE takes them."""

from pathlib import Path

from rocking.mechanics import closed_forms
from rocking.runtime.script import run
from rocking.tables import write_json
from studies.validation import specimens
from studies.validation import study as validation

SWINGS = 6.0  # end of a history, in units of 1/p: past the third rebound


def main(job):
    experiment = validation.read(Path(job.input.files[0]).parent)
    release, rows = experiment.specimen["release_ratio"], []
    for name, case in specimens.cases(experiment).items():
        facade = case["facade"]
        p = closed_forms.block(facade["height_m"], facade["thickness_m"]).p_rad_s
        rows.append(
            {
                "id": name,
                "config": {key: case[key] for key in specimens.SECTIONS},
                "model": case["model"],
                "release_ratio": release,
                "beta_s": [case["beta_s"]],
                "limit_s": SWINGS / p,
            }
        )
    write_json(job.output[0], rows)


run(main, globals())
