"""Collapse intensities of several runs: one table with what differs between them, one figure."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from rocking.collapse.probability import KEY, one_number
from rocking.configuration.words import said
from rocking.figures import style
from rocking.figures.panels import common_legend
from rocking.runtime.script import run
from rocking.tables import headed, read_frame, together, write_table

from yade_scripts.model.registry import MODELS

SHOWN = 4  # differing keys below a run; the table has all
LINE_IN = 0.16  # height of a line of a run's label


def joined(paths, differing):
    """Tables of all runs below each other; first columns: run and what differs."""
    parts = []
    for path, (name, values) in zip(paths, differing.items(), strict=True):
        facts = {"run": name} | {key: _plain(value) for key, value in values.items()}
        parts.append(headed(read_frame(path), **facts))
    return together(parts)


def _plain(value):
    return " ".join(map(str, value)) if isinstance(value, list) else value


def label(name, values):
    """Name of a run and the first of what it has different."""
    pairs = [said(key.rpartition(".")[2], _plain(v)) for key, v in values.items() if v is not None]
    shown = [", ".join(pairs[k : k + 2]) for k in range(0, min(len(pairs), SHOWN), 2)]
    return "\n".join([name, *shown])


def main(job):
    differing = job.params.differing
    table = joined(job.input.tables, differing)
    write_table(table, job.output.table, digits=None)
    names = list(differing)
    wide = table.assign(pga_g=one_number(table)).pivot(index=KEY, columns="run", values="pga_g")
    wide = wide.reindex(columns=names)
    models = list(dict.fromkeys(table["model"]))
    words = [label(name, differing[name]) for name in names]
    lines = [1.2 + text.count("\n") for text in words]
    places = np.cumsum(lines) - np.array(lines) / 2.0
    figure, axis = plt.subplots(figsize=(6.8, 1.2 + LINE_IN * sum(lines)))
    for k, model in enumerate(models):
        how = MODELS[model]
        look = {"color": how.colour, "marker": how.marker, "ls": ""}
        curves = wide.loc[[model]]
        beside = places + (k + 0.5) / len(models) - 0.5
        for _, row in curves.iterrows():
            axis.plot(row, beside, ms=2.5, alpha=0.5, **look)
        whole = curves.dropna()  # a mean over other curves would be no comparison
        mean = np.exp(np.log(whole).mean()) if len(whole) else np.full(len(names), np.nan)
        axis.plot(mean, beside, ms=7, mfc="none", mew=1.2, label=model, **look)
    axis.set(xlabel="equivalent collapse PGA [g]: curves, and their mean", xlim=(0.0, None))
    axis.set_yticks(places, words, fontsize=7)
    axis.set_ylim(sum(lines), 0.0)  # the first run on top
    common_legend(figure, loc="outside upper center", ncols=6)
    Path(job.output.png).parent.mkdir(parents=True, exist_ok=True)
    style.save(figure, job.output, job.input.facts)


run(main, globals())
