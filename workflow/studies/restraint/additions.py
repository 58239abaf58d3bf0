"""Whether a façade can have what a study adds to it."""

from rocking.collapse.case import Case
from rocking.configuration.config import ConfigError
from rocking.configuration.facade import check_facade

from yade_scripts.model.registry import MODELS


def planar_models(resolved, trials):
    """Models of a run with a planar counterpart, if its façade can have every one of `trials`.

    Parameters
    ----------
    resolved : dict
        A run's configuration.
    trials : list of Variant
        The façade with a tie or a floor more.

    Raises
    ------
    ConfigError
        Where no model has a planar counterpart, or the façade cannot have what is tried.
    """
    models = [model for model in resolved["models"] if MODELS[model].compiled]
    if not models:
        raise ConfigError(f"models = {resolved['models']}: expected one with a planar counterpart")
    for trial in trials:
        check_facade({**Case(resolved).varied(trial).sections, "models": models})
    return models
