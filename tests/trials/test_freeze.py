"""The regression trial: a changed cell is found and named, a measured or renamed one is not."""

import pytest
import yaml

from tests.trials import freeze

TABLE = "premise,median,wall_s,walls_y_n\nbase,0.31,2.5,10\nmass,{},{},12\n"


def frozen(folder, name, text, trial="study"):
    """A state with one table, as `run` leaves it."""
    path = folder / "results" / trial / name
    path.parent.mkdir(parents=True)
    path.write_text(text)
    (folder / "results" / f"{trial}2").mkdir()  # of another trial
    (folder / "results" / f"{trial}2" / "other.csv").write_text("a\n1\n")
    freeze.keep(folder / "results", trial, folder)
    return folder


def test_wall_times_do_not_count_and_values_do(tmp_path):
    old = frozen(tmp_path / "old", "tables/premises.csv", TABLE.format("0.4", "1.0"))
    same = frozen(tmp_path / "same", "tables/premises.csv", TABLE.format("0.4", "9.0"))
    new = frozen(tmp_path / "new", "tables/premises.csv", TABLE.format("0.41", "1.0"))
    assert freeze.compare(old, same) == []
    (line,) = freeze.compare(old, new)
    assert line.startswith("study/study/tables/premises.csv: 1 of 3 lines differ, first line 3")
    assert "- mass,0.4,12" in line
    assert "+ mass,0.41,12" in line


def test_files_that_come_and_go_are_named(tmp_path):
    old = frozen(tmp_path / "old", "tables/premises.csv", TABLE)
    new = frozen(tmp_path / "new", "tables/assumptions.csv", TABLE.replace("premise", "assumption"))
    assert freeze.compare(old, new) == [
        "study/study/tables/assumptions.csv: new",
        "study/study/tables/premises.csv: no longer made",
    ]
    words = tmp_path / "words.tsv"
    words.write_text("premises\tassumptions\npremise\tassumption\n")
    assert freeze.compare(old, new, words) == []


@pytest.mark.parametrize(
    "name",
    [
        *("wall_s", "run_cpu_s", "run_s", "build_s", "factorise_s", "modes_s", "max_rss_mb"),
        *("memory_at_start_mb", "cpu_s_per_simulated_s", "cpu_growth", "memory_growth", "cost"),
    ],
)
def test_what_is_measured_on_the_machine_is_left_out(tmp_path, name):
    path = tmp_path / "a.json"
    path.write_text(f'{{"{name}": 1.5, "walls": [{{"{name}": 2, "period_s": 0.27}}]}}')
    assert yaml.safe_load(freeze.comparable(path)) == {"walls": [{"period_s": 0.27}]}


def test_the_last_digits_of_a_json_file_are_the_processor_s(tmp_path):
    """A floor's load fitted with OpenBLAS's sums for two processors, and another load."""
    path, texts = tmp_path / "fit.json", []
    for load in (164.1062625684476, 164.1062625684377, 164.1062630):
        path.write_text(f'{{"floor_load_kg_m2": [{load!r}]}}')
        texts.append(freeze.comparable(path))
    assert texts[0] == texts[1] != texts[2]


def test_a_trial_s_own_values_lie_over_the_common_ones():
    found = freeze.merged({"a": {"b": 1, "c": 2}, "d": [1]}, {"a": {"b": None}, "d": [2]})
    assert found == {"a": {"b": None, "c": 2}, "d": [2]}


def test_every_target_is_frozen_a_new_one_without_a_line(tmp_path):
    trials = freeze.planned(freeze.ROOT)["trials"]
    named = [name for trial in trials.values() for name in trial["targets"]]
    assert set(freeze.targets()) <= set(named)
    rules = tmp_path / "workflow" / "rules"
    rules.mkdir(parents=True)
    (tmp_path / "workflow" / "Snakefile").write_text('rule all:\n    input:\n        "a.csv",\n')
    (rules / "own.smk").write_text(
        'rule friction:\n    input:\n        "b.csv",\n\n\nrule cohesion:\n    input:\n'
        "        rules.friction.input,\n"
    )
    added = freeze.planned(tmp_path)["trials"]
    assert added["friction"] == {"targets": ["friction"]}
    assert set(added) - set(trials) == {"friction"}
    (rules / "own.smk").write_text('rule grid:\n    input:\n        "b.csv",\n')
    with pytest.raises(SystemExit, match="trial grid does not name its target"):
        freeze.planned(tmp_path)
