"""The one error of this package."""


class RecordError(ValueError):
    """A record, records table or surrogate that cannot be used; the text is for the user.

    One line that names the file, the line (counted from 1) or table row where there
    is one, and what was expected.
    """

    @classmethod
    def at(cls, path, line, message):
        """Build the error for a place in a file, "path, line n: message"."""
        return cls(f"{path}, line {line}: {message}")
