"""Predict or score from the command line.

python -m studies.overturning run FOLDER --data FOLDER [--model geometry]
python -m studies.overturning score FOLDER --data FOLDER_OR_TESTS.CSV
python -m studies.overturning solvers FOLDER --data FOLDER
python -m studies.overturning lessons FOLDER --data FOLDER
python -m studies.overturning blocks FOLDER --data FOLDER
"""

import argparse
import os
import sys
from pathlib import Path

import pandas as pd
from rocking.configuration.config import ConfigError

from studies.overturning import lessons, predict, rectangles, solvers
from studies.overturning.score import score


def _run(given, models):
    for model in models:
        predicted = predict.run(given.folder, given.data, model, max(1, given.cores))
        mean = predicted.groupby("specimen")["probability_of_fall"].mean().round(3)
        sys.stdout.write(f"{model}: mean probability of a fall {mean.to_dict()}\n")


def _score(given, models):
    _show(score(given.folder, given.data, models))


def _solvers(given, _):
    sys.stdout.write(solvers.run(given.folder, given.data).to_string() + "\n")


def _lessons(given, models):
    _show(lessons.by_measure(given.data))
    for model in models:
        _show(lessons.errors(given.folder, given.data, model))


def _blocks(given, _):
    predicted, scores = rectangles.run(given.folder, given.data)
    _show(predicted)
    if scores:
        _show(pd.DataFrame([scores]))


def _show(frame):
    sys.stdout.write(frame.round(3).to_string(index=False) + "\n\n")


WORDS = {
    "run": _run,
    "score": _score,
    "solvers": _solvers,
    "lessons": _lessons,
    "blocks": _blocks,
}


def main(words=None):
    """Run or score; return the exit code."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("what", choices=[*WORDS])
    parser.add_argument("folder", help="of the prediction")
    parser.add_argument(
        "--data", required=True, help="folder of the tests, or for a score tests.csv"
    )
    parser.add_argument("--model", choices=predict.MODELS, help="default: every one")
    cores = len(os.sched_getaffinity(0))
    parser.add_argument("--cores", type=int, default=cores, help="processes (default: every core)")
    given = parser.parse_args(words)
    models = [given.model] if given.model else predict.MODELS
    try:
        if not Path(given.folder).is_dir():
            raise ConfigError(f"{given.folder}: no folder of a prediction")
        WORDS[given.what](given, models)
    except (ConfigError, OSError, ValueError) as error:
        sys.stderr.write(f"overturning: {error}\n")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
