"""Every record of a study read before anything runs, remembered by its content.

    for finding in check_runs(runs, cache="results/main/cache/records_check.json"):
        if finding.status == "fault":
            print(finding)

A repeated start with unchanged files and rows only hashes the files. The package does not
import this module, so that changing it makes no record again.
"""

import contextlib
import hashlib
import json
from collections import defaultdict
from dataclasses import asdict, dataclass, replace
from functools import cache as once
from pathlib import Path
from warnings import catch_warnings, simplefilter

import numpy as np
from record_files.errors import RecordError
from record_files.reader import open_file, pick
from record_files.record import G_M_S2, integrate, measures
from record_files.text import MAX_BYTES

from yade_scripts.files import write_json

from . import floor_table, read_specs, surrogates_for
from .baseline import treat
from .surrogate import DEFAULT_SEED, check_surrogate, generate

WARN_PGA_G = 3.0
WARN_OFFSET = 0.01  # mean over peak; a smaller one where its drift is farther than the motion
WARN_FACTOR = 20.0
# Where half of the façades on driven walls fall under the shipped suite, in units of the static
# uplift intensity thickness over height: 0.18 g of 0.058 g. Nobody knows it before a run.
FALLS = 3.0
WARN_STATED = 2.0  # peak of the table over that of the file, either way
CLIPPED = 4  # samples in a row at the largest value; none of 115 recorded motions has two
WARN_DURATION_S = 1.0  # a façade takes longer to fall
# Only a handful of recorded motions are faster or farther, and few pass 1 g as well as the
# second pair. Of the shipped suite's 44 horizontal motions, none does; of the same in m/s²
# called g, 42 do (or pass 3 g).
FAST_M_S, FAR_M = 2.0, 2.0
STRONG_G, STRONG_FAST_M_S, STRONG_FAR_M = 1.0, 1.2, 0.8
MAX_REMEMBERED = 5000
PEAKS = ("duration_s", "pga_g", "pgv_cm_s")  # facts that a file and a table's targets both give


@dataclass(frozen=True)
class Finding:
    """What is to say of one record: status "ok", "warning" or "fault", message one line.

    Of one that can be read also step [s], duration [s], peaks [g, cm/s] and mean over peak [%]
    with the displacement that it makes until the end [m], both of a file alone; and the factor
    that takes it to the intensity `reach_g` of `check_records`.
    """

    record: str
    file: str
    status: str = "ok"
    message: str = ""
    dt_s: float | None = None
    duration_s: float | None = None
    pga_g: float | None = None
    pgv_cm_s: float | None = None
    offset_percent: float | None = None
    drift_m: float | None = None
    factor: float | None = None

    def __str__(self):
        """Return the line for the user."""
        return f"record {self.record}: {self.message or self.status}"


def reach_g(resolved):
    """Intensity that a run of a resolved configuration is expected to take its records to [g].

    The highest of a stated grid; else where a façade may fall, `FALLS` times its thickness over its
    height, at most `ida.max_pga_g`.
    """
    ida, facade = resolved["ida"], resolved["facade"]
    if ida["mode"] == "grid":
        return max(ida["grid_g"])
    return min(FALLS * facade["thickness_m"] / facade["height_m"], ida["max_pga_g"])


def check_records(
    rows, *, baseline="none", seed=DEFAULT_SEED, specs=None, draw=False, cache=None, reach_g=None
):
    """Read every record of a study and say what is wrong with each.

    Parameters
    ----------
    rows : iterable of table.Row
        For instance those of `read_table(path).values()`.
    baseline : str or mapping
        Treatment as in `load`; a corner above a record's Nyquist frequency is a fault too.
    seed : int
        Seed of surrogates.
    specs : dict or None
        Parameters of surrogates by name, `read_specs(surrogates_for(table))`.
    draw : bool
        Draw surrogates too (some 0.1 s each at first) instead of checking their peaks alone.
    cache : path-like or None
        JSON file of earlier findings by content; made with its folder, and done without
        where it cannot be read or written.
    reach_g : float, optional
        Intensity that the study takes records to; one that is scaled far to it gets a warning.

    Returns
    -------
    list of Finding
        One a row, in order.
    """
    known = _remembered(cache)
    same: dict = {}
    findings = []
    digest, opened, before = once(_digest), once(open_file), len(known)
    for row in rows:
        spec = (specs or {}).get(row.record) if row.path is None else None
        # The path is part of the key because messages name it.
        files = [(path, digest(path)) for path in (*_paths(row), *_floor_files(row))]
        stated = asdict(row) | {"line": 0}
        key = _hash([_code(), stated, files, baseline, seed, repr(spec), draw])
        if key not in known:
            known[key] = _finding(row, baseline, seed if draw else None, spec, opened)
        finding = _scaled(Finding(row.record, row.path or "", *known[key]), reach_g)
        first = same.setdefault((row.path, row.component), row.record)
        if row.path and first != row.record:
            finding = _doubted(finding, f"the same motion as record {first}: it counts twice")
        findings.append(finding)
    if cache and len(known) > before:
        _remember(cache, known)
    return findings


def check_runs(runs, **options):
    """Findings on the records of all runs of a `rocking.runs.Runs`, each combination once.

    Of runs that take the same records to several intensities the highest counts. `options` are
    `draw` and `cache` of `check_records`. Raises RecordError for surrogate parameters that cannot
    be read.
    """
    alike = defaultdict(list)
    for run, resolved in runs.settings.items():
        treatment = [resolved[key] for key in ("baseline", "seed")]
        combination = [runs.table_path(run), runs.records[run], treatment]
        alike[json.dumps(combination, sort_keys=True)].append(run)
    distinct: dict[tuple, Finding] = {}
    for run, *others in alike.values():
        resolved, path = runs.settings[run], surrogates_for(runs.table_path(run))
        findings = check_records(
            [runs.tables[run][name] for name in runs.records[run]],
            baseline=resolved["baseline"],
            seed=resolved["seed"],
            specs=read_specs(path) if path else None,
            reach_g=max(reach_g(runs.settings[each]) for each in (run, *others)),
            **options,
        )
        for finding in findings:
            distinct.setdefault(
                (finding.record, finding.file, finding.status, finding.message), finding
            )
    return list(distinct.values())


def warnings(record):
    """Return what makes a readable record doubtful, one sentence each; see the limits above."""
    a = record.acceleration_m_s2
    pga_g, (offset, drift_m) = measures(record)["pga_g"], _offset(record)
    said = []
    if pga_g > WARN_PGA_G:
        said.append(f"peak of {pga_g:.2f} g, above {WARN_PGA_G:g} g: are the units right?")
    if record.duration_s < WARN_DURATION_S:
        said.append(
            f"{len(record)} samples, {record.duration_s:g} s in all, less than "
            f"{WARN_DURATION_S:g} s: is the step right, and the file whole?"
        )
    pgv, pgd = _settled_peaks(a, record.dt_s)
    if offset > WARN_OFFSET or drift_m > pgd:
        share = f"{100 * offset:.1f}" if offset > 1e-3 else f"{100 * offset:.1g}"
        said.append(
            f"mean offset {share} % of the peak, by which the displacement drifts "
            f"{drift_m:.2g} m in {record.duration_s:.0f} s (the motion itself: {pgd:.2g} m): "
            "remove it by baseline.method"
        )
    strong = pga_g > STRONG_G and (pgv > STRONG_FAST_M_S or pgd > STRONG_FAR_M)
    if record.source == "file" and (pgv > FAST_M_S or pgd > FAR_M or strong):
        other = ""
        if record.units_read == "g":
            other = (
                f" (m/s² called g? That would be {pga_g / G_M_S2:.2f} g, {pgv / G_M_S2:.2f} m/s, "
                f"{pgd / G_M_S2:.2f} m)"
            )
        said.append(
            f"peaks of {pga_g:.2f} g, {pgv:.2f} m/s and {pgd:.2f} m together are beyond nearly "
            f"all recorded motions: are the units right{other}, or does the baseline drift?"
        )
    return said


def _as_read(record, stated_g):
    """What is doubtful of the samples themselves: other than the table says, or cut off."""
    a, said = record.acceleration_m_s2, []
    pga_g = float(np.max(np.abs(a))) / G_M_S2
    if stated_g and not 1.0 / WARN_STATED <= pga_g / stated_g <= WARN_STATED:
        said.append(
            f"the table says a peak of {stated_g:g} g, the file has {pga_g:.3g} g: other units, or "
            "another component?"
        )
    longest = max(_in_a_row(a == a.max()), _in_a_row(a == a.min()))
    if CLIPPED <= longest < len(a):
        said.append(
            f"the largest value stands in {longest} samples in a row: was it cut off at the "
            "instrument's range?"
        )
    return said


def _in_a_row(mask):
    """Longest run of true values."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], mask, [False])).astype(int)))
    return int((edges[1::2] - edges[::2]).max(initial=0))


def _offset(record):
    """Mean acceleration over the peak, and where it takes the ground until the end [m]."""
    a = record.acceleration_m_s2
    mean = abs(float(np.mean(a)))
    return mean / float(np.max(np.abs(a))), 0.5 * mean * record.duration_s**2


def _scaled(finding, reach):
    """A finding with the factor to an intensity [g], and a warning where that is large."""
    if reach is None or not finding.pga_g:
        return finding
    factor = reach / finding.pga_g
    if factor <= WARN_FACTOR or finding.status == "fault":
        return replace(finding, factor=factor)
    said = (
        f"peak of {finding.pga_g:.2g} g, to be scaled some {factor:.0f} times to {reach:.2g} g, "
        f"more than {WARN_FACTOR:g}: such a weak motion hardly stands for one that fells a façade"
    )
    return _doubted(replace(finding, factor=factor), said)


def _doubted(finding, said):
    """A finding with one more doubt; a fault stays one."""
    if finding.status == "fault":
        return finding
    message = "; ".join(filter(None, [finding.message, said]))
    return replace(finding, status="warning", message=message)


def _settled_peaks(acceleration_m_s2, dt_s):
    """Peak velocity and displacement, straight lines removed from both [m/s, m]."""
    x = np.linspace(-1.0, 1.0, len(acceleration_m_s2))

    def level(values):
        return values - np.polyval(np.polyfit(x, values, 1), x)

    velocity = level(integrate(acceleration_m_s2, dt_s)[0])
    displacement = level(dt_s * np.cumsum(velocity))
    return float(np.max(np.abs(velocity))), float(np.max(np.abs(displacement)))


def _finding(row, baseline, seed, spec, opened):
    """Return what a `Finding` says after the file, without its factor.

    seed None: no surrogate is drawn; `opened` is `open_file`, which reads each file once.
    """
    try:
        if row.path:
            said, facts = _of_files(row, baseline, opened)
        else:
            said, facts = [], [None, *(row.targets[key] for key in PEAKS)]
            if seed is None:
                check_surrogate(row.record, **row.targets, spec=spec)
            else:
                generate(row.record, **row.targets, spec=spec, seed=seed)
    except RecordError as error:
        return "fault", str(error)
    return ("warning" if said else "ok", "; ".join(said), *facts)


def _of_files(row, baseline, opened):
    """What is doubtful of the motion in a row's file, and its facts; reads the vertical one too."""
    horizontal, *vertical = (opened(path, row.format) for path in _paths(row))
    record = pick(*horizontal, **row.stated())
    doubts = _as_read(record, row.targets.get("pga_g"))
    treated = treat(record, **({"method": baseline} if isinstance(baseline, str) else baseline))
    peaks, (offset, drift_m) = measures(treated), _offset(treated)
    facts = [treated.dt_s, *(peaks[key] for key in PEAKS)]
    facts += [round(100.0 * offset, 4), round(drift_m, 4)]
    said = [*doubts, *warnings(treated)]
    for file in vertical:
        pick(*file, **row.stated(vertical=True))
    if row.floors_path:
        with catch_warnings(record=True) as doubted:
            simplefilter("always")
            floor_table.floors_of(row, treated)
        said += [str(doubt.message) for doubt in doubted]
    return said, facts


def _paths(row):
    """Files of a row: the horizontal motion's, and the vertical one's where it is used."""
    return [path for path in (row.path, row.vertical_path) if path]


def _floor_files(row):
    """Files of a row's floor motions; of a table that cannot be read the table alone."""
    try:
        return floor_table.files_of(row)
    except RecordError:
        return [row.floors_path]


def _digest(path):
    """Digest of a file, of which no more is read than a record may have."""
    if not Path(path).is_file():
        return ""  # reading it says what is wrong
    try:
        with open(path, "rb") as handle:
            return hashlib.sha256(handle.read(MAX_BYTES + 1)).hexdigest()
    except OSError:
        return ""


@once
def _code():
    """Return the hash of this package, so that a change of the readers forgets findings."""
    files = sorted(Path(__file__).parent.rglob("*.py"))
    return hashlib.sha256(b"".join(path.read_bytes() for path in files)).hexdigest()


def _hash(value):
    return hashlib.sha256(json.dumps(value, sort_keys=True, default=str).encode()).hexdigest()


def _remembered(cache):
    try:
        there = cache and Path(cache).is_file()  # a pipe would be waited for
        entries = json.loads(Path(cache).read_text(encoding="utf-8")) if there else {}
        return {
            str(key): (str(status), str(said), *(v if v is None else float(v) for v in facts[:6]))
            for key, (status, said, *facts) in entries.items()
        }
    except (OSError, ValueError, TypeError, AttributeError, RecursionError):
        return {}


def _remember(cache, known):
    with contextlib.suppress(OSError):
        write_json(cache, dict(list(known.items())[-MAX_REMEMBERED:]), indent=0)
