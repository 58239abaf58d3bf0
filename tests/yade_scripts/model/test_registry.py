"""The registry of models, and the worked example of CONTRIBUTING: adding one is a row in it."""

import dataclasses

import numpy as np
import pytest
from reference_solver.facade import wall_of
from rocking.configuration import config, schema
from rocking.solver import Motions, peaks, to_plane
from study_cases import study_settings
from yade_process import resolved

from yade_scripts.model import models, registry
from yade_scripts.model.scene import to_json


def test_names_colours_and_markers_are_distinct_and_every_bonded_model_has_a_dry_one():
    drawn = [m for m in registry.MODELS.values() if m.walls != "none"]
    for key in ("colour", "marker"):
        assert len({getattr(m, key) for m in drawn}) == len(drawn)
    for name, model in registry.MODELS.items():
        assert name == model.name
        assert not registry.MODELS[model.plain].bonded
        assert not registry.MODELS[model.one_way_model].two_way


def test_an_unknown_model_is_refused_with_the_known_ones():
    with pytest.raises(ValueError, match=r"unknown façade model 'W9': expected one of free, W1"):
        registry.model("W9")
    with pytest.raises(config.ConfigError, match="W9"):
        study_settings({"models": ["W9"]})


@pytest.mark.parametrize("change", [{"walls": "low"}, {"bonded": True}, {"two_way": True}])
def test_walls_that_the_reference_solver_has_not_are_refused_by_it(monkeypatch, change):
    """A new row is no silent W1 there."""
    row = dataclasses.replace(registry.MODELS["W1"], name="W9", **change)
    monkeypatch.setitem(registry.MODELS, "W9", row)
    with pytest.raises(ValueError, match="reference solver has no model W9"):
        wall_of({**resolved(), "model": "W9", "beta_s": 0.00276}, 5)


@pytest.mark.slow
def test_adding_a_model_is_adding_a_row(monkeypatch):
    """A copy of W1 under another name builds the same scene and rocks the same, in one row."""
    row = dataclasses.replace(registry.MODELS["W1"], name="W9")
    monkeypatch.setitem(registry.MODELS, "W9", row)
    monkeypatch.setattr(registry, "WITH_WALLS", (*registry.WITH_WALLS, "W9"))
    for cached in (schema.sections, schema.whole):
        cached.cache_clear()
    try:
        assert study_settings({"models": ["W9"]})["models"] == ["W9"]
    finally:
        monkeypatch.undo()
        for cached in (schema.sections, schema.whole):
            cached.cache_clear()
    monkeypatch.setitem(registry.MODELS, "W9", row)
    jobs = [{**resolved(), "model": name, "beta_s": 0.00276} for name in ("W1", "W9")]
    old, new = (models.build_scene(job) for job in jobs)
    assert to_json(old) == to_json(new)
    time_s = np.arange(0.0, 2.0, 0.01)
    motion = Motions(time_s, np.where(time_s < 0.8, 1.5 * np.sin(2.5 * np.pi * time_s), 0.0))
    found = [peaks(to_plane(s), motion, resolved()["numerics"], [1.0]).d_over_b for s in (old, new)]
    assert found[0] == found[1] > 0.05
