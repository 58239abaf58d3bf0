"""Storeys that yield as arrays, for thousands of histories side by side.

The laws are those of `yade_scripts.model.storeys`, whose strength does not fall here, written apart
as forces: V = α k u + (1 − α) k w with w the elastic part of the drift, and lines between peaks.
"""

import numpy as np

HARDENING, FLAG_SHARE = 0.02, 0.3  # α, share b of the bilinear law


class Response:
    """Shear forces of storeys that are moved step by step; arrays of shape (histories, n)."""

    def __init__(self, law, yield_n, stiffness_n_m, histories):
        """Storeys at rest; V_y and k have shape (n,)."""
        self.law, self.k, self.v_y = law, stiffness_n_m, yield_n
        self.u_y = yield_n / stiffness_n_m
        shape = (histories, stiffness_n_m.size)
        self.drift_m, self.shear_n = np.zeros(shape), np.zeros(shape)
        self.peak_m = np.zeros((2, *shape))  # largest drift so far outward and inward (≥ 0)
        self.plastic_m = np.zeros(shape)  # of the bilinear law: where its elastic part is at rest
        self.crossed_m = np.zeros(shape)  # of the peak-oriented law: where it last crossed V = 0

    def backbone(self, drift_m):
        """Shear of the first loading to a drift ≥ 0 [N]."""
        beyond = self.v_y + HARDENING * self.k * (drift_m - self.u_y)
        return np.where(drift_m < self.u_y, self.k * drift_m, beyond)

    def move(self, drift_m):
        """Move all storeys to a drift [m]; return their shear force [N], opposing the drift."""
        self.peak_m[0] = np.maximum(self.peak_m[0], drift_m)
        self.peak_m[1] = np.maximum(self.peak_m[1], -drift_m)
        self.shear_n = getattr(self, f"_{self.law}")(drift_m)
        self.drift_m = drift_m
        return self.shear_n

    def _bilinear(self, u):
        elastic = np.clip(u - self.plastic_m, -self.u_y, self.u_y)
        self.plastic_m = u - elastic
        return self.k * (HARDENING * u + (1.0 - HARDENING) * elastic)

    def _flag(self, u):
        spring = np.sign(u) * self.backbone(np.abs(u))
        return FLAG_SHARE * self._bilinear(u) + (1.0 - FLAG_SHARE) * spring

    def _origin_oriented(self, u):
        peak = np.maximum(np.where(u >= 0.0, *self.peak_m), self.u_y)
        return u * self.backbone(peak) / peak

    def _peak_oriented(self, u):
        out, inward = np.maximum(self.peak_m, self.u_y)
        trial = self.shear_n + self.k * (u - self.drift_m)
        crosses = (trial * self.shear_n < 0.0) | ((self.shear_n == 0.0) & (trial != 0.0))
        zero = self.drift_m - self.shear_n / self.k
        self.crossed_m = np.where(crosses, zero, self.crossed_m)
        side = np.where(trial >= 0.0, 1.0, -1.0)
        along, start = side * u, side * self.crossed_m
        peak = np.where(side > 0.0, out, inward)
        span = np.maximum(peak - start, 1e-3 * self.u_y)
        line = self.backbone(peak) * np.clip((along - start) / span, 0.0, 1.0)
        most = np.where(along >= peak, self.backbone(np.maximum(along, 0.0)), line)
        return side * np.minimum(np.abs(trial), most)
