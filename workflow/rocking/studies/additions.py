"""Whether a façade can have what `strengthening` and `restraint` add to it."""

from rocking.collapse.case import Case
from rocking.configuration.config import ConfigError
from rocking.configuration.facade import check_facade
from rocking.studies import restraint, strengthening
from yade_scripts.model.registry import MODELS


def planar_models(resolved, target):
    """Models of a run that "strengthening" or "restraint" searches with, if the façade allows it.

    ConfigError where no model has a planar counterpart, or the façade cannot have a tie or floor
    that is tried.
    """
    models = [model for model in resolved["models"] if MODELS[model].compiled]
    if not models:
        raise ConfigError(f"models = {resolved['models']}: expected one with a planar counterpart")
    settings, height = resolved[target], resolved["facade"]["height_m"]
    if target == "restraint":
        trials = [restraint.roof(height, settings["loads_kn"][0], 0.0)]
    else:
        heights = strengthening.trial_heights(settings, height)
        force = settings["forces_kn"][0]
        trials = [strengthening.tie(settings, z, force) for z in heights]
    for trial in trials:
        check_facade({**Case(resolved).varied(trial).sections, "models": models})
    return models
