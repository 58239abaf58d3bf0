"""Nodes and step of a run: what convergence was measured, and what follows from a tolerance."""

from yade_scripts.model import registry

MOST_BASE_NODES = 33  # against 65, median change of d/b 0.01 % over 24 histories of W2
CHOSEN = ("nodes_thickness", "nodes_height", "nodes_per_block", "step_fraction")
COURSES = "courses"  # in config/fidelity.yaml: `CHOSEN` of a façade of courses in YADE


def fidelity_table(table, share, fewest_nodes):
    """Error of every pair of nodes and step by model, cheapest first: what a share keeps.

    A coarse pair may hit the answer by chance, so the error of a pair is the largest of its own and
    of all finer ones (as many nodes or more, the same step or less). Cost is counted in node
    evaluations, so that the order does not depend on the machine. The table has repeating histories
    of the half that chooses (`accuracy.errors.errors`); failed runs are wrong. A share of 1 of the
    histories is the worst of them; pairs with fewer nodes than `fewest_nodes` are left out.
    """
    usable = (table["method"] == "nodes and step") & (table["nodes"] >= fewest_nodes)
    chosen = table[usable].fillna({"error": 1.0})
    out = {}
    for model, part in chosen.groupby("model"):
        pairs = part.groupby(["nodes", "dt_over_dt_crit"])["error"]
        worst = pairs.quantile(share, interpolation="higher").reset_index()
        worst["error"] = [
            worst.loc[(worst["nodes"] >= n) & (worst["dt_over_dt_crit"] <= f), "error"].max()
            for n, f in zip(worst["nodes"], worst["dt_over_dt_crit"], strict=True)
        ]
        worst["cost"] = 1.0 / worst["dt_over_dt_crit"] * (20.0 + worst["nodes"])
        out[str(model)] = [
            {
                "nodes": int(r.nodes),
                "step_fraction": float(r.dt_over_dt_crit),
                "error": float(f"{r.error:.3g}"),
            }
            for r in worst.sort_values("cost").itertuples()
        ]
    return out


def choose(config, model, measured):
    """Nodes and step that the configuration leaves open (null), and why they are what they are.

    What is stated is kept. The rest is the cheapest measured pair within
    `numerics.fidelity_tolerance`, or the finest without one; a bonded model takes the values
    measured for the dry one. Interlocking bricks have their own numbers in section w3. A façade of
    courses has one set for all models: the compiled solver sums its joints in closed form, and at
    these YADE is within 1 % of that (docs/record.md#base).

    `config` is resolved, or a case file; `measured` the content of config/fidelity.yaml
    (`fidelity_table`, and `COURSES`). Section numerics without open values, and the reason; a
    ValueError of one line when nothing measured meets the tolerance and not all are stated.
    """
    numerics, kind = config["numerics"], registry.model(model)
    stated = {key: numerics[key] for key in CHOSEN if numerics[key] is not None}
    if not kind.single_block:
        bricks = {key: config["w3"][key] for key in ("nodes_thickness", "step_fraction")}
        return {**numerics, **bricks, **stated}, "section w3"
    if config.get("facade", {}).get("courses"):
        courses = {**measured.get(COURSES, {}), **stated}
        if len(courses) == len(CHOSEN):
            return {**numerics, **courses}, "of courses in config/fidelity.yaml"
        model, measured = "courses", {}
    tolerance = numerics["fidelity_tolerance"]
    pairs = measured.get(kind.plain, [])
    good = [pair for pair in pairs if pair["error"] <= tolerance] if tolerance else []
    if not good and len(stated) == len(CHOSEN):
        return {**numerics, **stated}, "stated"
    if not pairs:
        raise ValueError(
            f"no convergence was measured for {model}: expected all of numerics.{', '.join(CHOSEN)}"
        )
    best = min(pairs, key=lambda pair: pair["error"])
    good = good if tolerance else [best]
    if not good:
        raise ValueError(
            f"numerics.fidelity_tolerance = {tolerance:g}: the finest measured fidelity of {model} "
            f"has an error of {best['error']:g}; state nodes and step yourself"
        )
    nodes = good[0]["nodes"]
    base = min(2 * nodes - 1, MOST_BASE_NODES)
    cheapest = dict(zip(CHOSEN, (base, nodes, nodes, good[0]["step_fraction"]), strict=True))
    reason = f"measured error {good[0]['error']:g} of {kind.plain} in config/fidelity.yaml"
    return {**numerics, **cheapest, **stated}, reason
