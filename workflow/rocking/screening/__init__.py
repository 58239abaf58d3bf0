"""Compiled planar solver of the single-block scenes: it screens amplitudes, YADE confirms them.

It reads the scene description that YADE's scenes are built from, reduced to its plane (`prepare`):
one free block, nodes with tension cut-off, incremental shear under Coulomb's limit, dashpots β·k
and bonds that break, as YADE's viscoelastic law and the project's bonds have them. Supports are
driven, or carried by masses of a chain that feel the block (`bodies`); ground and walls may move
vertically too.

The scheme is leapfrog in the frame of the ground. Dashpots act at the velocity of the whole step,
by a 3 × 3 solve, and the first force of a node that closes within a step is weighted by the share
of the step for which it touches; so the error falls with the square of the step through impacts.
The nodes of a joint stand on one line: open ones are not visited, and a joint that touches with
all its nodes, none sliding, is summed in closed form.

Measured with 17 nodes at the base and 17 up each block, on a busy core: 130–190 ns a step of W2,
10.5 ms a history at a step of 0.4 ms (mean of 4,400: 44 horizontal components, both directions,
0.05 to 1 g; 28 simulated seconds each, 2,700 a second). At that step the d/b of 17 W2 histories of
two records that repeat differs by 0.06 % (median) and 0.4 % (worst) from the judge, `planar`, and
that of six by 0.2 % and 0.4 % from YADE at 0.05 of its critical step; of six W1 histories by
0.2 % and 1.2 %, there within 0.2 % of the judge. Near collapse no solver repeats: run many
amplitudes.
"""

from .plane import Planar, moving_supports, prepare
from .runs import Motions, Peaks, Series, bodies, history, peaks, stable_step

__all__ = [
    "Motions",
    "Peaks",
    "Planar",
    "Series",
    "bodies",
    "history",
    "moving_supports",
    "peaks",
    "prepare",
    "stable_step",
]
