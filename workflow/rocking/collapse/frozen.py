"""What a case is made of: mappings and lists that cannot be changed in place."""

from collections.abc import Mapping
from typing import Any, NoReturn


def _refused(self, *_: Any, **__: Any) -> NoReturn:
    raise TypeError("a Case cannot be changed in place; make another one by case.varied({…})")


class FrozenDict(dict):
    """A dict that refuses changes; `copy.deepcopy` of it is plain, and can be changed."""

    __setitem__ = __delitem__ = __ior__ = _refused  # type: ignore[assignment]
    clear = pop = popitem = setdefault = update = _refused  # type: ignore[assignment]

    def __deepcopy__(self, memo: Any) -> dict:
        """Return a plain copy."""
        return {key: thawed(value) for key, value in self.items()}

    def __reduce__(self) -> tuple:
        """Pickle as what it is made of."""
        return (frozen, (thawed(self),))


class FrozenList(list):
    """A list that refuses changes; copies of it are plain."""

    __setitem__ = __delitem__ = __iadd__ = __imul__ = _refused  # type: ignore[assignment]
    append = clear = extend = insert = pop = remove = reverse = sort = _refused  # type: ignore

    def __deepcopy__(self, memo: Any) -> list:
        """Return a plain copy."""
        return [thawed(value) for value in self]

    def __reduce__(self) -> tuple:
        """Pickle as what it is made of."""
        return (frozen, (thawed(self),))


def frozen(value: Any) -> Any:
    """Return a value with all its mappings and lists frozen, a copy."""
    if isinstance(value, Mapping):
        return FrozenDict((key, frozen(one)) for key, one in value.items())
    if isinstance(value, list):
        return FrozenList(frozen(one) for one in value)
    return value


def thawed(value: Any) -> Any:
    """Return a plain copy of a frozen value."""
    if isinstance(value, Mapping):
        return {key: thawed(one) for key, one in value.items()}
    if isinstance(value, list):
        return [thawed(one) for one in value]
    return value
