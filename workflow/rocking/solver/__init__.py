"""Compiled planar solver of the single-block scenes: it screens amplitudes, YADE confirms them.

It reads the scene description that YADE's scenes are built from, reduced to its plane (`to_plane`):
one free block, nodes with tension cut-off, incremental shear under Coulomb's limit, dashpots β·k
and bonds that break, as YADE's viscoelastic law and the project's bonds have them. Supports are
driven, or carried by masses of a chain that feel the block (`bodies`); ground and walls may move
vertically too.

The scheme is leapfrog in the frame of the ground. Dashpots act at the velocity of the whole step,
by a 3 × 3 solve, and the first force of a node that closes within a step is weighted by the share
of the step for which it touches; so the error falls with the square of the step through impacts.
The nodes of a joint stand on one line: open ones are not visited, and a joint that touches with
all its nodes, none sliding, is summed in closed form. Histories march side by side in vectors
(`march`), of one motion or of many, by the same text and with the digits of one after the other:
one block (`block`) or several (`stack_kernel`), whatever they meet. `docs/solver.md` shows a step.

What it costs and how far it agrees with `reference` stands in `docs/record.md`, in topic accuracy.
Near collapse no solver repeats: run many amplitudes.
"""

from .motions import Motions
from .plane import Planar, moving_supports, to_plane
from .runs import Peaks, Series, history, peaks, stable_step
from .substructure import bodies

__all__ = [
    "Motions",
    "Peaks",
    "Planar",
    "Series",
    "bodies",
    "history",
    "moving_supports",
    "peaks",
    "to_plane",
    "stable_step",
]
