"""Texts of the report in both languages: the same keys and values, no English left in Italian."""

import ast
import math
import re
import string
from pathlib import Path

import pytest
from rocking.configuration import config
from studies.assess.catalogue import LANGUAGES, SAY, catalogue

ROOM = Path(__file__).parents[1]
ITALIAN = catalogue("it")
TOPICS = {key.split(".", 1)[0] for key in SAY.texts}
# words that stand in any English sentence and in no Italian one, and those of this field
ENGLISH_WORDS = set(
    """the of and with for which is are was were by at to from on where that its it this these not
    between above below than then into without within beyond most least every each none some more
    less only other others under over through as if wall floor floors tie ties rod rods joint hinge
    part corner mechanism mechanisms façade shaken demand capacity check checks held holds fails
    passes weakest motion motions station stations never median mean period ground building return
    walls those factor factors displacement coefficient mass onset velocity""".split()  # noqa: SIM905
)
NAMES = re.compile(
    r"[a-z_]+\.[a-z_.]+|[a-z]+_[a-z_]+|[A-Za-z_*]+\.(csv|yaml|md)|sha256sum|SHA256SUMS|commit|α|β"
)


def values_of(text):
    """Names of a text's values, and how each is written."""
    parsed = string.Formatter().parse(text)
    return {(name, spec) for _, name, spec, _ in parsed if name is not None}


@pytest.mark.parametrize("language", LANGUAGES)
def test_both_languages_have_the_same_keys_and_values(language):
    texts = catalogue(language).texts
    assert texts.keys() == SAY.texts.keys()
    for key, text in texts.items():
        assert isinstance(text, str), key
        assert text, key
        assert values_of(text) == values_of(SAY.texts[key]), key


def written(language):
    """Every text with values that stand for any: words are the language's own."""
    say = catalogue(language)
    for key, text in say.texts.items():
        values = {name: 0.25 if spec else "x" for name, spec in values_of(text)}
        yield key, say(key, **values)


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_text_can_be_written(language):
    for key, text in written(language):
        assert "{" not in text.replace("{Σ", ""), key
        assert text == re.sub(r"[ \n]{2,}", " ", text), key


def test_no_english_word_is_left_in_italian():
    found = []
    for key, text in written("it"):
        words = set(re.findall(r"[a-zà-úç]+", NAMES.sub(" ", text).lower()))
        found += [(key, word) for word in sorted(ENGLISH_WORDS & words)]
    assert found == []


def test_english_would_be_found_by_these_words():
    """Nine of ten English texts of three words or more have one of them."""
    own, caught = 0, 0
    for _, text in written("en"):
        words = set(re.findall(r"[a-zà-úç]+", NAMES.sub(" ", text).lower()))
        if len(words) >= 3:
            own += 1
            caught += bool(words & ENGLISH_WORDS)
    assert own > 250
    assert caught > 0.9 * own


def strings(node):
    """Patterns of the texts in a syntax tree; those of an f-string as one."""
    if isinstance(node, ast.JoinedStr):
        parts = [v.value if isinstance(v, ast.Constant) else None for v in node.values]
        yield "".join(".*" if v is None else re.escape(str(v)) for v in parts)
        inside = [v for v in node.values if isinstance(v, ast.FormattedValue)]
    else:
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield re.escape(node.value)
        inside = ast.iter_child_nodes(node)
    for one in inside:
        yield from strings(one)


def patterns():
    """Keys that the code asks for, as patterns: what is in braces may be anything."""
    found = set()
    for path in [*ROOM.glob("*.py"), *ROOM.glob("scripts/*.py")]:
        found |= set(strings(ast.parse(path.read_text("utf-8"))))
    for path in ROOM.glob("templates/*"):
        found |= {re.escape(key) for key in re.findall(r"say\([\"']([a-z_.]+)", path.read_text())}
    heads = tuple(f"{topic}\\." for topic in TOPICS)
    return {one for one in found if one.startswith(heads) and " " not in one}


def test_the_code_asks_for_every_text_and_for_none_that_is_not_there():
    endings, unasked = "(?:|[.]one|[.]many|_beyond)", set(SAY.texts)
    for one in patterns():
        known = set(filter(re.compile(one + endings).fullmatch, SAY.texts))
        assert known, one
        unasked -= known
    assert unasked == set()


def test_a_number_is_written_as_its_language_does():
    own = [(0.1234, "g3"), (0.9962, "percent"), (8.8e-5, "power"), (1234.5, ",.1f"), (0.04, "kn")]
    english, italian = ([say.number(*one) for one in own] for say in (SAY, ITALIAN))
    assert english == ["0.123", "99.6 %", "8.8·10⁻⁵", "1,234.5", "0.04 kN"]
    assert italian == ["0,123", "99,6 %", "8,8·10⁻⁵", "1.234,5", "0,04 kN"]
    assert [say.number(math.inf, "g3") for say in (SAY, ITALIAN)] == ["never", "mai"]
    assert SAY.number(math.nan, "g3") == "–"
    with pytest.raises(ValueError, match="without a format"):
        SAY("verdict.why_told.far", pga_g=0.2) and SAY.number(0.2, "")


def test_names_stand_in_a_sentence_and_numbers_of_things_are_told_by_key():
    assert [SAY.all_of("abc"[:n]) for n in (1, 2, 3)] == ["a", "a and b", "a, b and c"]
    assert ITALIAN.all_of("ab") == "a e b"
    assert SAY.all_of([]) == ""
    assert [SAY.count("figure.openings", n) for n in (0, 1, 2)] == [
        "0 openings",
        "1 opening",
        "2 openings",
    ]


def test_a_language_that_there_is_not_is_refused_in_one_line():
    with pytest.raises(ValueError, match=r"assessment\.language.*expected one of") as caught:
        catalogue("de")
    assert "\n" not in str(caught.value)
    with pytest.raises(ValueError, match="language") as caught:
        config.resolve({"assessment": {"language": "de"}})
    assert len(str(caught.value).splitlines()) == 1
    assert "it" in str(caught.value)
