"""What free headings say of units, step and number of samples, in the common languages.

AT2 and plain columns share it. Every statement is weighed by what it is: a number with its word or
its unit, a unit after the word for unit, in brackets, or as the last field of a line. What a
heading does not say clearly gives None, and the reader asks for it; what it says twice and
differently, or of something else than acceleration, is a reason to refuse.
"""

import re
from dataclasses import dataclass

from .text import MAX_DT_S, MIN_DT_S
from .units import UNITS_M_S2, WITHIN, no_acceleration, plain, unit_name

NUMBER = r"[-+]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][-+]?\d+)?"
LONG = 200  # characters of a heading line that are looked at
_NUMBER = re.compile(NUMBER, re.ASCII)
COARSEST = 0.05  # of a step: more than that is no rounding (0.01 is not 0.005)
# Roots of "sample" in English, Spanish, Italian, French, German, Portuguese and Turkish.
_SAMPLE = r"(?:sampl|muestr|campion|echantillon|abtast|amostr|ornekle)"
_BARE = r"(?<![\w.,/-])(\d*[.,]?\d+(?:e[-+]?\d+)?)"
_STEP_WORD = re.compile(
    r"\bd[ _]?t\b|\bdelta[ _-]?t\b|δ ?t\b|\btime[ _-]?(?:step|increment|interval)|\btstep\b"
    rf"|{_SAMPLE}\w*[ _-]*(?:interval|period|step|time\b|schritt|zeit)|abtastintervall"
    rf"|(?:interval|period|increment|passo|paso|\bpas\b|schritt)\w*[ ._-]*(?:\w{{1,3}}[ ._-]+)?"
    rf"(?:{_SAMPLE}|temp|tiempo|zeit)|zeit-?schritt|equal(?:ly)?[- ]spac(?:ing|ed)(?: of| at)?"
    r"|ornekleme araligi"
)
_RATE_WORD = re.compile(
    rf"{_SAMPLE}\w*[ _.-]*(?:rate\b|freq|frek|hizi)|abtastrate|abtastfrequenz"
    rf"|(?:\brate\b|freq\w*|frek\w*|\bvel\w*|taux|tasso|tasa|taxa|cadence)"
    rf"[ ._-]*(?:\w{{1,3}}[ ._'-]+)?{_SAMPLE}"
)
_PER_SECOND = re.compile(
    _BARE + rf"\s*(?:sps\b|(?:{_SAMPLE}\w*|pts|points?|punt[io]s?|punkte?|proben|values?|spl)\s*"
    r"(?:/|\bper\b|\bpor\b|\bal\b|\bpar\b|\bpro\b|\ba\b)\s*"
    r"(?:s\b|sec|segundo|secondo|sekunde))"
)
_HERTZ = re.compile(_BARE + r"\s*hz\b")
_SECONDS = re.compile(
    _BARE + r"\s*(ms|msec|milliseconds?|s|sec|secs|seconds?|segundos?|sekunden?)\b"
)
# Lines in which hertz and seconds are of something else.
_OTHERWISE = re.compile(
    r"filt|band|pass\b|corner|cut|roll|tagl|passa|grenz|inst|natur|propri|eigen|nyq|range|transd"
    r"|damp|smorz|amort|trigger|delay|rise|memor|peak|pga|max|spectr|\bt1\b|fundamental|sensor"
)
_THINGS = (
    r"(?:data|datos|dati|daten|donnees|dados|veri\w*|points?|pts|punt[io]s?|punkte?|pontos?|nokta"
    r"|samples?|muestras?|campioni|echantillons?|amostras?|proben|values?|valores?|valori|valeurs?"
    r"|werte?|messwerte|abtastwerte|messpunkte|ordinates?|readings?|npts|npoints|ndata|nsamples)"
)
_NUMBER_OF = (
    r"(?:\bn|\bno|\bnr|\bnum|\bnum\w*ro|\bnumber|\bnombre|\bcantidad|\banzahl|\btotal|n°|\bcount)"
)
_COUNT_BEFORE = re.compile(
    rf"(?:\bnpts\b|\bn\b(?=\s*=)|(?:nokta|veri)\s+sayisi|\bnpoints\b|\bndata\b|\bnsamples\b|{_NUMBER_OF}[\s._]*"
    rf"(?:(?:of|de|di|der|des|total|totale|total de|d')[\s._]*)*{_THINGS}(?:\s+\w+)?"
    rf"|^\s*{_THINGS}(?=\s*[:=]))"
    r"[^\d\n]{0,4}?(?:,?\s*c\d+-c\d+|\([^)]*\))?[\s:=/.]{0,40}?(?<![\w.])(\d{1,9})\b(?![.\d]*\d)"
)
_COUNT_AFTER = re.compile(
    rf"(?<![\w.,/-])(\d{{1,9}})\s+(?:[\d.]+\s+)?(?:\w+\s+)?{_THINGS}\b"
    r"(?!\s*(?:/|per\b|por\b|par\b|pro\b|al\b|a\b|each|in each|s\b))"
)
_CHANNELS = re.compile(
    r"(?<![\w.,/-])(\d{1,2}|two|three|four|dos|tres|due|tre|deux|trois|zwei|drei)\s+"
    r"(?:channels?|components?|compon\w+|canal\w*|canaux|komponenten|kanale|spuren|traces?|columns?"
    r"|colon\w+|spalten)\b"
)
_WORDS = {"two": 2, "dos": 2, "due": 2, "deux": 2, "zwei": 2, "four": 4}
_UNIT_WORD = re.compile(
    r"(?:\b|\w)(?:units?|unidad(?:es)?|unita|einheit(?:en)?|unites?|unidades?|birim\w*)\b"
)
_ACCELERATION = r"(?:acc\w*|acel\w*|beschleunigung\w*|ivme\w*)"
_ACCELERATION_IN = re.compile(
    rf"\b{_ACCELERATION}\W*(?:(?:data|values?|time|history|series|records?|werte)\W+){{0,3}}"
    rf"(?:\b(?:in|en|is|are)\b\s*|[(\[,:=]\s*)+(?:the\s+)?(?:units?\s+(?:of\s+)?)?({WITHIN})(?![\w/^*])"
)
_AFTER_WORD = re.compile(rf"(?<![\w.%/])({WITHIN})(?![\w/^*])")
_STATED_WORD = re.compile(
    r"^\W*(?:(?:of|are|is|in|de|del|los|las|the|uncor|accel\w*|data|datos|dati)\W+)*([^\s,;()\[\]]+)"
)
_FIELD = re.compile(rf"[(\[]\s*({WITHIN})\s*[)\]]|[,;|]\s*({WITHIN})\s*$|^\W*({WITHIN})\s*$")
_SURE = re.compile(
    r"(?<![\w.%/\d])(?<!\d )((?:mm|cm|m)\s*/\s*s\w*(?:\s*[/^*]+\s*s\w*|[\^*]*2)|gals?)(?![\w/^*])"
)
_QUANTITY = re.compile(
    r"^\W*(velocity|displacement|velocidad|desplazamiento|velocita|spostamento|vitesse|deplacement"
    r"|geschwindigkeit|verschiebung)\b(?!.*\bacc)"
)
_MOVEMENT = re.compile(
    r"(?:\b|_)(?:(vel(?:oc\w*)?|vitesse|geschw\w*|hiz)|(dis(?:p|pl\w*)?|desp\w*|spost\w*|depl\w*|versch\w*))"
    r"(?:\b|_)"
)
_BRACKETED = re.compile(r"[(\[]([^()\[\]]+)[)\]]")
_SUFFIX = re.compile(
    r"(?:(?<!\d)(?<!%)(?<!of)(?<!cent)[\s,]|_)(%?\s?m?g|(?:m|cm|mm)_s2|(?:m|cm|mm)_s|\S*[/²]\S*|gal|counts?)$",
    re.I,
)
_ONLY_ACCELERATION = re.compile(r"(?:a|acc[a-z]*)?", re.I)


@dataclass(frozen=True)
class Said:
    """What a heading states: a unit, or what speaks against the values as accelerations."""

    unit: str | None = None
    against: str = ""


def is_numbers(line):
    """Tell whether a line holds numbers alone, apart by blanks, commas or semicolons."""
    words = re.split(r"[\s,;]+", line.strip(" \t,;"))
    return all(_NUMBER.fullmatch(word.strip("\"'")) for word in words)


def of_unit(words, where=""):
    """`Said` by the words of a unit; nothing where they are no unit."""
    other = no_acceleration(words)
    if other:
        return Said(None, f"{where}{' '.join(words.split())!r}, a unit of {other}")
    return Said(unit_name(words))


def stated_unit(lines):
    """`Said` of the lines: after a word for unit, after "acceleration", in brackets, by itself."""
    lines = [plain(line[:LONG]) for line in lines]
    for of_line in (_after_word, _of_acceleration, _quantity, _in_a_field):
        statements = [said for line in lines for said in of_line(line) if said.unit or said.against]
        units = dict.fromkeys(said.unit for said in statements if said.unit)
        if len(units) > 1:
            return Said(None, f"the heading states {' and '.join(units)}")
        if units:
            return Said(next(iter(units)))
        if statements:
            return statements[0]
    return Said()


def _after_word(line):
    for word in _UNIT_WORD.finditer(line):
        rest = line[word.end() :]
        match = _AFTER_WORD.search(rest[:60])
        if match:
            yield _scaled(rest[: match.start()], match[1], rest[match.end() :])
            continue
        explicit = re.match(r"\W*(?:(?:of|are|is|in)\b|[:=])", rest)
        named = _STATED_WORD.match(rest) if explicit else None
        if named and re.search(r"[a-z%]", named[1]):
            known = ", ".join(UNITS_M_S2)
            yield Said(None, f"the heading states the unit {named[1][:20]!r}, none of {known}")


def _scaled(before, words, after):
    """`Said` by a unit within words; a unit times a factor is not known."""
    factor = re.search(r"\d\s*[x*]?\s*$", before) or re.match(r"[)\]\s]*[x*×]\s*\d", after)
    if factor:
        return Said(None, f"the heading states {words!r} with a factor")
    return of_unit(words, "the heading states ")


def _of_acceleration(line):
    for match in _ACCELERATION_IN.finditer(line):
        yield _scaled("", match[1], line[match.end() :])


def _quantity(line):
    match = _QUANTITY.match(line)
    return [Said(None, f"the heading says {match[1]!r}")] if match else []


def _in_a_field(line):
    for match in _FIELD.finditer(line):
        words = next(filter(None, match.groups()))
        at_end = not re.search(r"\d", line[match.end() :])
        if unit_name(words) or at_end:
            yield _scaled("", words, line[match.end() :])
    for match in _SURE.finditer(line):
        if unit_name(match[1]):
            yield Said(unit_name(match[1]))


def heading_unit(heading):
    """`Said` by a column's caption ("Acc. (g's)", "a_m_s2", "acc g", "cm/s2", "vel [m/s]")."""
    named = f"the caption {heading!r} says "
    bracketed = _BRACKETED.search(heading)
    suffix = _SUFFIX.search(heading)
    said = Said()
    for words in (heading, bracketed and bracketed[1], suffix and suffix[1]):
        if words and not (said.unit or said.against):
            said = of_unit(words, named) if len(words) > 1 or words in "gG" or bracketed else Said()
    moves = _MOVEMENT.search(plain(heading))
    if moves and not said.unit:
        what = "velocity" if moves[1] else "displacement"
        return Said(None, said.against or f"{named}{what}")
    return said


def heading_component(heading):
    """Return what a column's heading says but "acceleration" and a unit ("N-S"), or ""."""
    words = _SUFFIX.sub("", _BRACKETED.sub("", heading)).strip(" _.,:;")
    return "" if unit_name(words) or _ONLY_ACCELERATION.fullmatch(words) else words


def stated_counts(lines):
    """Return the numbers of samples that the lines declare, in order, each once."""
    counts: dict[int, None] = {}
    for line in lines:
        words = plain(line[:LONG])
        for form in (_COUNT_BEFORE, _COUNT_AFTER):
            for match in form.finditer(words):
                if int(match[1]) > 1:
                    counts[int(match[1])] = None
    return list(counts)


def whole_numbers(lines):
    """Return the whole numbers that stand by themselves in the lines: support, no statement."""
    return {
        int(n) for line in lines for n in re.findall(r"(?<![\w.])(\d{2,7})(?![\w.])", line[:LONG])
    }


def stated_channels(lines):
    """Return the number of channels that the lines declare ("three components"), or 0."""
    for line in lines:
        match = _CHANNELS.search(plain(line[:LONG]))
        if match:
            return int(match[1]) if match[1].isdigit() else _WORDS.get(match[1], 3)
    return 0


def stated_steps(lines, sure=False):
    """Return the steps that the lines state: (step in s, half a unit of its last digit) each.

    Those with a word for step or rate; else numbers before hertz or seconds, where nothing says
    that they are of something else, unless only `sure` ones are asked for.
    """
    words = [plain(line[:LONG]) for line in lines]
    strong = [step for line in words for step in _strong(line)]
    if sure:
        return _once(strong)
    return _once(strong or [step for line in words for step in _weak(line)])


def stated_step(lines):
    """Return the one step that lines state, and half a unit of its last printed digit."""
    steps = stated_steps(lines)
    return steps[0] if len(steps) == 1 else (None, 0.0)


def _strong(line):
    for form, make in ((_STEP_WORD, _as_step), (_RATE_WORD, _as_rate)):
        for word in form.finditer(line):
            value = _value(line[word.end() :], make)
            if value:
                yield value
                break
    for match in _PER_SECOND.finditer(line):
        value = _as_rate(match[1], "")
        if value:
            yield value


def _value(rest, make):
    """First number after a word that can be what it says."""
    rest = rest[:80]
    for match in re.finditer(_BARE.replace(",/-]", ",-]"), rest):
        unit = rest[: match.start()] + " " + rest[match.end() :][:14]
        value = make(match[1], unit)
        if value:
            return value
    return None


def _as_step(number, unit):
    number = number.replace(",", ".")
    value, rounding = float(number), 0.0
    if re.search(r"\bms(?:ec)?\b|millis", unit):
        value /= 1000.0
    elif "e" not in number:
        rounding = min(0.5 * 10.0 ** -len(number.partition(".")[2]), COARSEST * value)
    return (value, rounding) if MIN_DT_S <= value <= MAX_DT_S else None


def _as_rate(number, _):
    value = 1.0 / max(float(number.replace(",", ".")), 1e-9)
    return (value, 0.0) if MIN_DT_S <= value <= MAX_DT_S else None


def _weak(line):
    if _OTHERWISE.search(line):
        return
    for match in _HERTZ.finditer(line):
        yield from filter(None, [_as_rate(match[1], "")])
    for match in _SECONDS.finditer(line):
        yield from filter(None, [_as_step(match[1], match[2])])


def _once(steps):
    """Steps without those that an earlier one agrees with, within rounding."""
    kept: list[tuple[float, float]] = []
    for value, rounding in steps:
        if all(abs(value - v) > max(1e-3 * v, rounding, r) for v, r in kept):
            kept.append((value, rounding))
    return kept
