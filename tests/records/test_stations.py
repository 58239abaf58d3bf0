"""Which curves of a station are run where those of one tell much the same."""

from rocking.stations import turns


def test_each_component_of_a_station_takes_one_direction_and_a_lone_one_all():
    stations = {"a1": "a", "b1": "b", "a2": "a", "c1": "c", "c2": "c", "c3": "c"}
    found = turns(stations, ["pos", "neg"])
    assert [pair for pair in found if pair[0][0] == "a"] == [("a1", "pos"), ("a2", "neg")]
    assert [pair for pair in found if pair[0][0] == "b"] == [("b1", "pos"), ("b1", "neg")]
    assert [d for name, d in found if name[0] == "c"] == ["pos", "neg", "pos"]


def test_with_one_direction_every_component_takes_it():
    assert turns({"a1": "a", "a2": "a"}, ["neg"]) == [("a1", "neg"), ("a2", "neg")]
