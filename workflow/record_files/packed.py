"""The project's own compact form: many motions a text file, each with what is known of it.

    ROCKING MOTIONS 1
    source: …                      whole file: source, licence, changes in words, and
    motions: 66                    how many there are
    motion: {"label": "AQA NS", "station": …, "units": "m/s2", "dt_s": 0.005, …}
    <base85 lines>                 until the next motion

A motion is whole numbers n of its resolution q: a_i ≈ q n_i with
n_i = round(S_i/q) − round(S_{i−1}/q), S_i = a_0 + … + a_i, so that |a_i − q n_i| ≤ q and
the error of velocity never grows beyond q Δt. Third differences of n,
zigzagged to whole numbers from 0, as three planes of bytes (lowest first), LZMA2 and base85;
crc32 is that of n as little-endian 32-bit integers.
"""

import base64
import json
import lzma
import re
import zlib

import numpy as np

from .channel import Channel
from .text import MAX_SAMPLES
from .units import unit_name

FIRST = "ROCKING MOTIONS 1"
SHIPPED = "recorded, shipped"  # a recording that comes with the project
RESOLUTION = 1e-4  # of a motion's peak
MAX_MOTIONS = 1000
WIDTH = 120
_LZMA = [{"id": lzma.FILTER_LZMA2, "preset": 9, "lc": 0, "lp": 0, "pb": 0, "dict_size": 2**22}]
_KEY = re.compile(r"(source|licence|changes|motions): (.+)")
_ABOUT = ("label", "station", "event", "time_utc")


def sniff(text):
    """Tell whether the first line is this form's."""
    return text.lines[0].strip() == FIRST


def write(path, motions, **words):
    """Write a file of motions, pairs for `pack`; words: source, licence, changes."""
    lines = [FIRST, *(f"{key}: {text}" for key, text in words.items())]
    lines.append(f"motions: {len(motions)}")
    for motion in motions:
        lines += pack(*motion)
    with open(path, "w", encoding="utf-8", newline="\n") as stream:
        stream.writelines(line + "\n" for line in lines)


def pack(acceleration, about):
    """Return the lines of one motion.

    It is in about["units"]; `about` has label, station, event, time_utc, units and dt_s.
    """
    a = np.asarray(acceleration, dtype=float)
    q = float(f"{RESOLUTION * np.max(np.abs(a)):.6e}")
    n = np.diff(np.rint(np.cumsum(a) / q), prepend=0.0).astype(np.int64)
    third = np.diff(n.astype(float), n=3, prepend=np.zeros(3)).astype(np.int64)
    zigzag = (third << 1) ^ (third >> 63)
    planes = b"".join(((zigzag >> s) & 255).astype(np.uint8).tobytes() for s in (0, 8, 16))
    coded = base64.b85encode(lzma.compress(planes, lzma.FORMAT_RAW, filters=_LZMA)).decode()
    facts = about | {"samples": len(n), "resolution": q, "crc32": _crc(n)}
    lines = [coded[i : i + WIDTH] for i in range(0, len(coded), WIDTH)]
    return ["motion: " + json.dumps(facts, ensure_ascii=False), *lines]


def _crc(n):
    return zlib.crc32(n.astype("<i4").tobytes())


def read(text):
    """Read all motions."""
    if not sniff(text):
        raise text.error(1, f"expected {FIRST!r}")
    words: dict[str, str] = {}
    starts: list[int] = []
    for number, line in enumerate(text.lines, 1):
        match = _KEY.match(line)
        if line.startswith("motion: "):
            starts.append(number)
        elif not starts and match:
            words[match[1]] = match[2].strip()
        elif not starts and number > 1:
            raise text.error(number, f"expected 'motion: …', found {line[:40]!r}")
    for key in ("source", "licence", "motions"):
        if key not in words:
            raise text.error(1, f"no line '{key}: …' in the heading")
    if words.pop("motions") != str(len(starts)) or not 1 <= len(starts) <= MAX_MOTIONS:
        raise text.error(1, f"{len(starts)} motions, not as many as the heading declares")
    ends = [*starts[1:], len(text.lines) + 1]
    return [_motion(text, *span, words) for span in zip(starts, ends, strict=True)]


def _motion(text, first, end, words):
    try:
        facts = json.loads(text.lines[first - 1].partition(": ")[2])
        about = {key: str(facts[key])[:200] for key in _ABOUT}
        count, crc = int(facts["samples"]), int(facts["crc32"])
        q, dt_s, unit = float(facts["resolution"]), float(facts["dt_s"]), unit_name(facts["units"])
    except (ValueError, KeyError, TypeError, AttributeError, OverflowError, RecursionError):
        raise text.error(first, "not the description of a motion") from None
    if not 2 <= count <= MAX_SAMPLES or not 0 < q < 1e6 or not 0 < dt_s < 1e6 or unit is None:
        raise text.error(first, "impossible samples, resolution, dt_s or units")
    try:
        coded = base64.b85decode("".join(text.lines[first : end - 1]).encode())
        unpacker = lzma.LZMADecompressor(lzma.FORMAT_RAW, filters=_LZMA)
        planes = unpacker.decompress(coded, max_length=3 * count + 1)
        if not unpacker.eof or unpacker.unused_data:
            raise ValueError("too short or too long")
        low, middle, high = np.frombuffer(planes, np.uint8).reshape(3, count).astype(np.int64)
    except (ValueError, lzma.LZMAError, EOFError):
        raise text.error(first + 1, "damaged data: they do not unpack") from None
    zigzag = low | middle << 8 | high << 16
    n = (zigzag >> 1) ^ -(zigzag & 1)
    for _ in range(3):
        n = np.cumsum(n)
    if _crc(n) != crc:
        raise text.error(first + 1, "damaged data: the check sum differs")
    label = about.pop("label")
    facts = about | words
    return Channel(label, n * q, first + 1, units=unit, dt_s=dt_s, about=facts, provenance=SHIPPED)
