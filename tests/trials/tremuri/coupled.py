"""Drifts of both walls of the house that TREMURI computed, walls that a floor ties together.

    .venv/bin/python tests/trials/tremuri/coupled.py [--apart]

Each wall is a storey that yields under its share of the mass; between them the timber floor is an
elastic spring. Masses, floor and damping are those of the house's own input file (Vertical-GM-URM,
TremuriModels/Model_EUC_BUILD_8_MotherFile.txt): 4.5 t on the wall with windows, whose piers are
squat, 4.4 t on the one with doors; planks of 24 mm and G = 24 MPa over 4.12 m by 3.94 m, 0.60 MN/m;
α = 1.078 1/s on masses, β = 0.000883 s on elastic stiffness. Period and V/W of both walls and the
law are chosen on half of the stations for both walls at once, and judged on the other half; both
halves choose in turn. `--apart` leaves the floor out. Leapfrog at 1 ms.
"""

import argparse
from itertools import product

import numpy as np
import pandas as pd
from loops import Response
from predict import STEP_S, TABLE, motions_of

MASS_KG = np.array([4480.0, 4400.0])  # squat, slender
FLOOR_N_M = 24e6 * 0.024 * 4.12 / 3.94
ALPHA_1_S, BETA_S = 1.078464369, 0.000883288
PERIODS_S = ((0.04, 0.05, 0.065, 0.085), (0.15, 0.19, 0.23, 0.28))
STRENGTHS = ((0.20, 0.28, 0.38, 0.50), (0.16, 0.20, 0.24, 0.30))
LAWS = ("bilinear", "peak_oriented", "origin_oriented", "flag")
LONGEST_S, SHARES = 25.0, (5e-4, 0.995)  # of ∫a² dt, between which a motion is run
WALLS = ("squat", "slender")


def cut(a):
    """The part of a motion that shakes, padded to `LONGEST_S`."""
    grown = np.cumsum(a**2) / np.sum(a**2)
    first, last = np.searchsorted(grown, SHARES)
    some = a[first : min(last, first + round(LONGEST_S / STEP_S))]
    return np.pad(some, (0, round(LONGEST_S / STEP_S) - some.size))


def drifts_mm(ground, law, cases, floor_n_m):
    """Largest drifts [mm], shape (motions, cases, 2); ground (motions, samples)."""
    period, ratio = cases[:, :2], cases[:, 2:]
    k = MASS_KG * (2.0 * np.pi / period) ** 2
    strength = ratio * MASS_KG * 9.80665
    loops = Response(law, strength.ravel(), k.ravel(), len(ground))
    shape = (len(ground), len(cases), 2)
    place, speed, peak = np.zeros(shape), np.zeros(shape), np.zeros(shape)
    for a in ground.T:
        force = loops.move(place.reshape(len(ground), -1)).reshape(shape)
        across = floor_n_m * (place - place[..., ::-1])
        dragged = BETA_S * (k * speed + floor_n_m * (speed - speed[..., ::-1]))
        speed = speed - STEP_S * (
            a[:, None, None] + ALPHA_1_S * speed + (force + across + dragged) / MASS_KG
        )
        place = place + STEP_S * speed
        np.maximum(peak, np.abs(place), out=peak)
    return 1e3 * peak


def judged(off, mine):
    """Root of the mean square, median ratio and scatter of logarithms `off` of some motions."""
    some = off[mine]
    known = some[np.isfinite(some)]
    return np.sqrt(np.mean(known**2)), np.exp(np.median(known)), np.std(known, ddof=1)


def main():
    """Choose on one half, judge on the other."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--apart", action="store_true", help="leave out the floor between them")
    parser.add_argument("--laws", nargs="+", default=LAWS)
    args = parser.parse_args()
    table = pd.read_csv(TABLE, comment="#")
    seen = table[[f"{wall}_mm" for wall in WALLS]].to_numpy(float)
    names = list(dict.fromkeys(table["station"]))
    ground = np.array([cut(a) for a in motions_of(table["record"]).values()])
    cases = np.array(list(product(*PERIODS_S, *STRENGTHS)))
    rows = []
    for law in args.laws:
        found = drifts_mm(ground, law, cases, 0.0 if args.apart else FLOOR_N_M)
        off = np.log(found / seen[:, None, :])
        for number, case in enumerate(cases):
            row = {"law": law, "periods_s": tuple(case[:2]), "ratios": tuple(case[2:])}
            for half in (0, 1):
                mine = table["station"].isin(names[half::2]).to_numpy()
                both = 0.0
                for i, wall in enumerate(WALLS):
                    rms, median, scatter = judged(off[:, number, i], mine)
                    both += rms**2
                    row |= {f"{wall}_{half}_median": median, f"{wall}_{half}_scatter": scatter}
                row[f"chosen_{half}"] = np.sqrt(0.5 * both)
            rows.append(row)
    found = pd.DataFrame(rows)
    for half in (0, 1):
        other = 1 - half
        names = [f"{wall}_{other}_{what}" for wall in WALLS for what in ("median", "scatter")]
        best = found.sort_values(f"chosen_{half}").groupby("law", sort=False).head(1)
        print(f"half {half} chooses, the other judges")
        shown = best[["law", "periods_s", "ratios", f"chosen_{half}", *names]]
        print(shown.to_string(index=False, float_format="%.3f"), flush=True)


if __name__ == "__main__":
    main()
