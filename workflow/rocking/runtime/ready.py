"""What numba sets up before its first loop runs: imported by the server of scripts alone.

It takes a fifth of a second, which each script would take again.
"""

from numba.core.registry import cpu_target

cpu_target.typing_context.refresh()
cpu_target.target_context.refresh()
