"""Modes of a building under any floor load from one factorisation and a few vectors.

K does not depend on the load and the load adds mass to the panels alone, so the modes
without load and with a heavy one span those in between (Rayleigh–Ritz).
"""

import numpy as np
from scipy.linalg import eigh

from .case import panel_areas
from .modes import Modes, Solver

HEAVY_KG_M2 = 1500.0
MODES = 12


class LoadedModes:
    """Lowest modes of a building without floor load as a function of its floor load.

    MODES of each of the two solutions span the basis; as many are returned.
    """

    def __init__(self, building):
        """Solve at the two ends and reduce K."""
        solver = Solver(building.scene)
        self.scene, self.dof, self.mass = building.scene, solver.dof, solver.mass
        heavy = {i: HEAVY_KG_M2 * area for i, area in panel_areas(building).items()}
        self.added = (solver.mass_with(heavy) - self.mass) / HEAVY_KG_M2
        ends = [solver.modes(MODES, self.mass + q * self.added).phi for q in (0.0, HEAVY_KG_M2)]
        both = np.hstack(ends)
        self.basis = np.linalg.qr(both / np.linalg.norm(both, axis=0))[0]
        self.k = self.basis.T @ (solver.k @ self.basis)

    def modes(self, load_kg_m2):
        """Return the `Modes` under a load of 0 to about HEAVY_KG_M2 on every floor [kg/m²]."""
        mass = self.mass + load_kg_m2 * self.added
        squared, shapes = eigh(self.k, self.basis.T @ (mass[:, None] * self.basis))
        omega, phi = np.sqrt(squared[:MODES]), self.basis @ shapes[:, :MODES]
        return Modes.of(self.scene, self.dof, mass, omega, phi)
