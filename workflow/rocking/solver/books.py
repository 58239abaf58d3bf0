"""What is written of one history: its rows, and the energies of what is beside its blocks."""

from rocking.runtime.compiled import inlined

from .inputs import COLUMNS
from .substructure import held_by
from .vectors import lone, take


@inlined
def write(out, time, d, v, parts, half, energy, field, weight, chained):
    """One row of a history's series, see `runs.Series`."""
    out[0], out[1], out[2], out[9], out[10] = time, lone(d), lone(v), energy[0], energy[1]
    out[14], out[15], out[16] = energy[2], energy[3], energy[4]
    for m in range(3):
        rise = take(parts.rise, m)
        out[3 + m], out[6 + m] = lone(take(parts.place, m)), lone(take(parts.rate, m) + half * rise)
        out[11 + m] = lone(weight[m] * (rise + field[m]))
    place, speed, count = parts.supports.y, parts.supports.vy, len(parts.supports.y) - 1
    if chained:
        place, speed, count = parts.ride.u, parts.ride.w, len(parts.ride.u)
    for j in range(count):
        out[COLUMNS + j], out[COLUMNS + count + j] = lone(take(place, j)), lone(take(speed, j))


@inlined
def works_of(bodies, parts, memory, bars, ag, half):
    """Energies of one history beside its blocks: those of carriers and floors, see `energies`.

    Power of the inertia forces on them and of driven supports; what their dashpots take; what
    yielding has taken so far.
    """
    ride, supports = parts.ride, parts.supports
    kinetic = power = taken = 0.0
    held, lost = held_by(bodies, ride)
    n = bodies.mass_kg.size
    for j in range(n):
        speed = lone(take(ride.v, j)) + half * lone(take(ride.a, j))
        kinetic += 0.5 * bodies.mass_kg[j] * speed * speed
        power -= bodies.mass_kg[j] * bodies.ground[j] * ag * speed
        for i in range(n):
            other = lone(take(ride.v, i)) + half * lone(take(ride.a, i))
            taken += bodies.c_n_s_m[j, i] * speed * other
    for i in range(bars.mass_kg.size):
        if bars.mass_kg[i] > 0.0:
            speed = lone(take(memory.speed_m_s, i)) + half * lone(take(memory.rate_m_s2, i))
            power -= bars.mass_kg[i] * ag * speed
    for j in range(len(supports.fy) - 1 if n == 0 else 0):
        power -= lone(take(supports.fy, j)) * lone(take(supports.vy, j))
    return kinetic, held, power, taken, lost
