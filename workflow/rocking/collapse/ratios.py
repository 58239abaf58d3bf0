"""Ratios of collapse intensities, one curve each, and how they spread."""

import numpy as np
import pandas as pd


class Ratios:
    """Ratios between two intensities of each curve, NaN where one of the two never collapsed.

    `known` are the known ones, `n_known` of `n`, and `n_censored` the others.
    """

    def __init__(self, values):
        """Keep the known ones."""
        values = np.asarray(values, float)
        self.known = values[np.isfinite(values)]
        self.n, self.n_known = values.size, self.known.size
        self.n_censored = self.n - self.n_known

    def percentiles(self, levels, log=False):
        """Percentiles; `log`: linear between logarithms; NaN without a known ratio."""
        if not self.known.size:
            return np.full(np.shape(levels), np.nan)
        if log:
            return np.exp(np.percentile(np.log(self.known), levels))
        return np.percentile(self.known, levels)

    @property
    def mean(self):
        """Geometric mean; NaN without any."""
        return float(np.exp(np.log(self.known).mean())) if self.known.size else np.nan

    @property
    def scatter(self):
        """Standard deviation of the logarithm; NaN of fewer than two."""
        return float(np.std(np.log(self.known), ddof=1)) if self.known.size > 1 else np.nan

    def share(self, low=-np.inf, high=np.inf):
        """Share of the known ones above `low` and up to `high`; NaN without any."""
        inside = (self.known > low) & (self.known <= high)
        return float(np.mean(inside)) if self.known.size else np.nan

    def said(self, what):
        """Percentile by number, attribute by name, or what a function says of these ratios."""
        if callable(what):
            return what(self)
        return getattr(self, what) if isinstance(what, str) else self.percentiles(what)


def spread(table, by, columns):
    """How the column ratio of a table spreads, a row a group `by`, in the order they appear.

    `columns` says by column what a row has, see `Ratios.said`.
    """
    rows = []
    for key, part in table.groupby(by, sort=False):
        ratios = Ratios(part["ratio"])
        rows.append((*key, *(ratios.said(what) for what in columns.values())))
    return pd.DataFrame(rows, columns=[*by, *columns])
