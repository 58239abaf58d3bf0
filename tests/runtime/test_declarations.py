"""Two rules that make one file are named before anything is planned."""

from types import SimpleNamespace

from rocking.runtime.declarations import made_twice


def rule(name, *outputs, study=None, file="/x/workflow/rules/ida.smk"):
    params = {"study": study} if study else {}
    return SimpleNamespace(name=name, output=list(outputs), params=params, snakefile=file)


TABLE = "results/{run,a|b}/tables/ida_collapse.csv"


def test_a_study_that_makes_a_table_of_the_core_is_named_with_it():
    core = rule("ida_collapse", TABLE)
    other = rule("friction_table", "results/{run,a|b}/tables/friction.csv", TABLE, study="friction")
    assert made_twice([core, other]) == (
        "rule friction_table (studies/friction) makes results/{run}/tables/ida_collapse.csv, which "
        "rule ida_collapse (rules/ida.smk) makes already; expected another name for it"
    )
    assert not made_twice([core, rule("friction_table", "results/{run}/tables/friction.csv")])


def test_wildcards_of_other_names_are_the_same_file_and_of_other_values_are_not():
    one = rule("one", "results/{run}/{model,W1|W2}.csv")
    assert made_twice([one, rule("two", "results/{name}/{kind,W1|W2}.csv")])
    assert not made_twice([one, rule("two", "results/{run}/{model,CB}.csv")])
