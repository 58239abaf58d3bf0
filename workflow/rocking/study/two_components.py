"""What `two_components` makes and reads."""

from yade_scripts.model.registry import MODELS


class TwoComponents:
    """Files of façades under both horizontal components."""

    def __init__(self, study):
        """Keep the study."""
        self.study = study

    def results(self, run) -> list[str]:
        """Everything the target `two_components` makes for one run."""
        return [
            f"results/{run}/tables/two_components.csv",
            f"results/{run}/tables/two_components_summary.csv",
            f"results/{run}/figures/two_components.png",
        ]

    def scenes(self, wildcards) -> list[str]:
        """Scenes of the run's models that have dry, driven walls and one block."""
        models = self.study.runs[wildcards.run]["models"]
        for key in ("hinges_m", "ties", "floors"):
            if given := self.study.runs[wildcards.run]["facade"][key]:
                raise SystemExit(f"error: two_components: facade.{key} = {given}: expected none")
        wanted = [m for m in models if MODELS[m].twin and MODELS[m].plain == m]
        if not wanted:
            raise SystemExit(f"error: two_components: models = {models}: expected W1 or W2")
        return [f"results/{wildcards.run}/scenes/{model}.json" for model in wanted]

    def second(self, wildcards) -> str | None:
        """The other record of the table with the same event and station; None without one."""
        rows = self.study.tables[wildcards.run]
        place = self._place(rows[wildcards.record])
        mates = [n for n, row in rows.items() if place and self._place(row) == place]
        mates = [name for name in mates if name != wildcards.record]
        return mates[0] if len(mates) == 1 else None

    def motion_along(self, wildcards) -> str:
        """Floor motions of the component along the façade; ends the workflow without one."""
        second = self.second(wildcards)
        if second is None:
            raise SystemExit(
                f"error: two_components: record {wildcards.record} in"
                f" {self.study.table_path(wildcards.run)}: expected one more record of the same"
                " event and station, such as in records_table=config/suites/recorded_suite.tsv"
            )
        return self.study.floor_motions(wildcards.run, second)

    def tables(self, wildcards) -> list[str]:
        """Curves of every record."""
        names = self.study.records[wildcards.run]
        return [f"results/{wildcards.run}/two_components/{record}.csv" for record in names]

    @staticmethod
    def _place(row):
        place = row.about.get("event"), row.about.get("station")
        return place if all(place) else None
