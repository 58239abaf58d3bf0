"""What every result was made of, kept beside the results and compared whatever times say.

Snakemake makes a result again when an input is newer, and when settings or code differ from its
own notes in `.snakemake`. It does not see what was replaced by an older file, what was changed in
place, and, without its notes, other settings. Here `results/<run>/made_of.jsonl` has a line a file:
the digest of its content, and that of what it was made of (the rule, its settings and command, and
the content of every input, code included). A file that differs from either is made again.
"""

import errno
import hashlib
import json
import os
import stat
import sys
from dataclasses import dataclass, field
from pathlib import Path

from rocking.runtime import stamps
from rocking.runtime.fallback import expect_parameters
from yade_scripts.files import write_atomic

NAME = "made_of.jsonl"
SHARED = ".shared"
MOST_SAID = 5
MOST_STALE = 2  # lines of a file for each that counts, before the others are left out


def _sum(entry):
    """Digest of a line without its own."""
    return hashlib.sha256(json.dumps(entry, sort_keys=True).encode()).hexdigest()[:16]


NO_FILE = "expected a file of notes, not a link or another kind: remove it"


class Changed(ValueError):
    """An input is not what a job of this workflow made; the text is one line."""


@dataclass
class Notes:
    """The lines of one `made_of.jsonl`: (digest, digest of what it was made of) by file."""

    path: Path
    known: dict = field(default_factory=dict)
    lines: int = 0

    @classmethod
    def read(cls, path):
        """Read what is whole; a line that was cut or changed counts as not there.

        So does what is no file of its own: a pipe would be waited for.
        """
        notes = cls(Path(path))
        if not _own_file(path):
            return notes
        try:
            data = notes.path.read_bytes()
        except OSError:
            return notes
        for line in data.splitlines():
            notes.lines += 1
            try:
                *entry, check = json.loads(line)
                name, content, of = map(str, entry)
            except (ValueError, TypeError, RecursionError):
                continue
            if check == _sum([name, content, of]):
                notes.known[name] = content, of
        return notes

    def add(self, notes):
        """Note files, (digest, digest of what it was made of) by name.

        OSError without room, or where something else stands in the place: what a link leads to
        would be written into.
        """
        if os.path.lexists(self.path) and not _own_file(self.path):
            raise OSError(errno.EINVAL, NO_FILE)
        self.known.update(notes)
        self.lines += len(notes)
        if self.lines > 50 + MOST_STALE * len(self.known):
            write_atomic(self.path, _text(self.known))
            self.lines = len(self.known)
            return
        self.path.parent.mkdir(parents=True, exist_ok=True)
        with open(self.path, "ab+") as handle:
            if handle.tell():  # what a full disk or a kill cut off is a line of its own
                handle.seek(-1, os.SEEK_END)
                if handle.read(1) != b"\n":
                    handle.write(b"\n")
            handle.write(_text(notes).encode())


def _own_file(path):
    """Whether a path is a file, and no link to one."""
    return os.path.isfile(path) and not os.path.islink(path)


def _text(notes):
    """Lines of files."""
    entries = ([name, *digests] for name, digests in notes.items())
    return "".join(json.dumps([*entry, _sum(entry)]) + "\n" for entry in entries)


class MadeOf:
    """Notes of all runs below a folder of results.

    `results` is that folder, `base` the workflow's, which a digest does not name. `params` returns
    what a job's parameters are as text, `copies` whether it copies inputs under their own names,
    and `say` prints a warning.
    """

    def __init__(self, results, base, params, copies=lambda job: False, say=print):
        """Read nothing yet."""
        self.results, self.base, self.params = Path(results).parts, str(base), params
        self.copies, self.say = copies, say
        self.notes: dict[Path, Notes] = {}
        self.digests: dict = {}
        self.said: set = set()
        self.began: dict = {}

    def place(self, path):
        """Notes of the folder that a result belongs to, and its name there; None of other files.

        The folder is a run's, or `.shared/<motions>`.
        """
        parts = Path(path).parts
        depth = len(self.results)
        if parts[:depth] != self.results:
            return None
        depth += 2 if parts[depth : depth + 1] == (SHARED,) else 1
        if len(parts) <= depth:
            return None
        folder = Path(*parts[:depth])
        if folder not in self.notes:
            self.notes[folder] = Notes.read(folder / NAME)
        return self.notes[folder], "/".join(parts[depth:])

    def noted(self, path):
        """(digest, digest of what it was made of) of a result; None where nothing is noted."""
        there = self.place(path)
        return there and there[0].known.get(there[1])

    def digest(self, path):
        """Digest of the content of a file or folder; "" where it is not there.

        Within a process a file is read once for a size and a time of change that only the system
        sets. Of a stamp of code its digest counts, not where the code lies.
        """
        try:
            at = os.stat(path)
        except OSError:
            return ""
        if stat.S_ISDIR(at.st_mode):
            below = sorted(p for p in Path(path).rglob("*") if p.is_file() and p.name[0] != ".")
            named = [(p.relative_to(path).as_posix(), self.digest(p)) for p in below]
            return hashlib.sha256(json.dumps(named).encode()).hexdigest()
        if not stat.S_ISREG(at.st_mode):
            return "neither a file nor a folder"
        key = (at.st_dev, at.st_ino, at.st_size, at.st_mtime_ns, at.st_ctime_ns)
        if key not in self.digests:
            self.digests[key] = self._read(path)
        return self.digests[key]

    def _read(self, path):
        try:
            if Path(path).name == stamps.NAME:
                return stamps.content(path)
            with open(path, "rb") as handle:
                return hashlib.file_digest(handle, "sha256").hexdigest()
        except OSError:
            return ""

    def _input(self, path):
        """Digest of an input; of a result that is not there, of what was there."""
        digest = self.digest(path)
        return digest or (self.noted(path) or ("",))[0]

    def of(self, job):
        """Digest of what a job makes its files of."""
        code = job.rule.shellcmd or ""
        counted = [str(path) for path in job.input if not path.is_ancient]
        inputs = sorted((path, self._input(path)) for path in counted)
        text = json.dumps([job.rule.name, code, list(self.params(job)), inputs])
        return hashlib.sha256(text.replace(self.base, "").encode()).hexdigest()

    def unfit(self, job):
        """Files of a job that are there and are not what it would make, as far as notes tell."""
        there = {path: now for path in map(str, job.output) if (now := self.digest(path))}
        if self.copies(job):
            inputs = {os.path.basename(path): self.digest(path) for path in map(str, job.input)}
            return [p for p, now in there.items() if inputs.get(os.path.basename(p)) != now]
        unfit, of = [], None
        for path, now in there.items():
            if self.place(path) is None:
                continue
            if (note := self.noted(path)) is None:
                unfit.append(path)
                continue
            of = of or self.of(job)
            if note[0] != now:
                self._say(f"{path} was changed after it was made: it is made again")
            if note != (now, of):
                unfit.append(path)
        return unfit

    def _say(self, line):
        if line not in self.said and len(self.said) < MOST_SAID:
            self.say(f"warning: {line}")
        self.said.add(line)

    def begin(self, job):
        """Keep what a job is about to read, for `note`; a change meanwhile is one of its inputs.

        `Changed` for inputs that jobs made and that are other than they left them.
        """
        for path in map(str, job.input):
            note = self.noted(path)
            if note and (now := self.digest(path)) and now != note[0]:
                raise Changed(
                    f"{path} was changed while this run went on: repeat the command, which makes it"
                    " again"
                )

        self.began[tuple(map(str, job.output))] = self.of(job)

    def note(self, job):
        """Note the files that a job has made, of what it was about to read where that is known."""
        of = self.began.pop(tuple(map(str, job.output)), None)
        by_folder: dict[Path, dict] = {}
        for path in map(str, job.output):
            there, digest = self.place(path), self.digest(path)
            if there is None or not digest:
                continue
            of = of or self.of(job)
            by_folder.setdefault(there[0].path.parent, {})[there[1]] = digest, of
        for folder, notes in by_folder.items():
            try:
                self.notes[folder].add(notes)
            except OSError as error:
                self._say(f"{folder / NAME}: {error.strerror}; what is finished now is made again")


def heed(workflow, results, base, own, copies):
    """Let Snakemake compare and note what `own` jobs make, beside what it does by itself.

    `own` tells of a job whether it is of this workflow; others as of `MadeOf`. ImportError,
    AttributeError or TypeError in a release of Snakemake that plans in another way; nothing is
    changed then.
    """
    from snakemake.jobs import Job
    from snakemake.persistence import PersistenceBase as Kept

    before = {name: getattr(Kept, name) for name in ("has_metadata", "input_changed")}
    checksums, prepare, postprocess = Kept.input_checksums, Job.prepare, Job.postprocess
    expect_parameters(before["has_metadata"], "self", "job")
    expect_parameters(before["input_changed"], "self", "job", "file")
    expect_parameters(checksums, "self", "job", "input_path")
    expect_parameters(prepare, "self")
    expect_parameters(Kept._params, "self", "job")
    made = MadeOf(
        results,
        base,
        lambda job: workflow.persistence._params(job),
        copies,
        lambda line: print(line, file=sys.stderr),
    )

    def has_metadata(self, job):
        return own(job) or before["has_metadata"](self, job)

    def input_changed(self, job, file=None):
        if file is not None:
            return before["input_changed"](self, job, file=file)
        changed = list(before["input_changed"](self, job))
        return iter(changed or (made.unfit(job) if own(job) else ()))

    def input_checksums(self, job, input_path):
        if not own(job) or copies(job) or not all(map(made.noted, job.output)):
            return checksums(self, job, input_path)
        # what has the content that the job's files were made of is no newer, whatever its date
        return {f"sha256:{made.digest(input_path)}"} if not made.unfit(job) else set()

    async def prepared(self):
        if own(self):
            try:
                made.begin(self)
            except Changed as error:
                print(f"error: {error}", file=sys.stderr)
                raise SystemExit(1) from None  # an exception would end in a traceback
        await prepare(self)

    async def postprocessed(self, *args, error=False, **options):
        await postprocess(self, *args, error=error, **options)
        if own(self) and not error:
            made.note(self)

    Kept.has_metadata, Kept.input_changed = has_metadata, input_changed
    Kept.input_checksums = input_checksums
    Job.prepare, Job.postprocess = prepared, postprocessed
    return made
