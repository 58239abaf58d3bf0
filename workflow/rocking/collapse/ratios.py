"""Ratios of collapse intensities, one curve each, and how they spread."""

import numpy as np


class Ratios:
    """Ratios between two intensities of each curve, blank where one of the two never collapsed.

    Parameters
    ----------
    values : array_like
        NaN where one of the two is not known.

    Attributes
    ----------
    known : ndarray
    n, n_censored : int
        Curves, and those of which the ratio is not known.
    """

    def __init__(self, values):
        """Keep the known ones."""
        values = np.asarray(values, float)
        self.known = values[np.isfinite(values)]
        self.n, self.n_censored = values.size, values.size - self.known.size

    def percentiles(self, levels, log=False):
        """Percentiles; `log`: linear between logarithms; NaN without a known ratio."""
        if not self.known.size:
            return np.full(len(levels), np.nan)
        if log:
            return np.exp(np.percentile(np.log(self.known), levels))
        return np.percentile(self.known, levels)

    @property
    def scatter(self):
        """Standard deviation of the logarithm; NaN of fewer than two."""
        return float(np.std(np.log(self.known), ddof=1)) if self.known.size > 1 else np.nan

    def share(self, low=-np.inf, high=np.inf):
        """Share of the known ones above `low` and up to `high`; NaN without any."""
        inside = (self.known > low) & (self.known <= high)
        return float(np.mean(inside)) if self.known.size else np.nan
