"""Puts into a wheel what the packages read of the project's folder; all else is pyproject.toml."""

import runpy
import shutil
from pathlib import Path

from setuptools import setup
from setuptools.command.build_py import build_py

ROOT = Path(__file__).resolve().parent
SHIPPED = runpy.run_path(str(ROOT / "workflow" / "rocking" / "shipped.py"))


class WithShipped(build_py):
    """Also copies the files that `rocking.shipped` names; an editable one reads them in place."""

    def run(self):
        """Build, then copy."""
        super().run()
        if self.editable_mode:
            return
        inside = Path(self.build_lib) / "rocking" / SHIPPED["INSIDE"].name
        for pattern in SHIPPED["IN_WHEEL"]:
            for path in sorted(ROOT.glob(pattern)):
                target = inside / path.relative_to(ROOT)
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(path, target)


setup(cmdclass={"build_py": WithShipped})
