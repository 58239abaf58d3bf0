"""Sphinx: the Markdown pages of the repository where they are, and the public functions.

The source folder is the repository, so a relative link means the same here and on a code host.
Nothing is loaded from a network: the site opens from a folder.
"""

import os
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT), str(ROOT / "workflow")]

project = "Rocking masonry façades on YADE"
author = "the contributors"
root_doc = "docs/index"
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]

include_patterns = ["*.md", "docs/**", "config/README.md", "config/*/README.md"]
include_patterns += ["workflow/studies/**/*.md"]
exclude_patterns = ["results", "build", ".*", "docs/examples", "docs/paper"]  # to copy, to send
myst_heading_anchors = 3
# reached from other pages, and by search
OFF_NAVIGATION = ("docs/changes/", "docs/keys/", "docs/record")
OFF_NAVIGATION += ("config/experiments/", "config/predictions/")
STUDIES = ROOT / "workflow" / "studies"
LINK = re.compile(r"!?\[([^\]]*)\]\(([^)\s#]+)[^)\s]*\)")

autodoc_mock_imports = ["yade", "minieigen"]  # built for the system's Python alone
autodoc_member_order = "bysource"
autodoc_preserve_defaults = True  # as the code names them: a path would be that of this machine
# a parameter's name may be an attribute of two classes; nothing is linked by such names
suppress_warnings = ["ref.python"]
napoleon_use_ivar = True

smartquotes = False  # an option is --scene, not an en dash
html_theme = "furo"  # navigation folds away on a phone, wide tables and code scroll
html_title = project
html_extra_path = ["redirect"]
html_copy_source = False
html_show_copyright = False


def setup(app):
    """Bars in docstrings are magnitudes, as in |θ0|, and no references; some pages no entries."""

    def bars(app, what, name, obj, options, lines):
        lines[:] = [line if "``" in line else line.replace("|", r"\|") for line in lines]

    def beside(app, doctree):
        if app.env.docname.startswith(OFF_NAVIGATION) or app.env.docname.endswith("/keys"):
            app.env.metadata[app.env.docname]["orphan"] = True

    def formula_page(app, error):
        """The atlas's page on which a reader moves a façade, with the shipped formula inside."""
        if error is None and app.builder.format == "html" and (STUDIES / "atlas").is_dir():
            from rocking.formula.law import read
            from studies.atlas.page import page

            (Path(app.outdir) / "formula.html").write_text(page(read()), encoding="utf-8")

    def without_studies(app, docname, source):
        """A study whose folder is deleted leaves the words of its links, and no picture."""
        here = (ROOT / docname).parent

        def kept(link):
            to = Path(os.path.normpath(here / link[2]))
            if STUDIES not in to.parents:
                return link[0]
            study = STUDIES / to.relative_to(STUDIES).parts[0]
            return link[0] if study.is_dir() else link[1]

        source[0] = LINK.sub(kept, source[0])

    app.connect("source-read", without_studies)
    app.connect("autodoc-process-docstring", bars)
    app.connect("doctree-read", beside)
    app.connect("build-finished", formula_page)
