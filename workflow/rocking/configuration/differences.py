"""What differs between the configurations of runs."""

import itertools
from collections.abc import Mapping


def by_path(settings, prefix=""):
    """Yield (dotted key, value) of nested mappings; lists are values."""
    for key, value in settings.items():
        if isinstance(value, Mapping):
            yield from by_path(value, f"{prefix}{key}.")
        else:
            yield f"{prefix}{key}", value


def flat(settings, prefix=""):
    """Values of nested mappings by dotted key, as `by_path`."""
    return dict(by_path(settings, prefix))


def differences(configurations):
    """What differs between the resolved configurations of runs, by run.

    The dotted keys that are not the same in all, with their value there (None where an older run
    lacks the key).
    """
    flattened = {run: flat(settings) for run, settings in configurations.items()}
    keys = list(dict.fromkeys(itertools.chain.from_iterable(flattened.values())))
    keys = [
        key
        for key in keys
        if key not in ("run", "compare")
        and any(
            values.get(key) != next(iter(flattened.values())).get(key)
            for values in flattened.values()
        )
    ]
    return {run: {key: values.get(key) for key in keys} for run, values in flattened.items()}
