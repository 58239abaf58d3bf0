"""Cost of a history in both planar solvers: a batch over the shipped suite.

    .venv/bin/python tests/trials/benchmarks/planar_histories.py --histories 5000 --model W2

Processor time of one process, of the compiled solver and, with --adaptive, of the adaptive one. The
amplitudes of every component and direction run from --low to --high in equal ratios.
"""

import argparse
import sys
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[3]
sys.path[:0] = [str(ROOT), str(ROOT / "workflow")]

from reference_solver import SupportTable, simulate_batch  # noqa: E402
from reference_solver.facade import wall_of  # noqa: E402
from rocking.collapse.scan import Screen  # noqa: E402
from rocking.configuration import config  # noqa: E402
from rocking.configuration.files import read_yaml  # noqa: E402
from rocking.configuration.study import as_in_the_study  # noqa: E402
from rocking.fidelity import choose  # noqa: E402
from rocking.records import load, read_table  # noqa: E402

from smdof import floor_motions, shear_chain  # noqa: E402
from yade_scripts.model.motion import amplitude  # noqa: E402

SUITE = ROOT / "config" / "suites" / "recorded_suite.tsv"


def solve(job, motion, direction, pga_g, adaptive_nodes):
    """Histories that overturned, and the simulated time where the solver tells it [s]."""
    if adaptive_nodes:
        floors = motion.floors_m_s2 if job["model"] == "W2" else None
        driven = SupportTable(float(motion.time_s[1]), motion.ground_m_s2, floors)
        scales = [amplitude(motion.ground_m_s2, direction, g) for g in pga_g]
        found = simulate_batch(wall_of(job, adaptive_nodes), driven, scales, stop_d_over_b=1.0)
        return found.overturned.sum(), found.end_time_s.sum()
    columns = {"ground": motion.ground_m_s2}
    columns |= {f"floor{j + 1}": floor for j, floor in enumerate(motion.floors_m_s2)}
    screen = Screen(job, motion.time_s, columns, direction)
    return screen.run(pga_g, scatter=False)["collapsed"].sum(), np.nan


def main(arguments=None):
    """Run the batch and print its cost."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--model", default="W2")
    parser.add_argument("--histories", type=int, default=5000)
    parser.add_argument("--low", type=float, default=0.05, help="least PGA (g)")
    parser.add_argument("--high", type=float, default=1.0, help="largest PGA (g)")
    parser.add_argument("--building", type=float, default=60.0, help="its mass, of W2m (t)")
    parser.add_argument("--courses", type=int, default=0, help="elastic courses, of growth 1.5")
    parser.add_argument("--adaptive", type=int, help="nodes: the adaptive solver instead")
    args = parser.parse_args(arguments)
    mass = {"building_mass_kg": 1e3 * args.building}
    facade = {"courses": args.courses, "courses_growth": 1.5} if args.courses else {}
    job = config.resolve(
        as_in_the_study({"models": [args.model], "return_wall": mass, "facade": facade})
    )
    job |= {"model": args.model, "beta_s": job["damping"]["beta_s"]}
    job["numerics"], _ = choose(job, args.model, read_yaml(ROOT / "config" / "fidelity.yaml"))
    names, chain = list(read_table(SUITE)), job["smdof"]
    each = -(-args.histories // (2 * len(names)))
    pga_g = np.geomspace(args.low, args.high, each)
    spent = count = fell = simulated = 0.0
    for name in names:
        record = load(name, SUITE)
        motion = floor_motions(
            record.acceleration_m_s2, record.dt_s, shear_chain(chain["n_dof"], chain["period_s"])
        )
        for direction in ("pos", "neg"):
            if not count:  # compiles
                solve(job, motion, direction, pga_g[:1], args.adaptive)
            began = time.process_time()
            down, length = solve(job, motion, direction, pga_g, args.adaptive)
            spent += time.process_time() - began
            count, fell, simulated = count + each, fell + down, simulated + length
    print(
        f"{args.model}: {count:.0f} histories, {fell:.0f} overturned, {spent:.1f} s of one core, "
        f"{1e3 * spent / count:.2f} ms each; 100,000 in {1e5 * spent / count / 60:.1f} min of it"
    )
    if args.adaptive:
        print(f"{simulated / spent:.0f} simulated seconds a second")


if __name__ == "__main__":
    main()
