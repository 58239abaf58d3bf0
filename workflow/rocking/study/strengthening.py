"""What `strengthening` and `restraint` make: façades that one more tie or floor holds."""

from rocking.configuration.config import ConfigError
from rocking.configuration.facade import check_facade
from yade_scripts.model.registry import MODELS


class Strengthening:
    """Files of both targets, curve by curve."""

    def __init__(self, study):
        """Keep the study."""
        self.study = study

    def results(self, run) -> list[str]:
        """Everything the target `strengthening` makes for one run."""
        curves = self.curves(run, "strengthening", ".png")
        return [f"results/{run}/tables/strengthening.csv", *curves]

    def restraint_results(self, run) -> list[str]:
        """Everything the target `restraint` makes for one run."""
        directions = self.study.runs[run]["directions"]
        keys = [(record, sign) for record in self.study.records[run] for sign in directions]
        return [f"results/{run}/restraint/{record}_{sign}.png" for record, sign in keys]

    def curves(self, run, target, ending, record=None, direction=None) -> list[str]:
        """Files of a target of the models with a planar twin, of one record and direction or all.

        Ends the workflow in one line where the façade cannot have what the target adds.
        """
        from rocking.studies import restraint, strengthening  # slow to load

        resolved = self.study.runs[run]
        models = [model for model in resolved["models"] if MODELS[model].twin]
        settings = resolved[target]
        if target == "restraint":
            trials = [restraint.held(resolved, settings["loads_kn"][0], 0.0)]
        else:
            heights = strengthening.trial_heights(settings, resolved["facade"]["height_m"])
            force = settings["forces_kn"][0]
            trials = [strengthening.tied(resolved, settings, z, force) for z in heights]
        try:
            if not models:
                raise ConfigError(f"models = {resolved['models']}: expected one with a planar twin")
            for trial in trials:
                check_facade({**trial, "models": models})
        except ConfigError as error:
            raise SystemExit(f"error: {target}: {error.detail}") from None
        return [
            f"results/{run}/{target}/{model}/{name}_{sign}{ending}"
            for model, name, sign in self.study.curves(run)
            if model in models and record in (None, name) and direction in (None, sign)
        ]
