"""Records whose floors another program computed: what a run can have of them."""

from rocking.collapse.others import searched
from rocking.configuration.schema import ConfigError
from rocking.records.floor_table import floors_named, intensities, is_table
from yade_scripts.model.chain import yields
from yade_scripts.model.registry import MODELS


def refuse(resolved, row):
    """Refuse in one line a run that would ignore the floors of a row, or has not what they need."""
    where = f"{resolved['records_table']}, line {row.line}: record {row.record} has floors: "
    chain, models = resolved["smdof"], resolved["models"]
    if two_way := [name for name in models if MODELS[name].two_way]:
        raise ConfigError(
            f"{where}models = {two_way[0]}: expected models that floors drive or that have none, "
            f"as W2 and W1; {two_way[0]} computes its floors itself"
        )
    if yields(chain):
        raise ConfigError(
            f"{where}smdof.base_shear_ratio = {chain['base_shear_ratio']:g}: expected null, since "
            "these floors are another program's and are not computed again"
        )
    if not any(MODELS[name].chain for name in models):
        return
    count = floors_named(row.floors_path)
    if count and count != chain["n_dof"]:
        raise ConfigError(
            f"{where}smdof.n_dof = {chain['n_dof']}: expected {count}, as many as there are floors"
        )
    if is_table(row.floors_path):
        _within(where, resolved["ida"], intensities(row.floors_path)[-1][0])


def _within(where, ida, highest_g):
    """Refuse intensities above the highest of a table."""
    grid = ida["mode"] == "grid"
    key = "ida.grid_g" if grid else "ida.max_pga_g"
    asked = max(ida["grid_g"]) if grid else ida["max_pga_g"]
    most = highest_g if grid else searched(highest_g)
    if asked > most * (1.0 + 1e-9):
        raise ConfigError(
            f"{where}{key} = {asked:g}: expected at most {most:.4g} (g), the highest intensity of "
            "their table, around which realisations spread"
        )
