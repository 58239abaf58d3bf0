"""YADE as a library: found, loaded without its prompt, and checked for what scenes need."""

import contextlib
import glob
import io
import os
import sys
import types

from yade_scripts.engine import temporary
from yade_scripts.lists import listed

NEEDED_CLASSES = (
    "Box",
    "Sphere",
    "ViscElMat",
    "Ip2_ViscElMat_ViscElMat_ViscElPhys",
    "Ig2_Box_Sphere_ScGeom",
    "Law2_ScGeom_ViscElPhys_Basic",
    "InterpolatingDirectedForceEngine",
    "NewtonIntegrator",
    "InsertionSortCollider",
    "PyRunner",
)
PROMPT = "IPython"


class EngineError(RuntimeError):
    """YADE is absent, lacks a class, or a scene cannot be turned into it."""


@contextlib.contextmanager
def _without_prompt():
    """Spare YADE the import of IPython, two fifths of its own, asked for its version alone."""
    if PROMPT in sys.modules:
        yield
        return
    sys.modules[PROMPT] = nothing = types.ModuleType(PROMPT)
    vars(nothing)["__version__"] = "0.10"  # what YADE takes where it finds none
    try:
        yield
    finally:
        del sys.modules[PROMPT]


def load_yade():
    """Import YADE's library without its prompt and return its wrapper module.

    Looks below YADE_PREFIX (default /usr) for the double-precision build. EngineError of one line
    when YADE is not installed or lacks a needed class.
    """
    if first := "yade.wrapper" not in sys.modules:
        prefix = os.environ.get("YADE_PREFIX", "/usr")
        builds = sorted(glob.glob(f"{prefix}/lib/*/yade*/py/yade/__init__.py"))
        plain = [p for p in builds if "/yade-double/" in p or "/yade/py/" in p]
        if not plain:
            raise EngineError(
                f"YADE not found below {prefix}/lib: install Debian's package 'yade' "
                "or set YADE_PREFIX"
            )
        sys.path.insert(1, os.path.dirname(os.path.dirname(plain[0])))
        os.environ["OMP_NUM_THREADS"] = "1"
        # The library greets on standard output, which belongs to our own results.
        try:
            with contextlib.redirect_stdout(io.StringIO()), _without_prompt():
                import yade  # noqa: F401
        except ImportError as error:
            raise EngineError(f"YADE's library does not load in this Python: {error}") from error
    import yade.wrapper as wrapper

    if first:
        temporary.clear(os.path.dirname(wrapper.Omega().tmpFilename()))
    missing = [name for name in NEEDED_CLASSES if not hasattr(wrapper, name)]
    if missing:
        raise EngineError(f"this YADE lacks the class(es) {listed(missing)}")
    return wrapper
