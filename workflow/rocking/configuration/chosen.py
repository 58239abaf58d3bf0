"""What the open values (null) of a run stand for, and why; written below its configuration."""

from rocking.configuration.files import read_yaml
from rocking.fidelity import CHOSEN, choose
from rocking.mechanics.beta import beta_and_range
from rocking.runtime import terminal
from yade_scripts.model.facade import joint_stiffness
from yade_scripts.model.facades import Facade
from yade_scripts.model.models import static_multiplier


def chosen(resolved, fidelity_file, law_file, stated=()):
    """Lines that say what a run takes where its configuration leaves the choice open.

    They rest on the files of measured convergence and of the fitted law of β. A warning says what
    lies outside the range of a law that section damping of `stated`, the user's configuration,
    names; of the default law the lines alone do.
    """
    base, back = joint_stiffness(resolved)
    facade, wall = Facade.of(resolved["facade"]), resolved["return_wall"]
    lines = ["Chosen where null stands above:"]
    if facade.base_stiffness_pa_m is None:
        law = "E over half the lowest course" if facade.courses else "E/h"
        lines.append(f"  facade.base_stiffness_pa_m: {base:.6g} ({law})")
    if wall["length_m"] is None:
        lines.append(f"  return_wall.length_m: {0.5 * facade.height_m:.6g} (h/2)")
    beta, outside = beta_and_range(resolved, law_file)
    if outside and "law" in (dict(stated).get("damping") or {}):
        terminal.warn([f"{resolved['run']}: {outside}"])
    about = f"law: {resolved['damping']['law']}" + (f"; {outside}" if outside else "")
    lines.append(f"  damping: beta {beta:.6g} s ({about})")
    measured = read_yaml(fidelity_file)
    for model in resolved["models"]:
        numerics, reason = choose(resolved, model, measured)
        values = ", ".join(f"{key} {numerics[key]:g}" for key in CHOSEN if numerics[key])
        lines.append(f"  numerics for {model}: {values} ({reason}; stated values are kept)")
        if resolved["ida"]["start_g"] is None:
            start = 0.5 * static_multiplier({**resolved, "model": model})
            lines.append(f"  ida.start_g for {model}: {start:.4f} (half the static capacity)")
    return lines
