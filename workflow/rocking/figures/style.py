"""What all figures share: the style file, colours of the models, and saving in two formats."""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

GREY = "0.65"

plt.style.use(Path(__file__).with_name("paper.mplstyle"))


def save(figure, output):
    """Save a figure to the job's outputs (png, pdf) without dates, then close it."""
    plain = {"png": {"Software": None}, "pdf": {"CreationDate": None, "Producer": None}}
    for path in [str(p) for p in output]:
        figure.savefig(path, metadata=plain[path.rpartition(".")[2]])
    plt.close(figure)


def provenance(facts):
    """Say where a record comes from, for titles: one of `records.record.SOURCES`."""
    return f"{facts['name']} ({facts['source']})"
