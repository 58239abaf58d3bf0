"""Runs of one case under one motion, of which finished ones come from the journal."""

from yade_scripts.commands import perturb, shaking
from yade_scripts.commands.journal import run_key
from yade_scripts.commands.tables import run_row
from yade_scripts.engine import memory
from yade_scripts.model import floor_motions, models, yielding
from yade_scripts.model.motion import amplitude
from yade_scripts.model.scene import to_json
from yade_scripts.sources import digest


class Runner:
    """Runs of one model, record and direction.

    `say` receives lines of progress; `before` is a shock before the motion, see
    `floor_motions.after`. Of the runs so far, `count`, the journal had `reused`; `history` is that
    of the last, None where the journal had it.
    """

    def __init__(self, case, time_s, columns, record, direction, journal, say, before=None):
        """Keep what every run shares."""
        self.before = before
        self.first: tuple = ()
        if before is not None:
            first_s, first, pause_s = before
            moved = b"".join(values.tobytes() for values in (first_s, *first.values()))
            self.first = (moved, pause_s)
        self.case, self.time_s = case, time_s
        columns = yielding.of_case(case, time_s, columns)
        self.columns = columns if before is None else yielding.following(columns, before[1])
        self.record, self.direction, self.journal, self.say = record, direction, journal, say
        self.digest = digest(__file__)
        self.scenes: dict = {}
        self.reused, self.count, self.history = 0, 0, None
        self.ceiling = memory.Ceiling()

    def scene(self, extra_nodes, numerics):
        """Scene with so many extra nodes, and the hash of it and of its motions."""
        if extra_nodes not in self.scenes:
            case = {**self.case, "numerics": numerics}
            scene, self.columns = floor_motions.shaken(models.build_scene(case), self.columns)
            motion = yielding.content(self.columns, scene.motions)
            self.scenes[extra_nodes] = (
                scene,
                run_key(to_json(scene), motion + self.time_s.tobytes(), self.digest, *self.first),
            )
        return self.scenes[extra_nodes]

    def run(self, pga_g, realisation=perturb.ALONE):
        """Row of one realisation at one intensity (contract of the ensemble table)."""
        numerics = perturb.perturbed_numerics(models.numerics(self.case), realisation)
        scene, scene_key = self.scene(realisation.extra_nodes, numerics)
        ground = self.columns["ground"]
        factor = realisation.amplitude_factor * amplitude(ground, self.direction, pga_g)
        key = run_key(scene_key, numerics, factor)
        row = self.journal.get(key)
        if row is None:
            time_s, columns = self.time_s, self.columns
            if self.before is not None:
                second = floor_motions.scaled(columns, factor)
                (time_s, columns), factor = floor_motions.after(self.before, time_s, second), 1.0
            self.history = shaking.set_up(scene, numerics, time_s, columns, factor).retried()
            row = run_row(self.case["model"], self.record, self.direction, pga_g, self.history)
            self.journal.put(key, row, self.history.reason)
            if self.ceiling.reached():
                memory.start_afresh()  # finished runs are in the journal
        else:
            self.reused, self.history = self.reused + 1, None
        self.count += 1
        return {
            **row,
            "realisation": realisation.number,
            "amplitude_factor": realisation.amplitude_factor,
        }

    def told(self):
        """Say how many of the runs were there already."""
        if self.reused:
            self.say(f"{self.reused} of {self.count} runs taken from earlier work")
