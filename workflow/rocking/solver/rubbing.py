"""Friction along a line of `lines`, told in parts: each has a spring that slides at μN.

Parts that are pressed all along, and of which none slides, go together until one of them may.
Where a line meets its plane at an angle, its points slip differently as it turns, by what their
place has along the plane; friction there turns the block too. Pressed all along, a line has next to
no angle. What closed within a step slips for the share of the step since then, as a node in `law`;
by all of it, every impact would have an error of first order.
"""

from rocking.runtime.compiled import inlined

from .vectors import choose, every, like, put, put_where, some, take

PARTS = 32  # in so many parts friction is told along a line, at most
# Rows a line: from where to where it pressed at the last step, its penetration then, d0 + d1·s, and
# the share of that step for which it did; whether its parts go together: 1, then slip that all of
# them have had since, and of the stored slips Σ length·slip, Σ length·slip² and the largest; then
# the slip of each part
LOW, HIGH, DEPTH, COUNTED, WHOLE, SINCE, SUM, SQUARES, MOST, SLIP = 0, 1, 2, 4, 5, 6, 7, 8, 9, 10
MEMORY = SLIP + PARTS
SOME = 8  # parts that are passed over at once where none is pressed


@inlined
def _apart(parts, rows, first, mask):
    """Give the parts of a line that went together their own slips."""
    since = take(rows, first + SINCE)
    for part in range(parts):
        had = take(rows, first + SLIP + part)
        put(rows, first + SLIP + part, choose(mask, had + since, had))
    put_where(rows, first + WHOLE, mask, 0.0)


@inlined
def _closed(now, then, at, rolls):
    """Share of a step for which what closed within it has pressed; where it rolls shut, ½."""
    deep = now[0] + now[1] * at
    gain = deep - (then[0] + then[1] * at)
    some_way = (gain > 0.0) & ~rolls
    return choose(some_way, max(min(deep / choose(some_way, gain, 1.0), 1.0), 0.0), 0.5)


@inlined
def rubbed(lines, i, rows, first, reach, moves, law, acts, counts):
    """Friction along a line; forces and energies over k.

    Where all of it is pressed, now and at the last step, and no part slides, the parts go together.

    Parameters
    ----------
    lines, i, rows, first
        The line, and its rows from that one on.
    reach : tuple of 4 numbers
        From where to where it is pressed, now and at the last step.
    moves : tuple of 4 tuples of 2 numbers
        Along the line, as h0 + h1·s: normal force over k; slip of this step; penetration now and
        at the last step.
    law : tuple of 3
        ks/kn, tan φ; whether the length that sticks is wanted.
    acts : mask
        Where it is pressed at all.

    Returns
    -------
    shear, first_moment, stuck, grip, loss : number
        Force, Σ s·force, length that sticks, Σ length·slip², and the energy that sliding took and
        opening parts lost; the last two of one history.
    """
    (low, high, low_then, high_then), ((h0, h1), (step, _), _, _) = reach, moves
    (ratio, friction, _), half = law, lines.half_m[i]
    throughout = (max(low, low_then) <= -half) & (min(high, high_then) >= half) & acts
    least = friction * max(min(h0 - h1 * half, h0 + h1 * half), 0.0)
    together = take(rows, first + WHOLE) > 0.0
    since = take(rows, first + SINCE) + step
    holds = together & throughout
    holds = holds & (ratio * (take(rows, first + MOST) + abs(since)) <= least)
    if some(together & ~holds):
        _apart(lines.edge_m.shape[1] - 1, rows, first, together & ~holds)
    none = like(0.0, h0)
    shear = stuck = grip = none
    if some(holds):
        put_where(rows, first + SINCE, holds, since)
        length, sum_ = 2.0 * half, take(rows, first + SUM)
        shear = choose(holds, ratio * (sum_ + since * length), none)
        stuck = choose(holds, length, none)
        if counts:
            grip = take(rows, first + SQUARES) + since * (2.0 * sum_ + since * length)
    each = acts & ~holds
    if not (counts or some(each)):
        return shear, none, stuck, grip, none
    if counts and some(holds):
        return shear, none, stuck, grip, none
    t, m, s, g, loss = _part_by_part(
        lines, i, rows, first, reach, moves, law, (each, throughout), counts
    )
    return choose(each, t, shear), choose(each, m, none), choose(each, s, stuck), grip + g, loss


@inlined
def _part_by_part(lines, i, rows, first, reach, moves, law, acts, counts):
    """As `rubbed`, part by part: where it is wanted, and where all of the line is pressed."""
    (low, high, low_then, high_then), ((h0, h1), (step, more), now, then) = reach, moves
    (ratio, friction, wanted), (each, throughout), half = law, acts, lines.half_m[i]
    shear = first_moment = stuck = grip = loss = stored = top = like(0.0, h0)
    glides, kept = each & ~each, like(1.0, h0)
    for begin in range(0, lines.edge_m.shape[1] - 1, SOME):
        low_edge, high_edge = lines.edge_m[i, begin], lines.edge_m[i, begin + SOME]
        pressed = each & (min(high, high_edge) > max(low, low_edge))
        if not (counts or some(pressed)):
            continue
        full = (max(low, low_then) <= low_edge) & (min(high, high_then) >= high_edge)
        even = not counts and every(full | ~pressed)
        for part in range(begin, begin + SOME):
            at = first + SLIP + part
            one, two = lines.edge_m[i, part], lines.edge_m[i, part + 1]
            if even:  # each part keeps its slip as it is
                start, stop = like(one, h0), like(two, h0)
                had, grows = take(rows, at), False
                shut, share = pressed, choose(pressed, two - one, 0.0)
            else:
                # what is not pressed keeps a slip that counts for nothing once it is again
                start, stop = max(low, one), min(high, two)
                shut = each & (stop > start)
                if not (counts or some(shut)):
                    continue
                had, share = take(rows, at), choose(shut, stop - start, 0.0)
                before = max(min(high_then, two) - max(low_then, one), 0.0)
                if counts:
                    loss += 0.5 * ratio * before * had * had
                grows = some(before < share)
                if grows:
                    kept = min(before, share) / choose(shut, share, 1.0)
                    had = had * kept
                if counts:
                    loss -= 0.5 * ratio * share * had * had
            middle = choose(shut, 0.5 * (start + stop), 0.0)
            most = friction * max(h0 + h1 * middle, 0.0)
            moved = step + more * middle
            if grows:
                moved = moved * (kept + (1.0 - kept) * _closed(now, then, middle, kept > 0.0))
            slip = had + moved
            held = ratio * slip
            force = min(max(held, -most), most)
            sticks = abs(held) <= most
            slides = shut & ~sticks
            if some(slides):  # a division is dear
                slip = choose(slides, force / ratio, slip)
                glides = glides | slides
            slip = choose(shut, slip, 0.0)
            shear += share * force
            first_moment += share * force * middle
            top, stored = max(top, abs(slip)), stored + share * slip
            if wanted:
                stuck += choose(sticks, share, 0.0)
            put_where(rows, at, each, slip)
            if counts:
                grip += share * slip * slip
                mean = 0.5 * (most + min(ratio * abs(had), abs(held)))
                loss += choose(sticks, 0.0, share * mean * abs(held - force) / ratio)
    least = friction * max(min(h0 - h1 * half, h0 + h1 * half), 0.0)
    joins = each & throughout & ~glides & (2.0 * ratio * top < least)
    if some(joins):
        put_where(rows, first + WHOLE, joins, 1.0)
        put_where(rows, first + SINCE, joins, 0.0)
        put_where(rows, first + SUM, joins, stored)
        put_where(rows, first + SQUARES, joins, grip)
        put_where(rows, first + MOST, joins, top)
    return shear, first_moment, stuck, grip, loss
