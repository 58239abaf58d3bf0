"""Collapse intensities of several runs: one table with what differs between them, one figure."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from rocking.collapse.probability import KEY, one_number
from rocking.configuration.words import said
from rocking.figures import style
from rocking.runtime.script import run
from rocking.tables import headed, write_table

from yade_scripts.model.registry import MODELS

SHOWN = 4  # differing keys below a run; the table has all


def joined(paths, differing):
    """Tables of all runs below each other; first columns: run and what differs."""
    parts = []
    for path, (name, values) in zip(paths, differing.items(), strict=True):
        facts = {"run": name} | {key: _plain(value) for key, value in values.items()}
        parts.append(headed(pd.read_csv(path), **facts))
    return pd.concat(parts, ignore_index=True)


def _plain(value):
    return " ".join(map(str, value)) if isinstance(value, list) else value


def label(name, values):
    """Name of a run and the first of what it has different."""
    pairs = [said(key.rpartition(".")[2], _plain(v)) for key, v in values.items() if v is not None]
    return "\n".join([name, *pairs[:SHOWN]])


def main(job):
    differing = job.params.differing
    table = joined(job.input.tables, differing)
    write_table(table, job.output.table, digits=None)
    names = list(differing)
    wide = table.assign(pga_g=one_number(table)).pivot(index=KEY, columns="run", values="pga_g")
    wide = wide.reindex(columns=names)
    models = list(dict.fromkeys(table["model"]))
    figure, axis = plt.subplots(figsize=(max(4.5, 1.3 + 1.25 * len(names)), 4.2))
    for model in models:
        how = MODELS[model]
        own = wide.loc[[model]]
        for _, row in own.iterrows():
            axis.plot(names, row, color=how.colour, marker=how.marker, ms=2.5, lw=0.5, alpha=0.5)
        whole = own.dropna()
        if len(whole):
            mean = np.exp(np.log(whole).mean())
            axis.plot(names, mean, color=how.colour, marker=how.marker, ms=6, lw=2.0, label=model)
        else:
            axis.plot([], [], color=how.colour, marker=how.marker, lw=0.5, label=model)
    axis.set(ylabel="equivalent collapse PGA [g]", ylim=(0.0, None))
    axis.set_xticks(range(len(names)), [label(n, differing[n]) for n in names], fontsize=6.5)
    axis.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
    Path(job.output.png).parent.mkdir(parents=True, exist_ok=True)
    style.save(figure, job.output, job.input.facts)


run(main, globals())
