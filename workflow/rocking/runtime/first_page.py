"""What the report begins with: the answers of the runs, above the words that explain them."""

import sys
from pathlib import Path

PAGE = Path(".snakemake") / "first_page.rst"
# Snakemake puts the text into a narrow column beside the graph of the rules; here it is the page.
STYLE = """.. raw:: html

   <style>
   .overflow-auto:has(> div > div > .prose) { align-items: flex-start; }
   div:has(> div > .prose):has(#rulegraph) { flex-direction: column; }
   .prose.max-w-lg { max-width: min(72rem, 72vw); }
   .prose img { max-width: 100%; max-height: 78vh; margin: 0; }
   .prose table { font-size: 0.8rem; display: block; max-width: 100%; overflow-x: auto; }
   .prose td.number, .prose th.number { text-align: right; }
   </style>

"""


def of_runs(runs, words):
    """Return the path of the text that the report begins with.

    That of the runs that have a `results/<run>/report/summary.rst` comes first, then `words`, the
    path of the text for all; where no report is asked for or no run has an answer it is `words`.
    """
    pages = [Path("results") / run / "report" / "summary.rst" for run in runs]
    pages = [path for path in pages if path.is_file()]
    if not pages or not any(word.startswith("--report") for word in sys.argv):
        return words
    texts = [path.read_text("utf-8") for path in (*pages, Path(words))]
    PAGE.parent.mkdir(exist_ok=True)
    PAGE.write_text(STYLE + "\n".join(texts), encoding="utf-8")
    return str(PAGE.resolve())
