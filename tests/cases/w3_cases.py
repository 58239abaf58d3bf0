"""What test_interlocking runs inside YADE's Python."""


def push_case(job, speed_m_s=0.1, reach=0.08):
    """Push W3 a little way; return the curve, the joint forces as CSV and the broken bonds."""
    from yade_scripts.commands.pushover import forces_csv, push
    from yade_scripts.engine import adapter
    from yade_scripts.model import models

    adapter.load_yade()
    scene = models.build_scene(job)
    curve, forces, broken = push(
        scene, models.numerics(job), speed_m_s=speed_m_s, reach=reach, samples=300, force_samples=30
    )
    return {"curve": curve.tolist(), "forces": forces_csv(scene, forces), "broken": len(broken)}


def shake_case(job, fractions, time_s, columns):
    """Peak d/b of W3 under prescribed floor motions, by step over the critical one."""
    import numpy as np

    from yade_scripts.commands import shaking
    from yade_scripts.model import models

    scene = models.build_scene(job)
    time_s = np.array(time_s)
    columns = {name: np.array(values) for name, values in columns.items()}
    out = []
    for fraction in fractions:
        numerics = {**models.numerics(job), "step_fraction": fraction}
        history = shaking.set_up(scene, numerics, time_s, columns, 1.0).retried()
        out.append([history.status, history.peak_d_over_b])
    return out
