"""Entry point: the energy balance of one run, at a share of the intensity that fells the façade.

    python3 yade_scripts energy --scene cases/W2.json --motion smdof/RRS228_4dof.csv
        --record RRS228 --direction neg --curve ida/W2/RRS228_neg.csv --share 0.8
        --output energy/W2/RRS228_neg_0.8.csv

The terms are explained in `balance`.
"""

from yade_scripts.commands import command, shaking
from yade_scripts.commands.search import DIGITS, fallen_or_highest
from yade_scripts.commands.tables import HEAD, history_csv, history_facts, read_curve
from yade_scripts.engine import adapter, balance
from yade_scripts.files import write_atomic


def balanced_run(shaken):
    """History of a `shaking.Shaking`, and its `balance.EnergyBalance`."""
    energies = balance.EnergyBalance(shaken.scene, shaken.sample_s, shaken.motions)
    return shaken.run(setup=energies.attach), energies


def main(arguments=None):
    """Parse the command line, run, write the history; return the exit status."""
    parser = command.parser(__doc__, *command.CURVE, "curve", output="history to write (CSV)")
    parser.add_argument("--share", required=True, type=float, help="of the collapse intensity")
    args = parser.parse_args(arguments)
    if not 0.0 < args.share <= 10.0:
        raise ValueError(f"--share {args.share:g}: expected a number from 0 to 10")
    case, time_s, columns = command.opened(args)
    pga_g = round(args.share * fallen_or_highest(read_curve(args.curve)[0]), DIGITS)
    adapter.load_yade()
    shaken = shaking.of_case(case, time_s, columns, args.direction, pga_g)
    history, energies = balanced_run(shaken)
    facts = history_facts(case, args, pga_g, history)
    facts["overturning_j"] = shaken.scene.overturning_energy_j
    formats = {**HEAD, "overturning_j": ".6g", "time_s": ".6f"}
    write_atomic(args.output, history_csv(facts, balance.COLUMNS, energies.rows, formats))
    return 0
