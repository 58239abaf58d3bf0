"""What histories take before the first runs: imported by the server of scripts alone.

SciPy's filters, with which a chain answers a motion, take half a second, and what numba sets up a
fifth: each script would take them again.
"""

import scipy.signal  # noqa: F401
from numba.core.registry import cpu_target

cpu_target.typing_context.refresh()
cpu_target.target_context.refresh()
