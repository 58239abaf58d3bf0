"""The study's rigid block before its elastic building, for tests that are of these."""

from rocking import Case
from rocking.configuration import config
from rocking.configuration.study import as_in_the_study


def study_case(model, given=None):
    """Case of a model on the study's keys, with those given laid over them."""
    return Case.configured(model, as_in_the_study(given))


def study_settings(given=None):
    """Resolved configuration on the study's keys, with those given laid over them."""
    return config.resolve(as_in_the_study(given))
