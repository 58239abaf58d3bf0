"""Friction along a line of `lines`, told in parts: each has a spring that slides at μN.

What is pressed all along, and of which no part slides, goes together until one of its parts may:
the whole line, or `SOME` parts beside each other of a line that rocks. It costs as one part does.
Where a line meets its plane at an angle, its points slip differently as it turns, by what their
place has along the plane; friction there turns the block too. Pressed all along, a line has next to
no angle. What closed within a step slips for the share of the step since then, as a node in `law`;
by all of it, every impact would have an error of first order.
"""

from rocking.runtime.compiled import inlined

from .vectors import choose, every, like, plus, put, put_where, some, take

PARTS = 32  # in so many parts friction is told along a line, at most
SOME = 8  # parts beside each other, which are passed over at once where none is pressed
# Rows a line: from where to where it pressed at the last step, its penetration then, d0 + d1·s, and
# the share of that step for which it did; whether its parts go together: 1, then slip that all of
# them have had since, and of the stored slips Σ length·slip, Σ length·slip² and the largest; then
# as many rows for each `SOME` parts, as below; then the slip of each part
LOW, HIGH, DEPTH, COUNTED, WHOLE, SINCE, SUM, SQUARES, MOST, GROUPS = 0, 1, 2, 4, 5, 6, 7, 8, 9, 10
# Whether they go together, slip since, at the middle of the line and along it, and of the stored
# slips Σ length·slip, Σ length·s·slip, Σ length·slip² and the largest
TOGETHER, STEP, TURN, SUMS, FIRST, SQUARED, LARGEST, OF_GROUP = 0, 1, 2, 3, 4, 5, 6, 7
SLIP = GROUPS + OF_GROUP * (PARTS // SOME)
MEMORY = SLIP + PARTS


@inlined
def _apart(groups, rows, first, mask):
    """Give groups of a line that went together the slip that it has had since; see `WHOLE`."""
    since = take(rows, first + SINCE)
    for group in range(groups):
        at = first + GROUPS + OF_GROUP * group + STEP
        put(rows, at, take(rows, at) + choose(mask, since, 0.0))
    put_where(rows, first + WHOLE, mask, 0.0)


@inlined
def _parted(lines, i, rows, first, group, mask):
    """Give the parts of a group that went together their own slips."""
    at = first + GROUPS + OF_GROUP * group
    step, turn = take(rows, at + STEP), take(rows, at + TURN)
    for part in range(SOME * group, SOME * group + SOME):
        middle = 0.5 * (lines.edge_m[i, part] + lines.edge_m[i, part + 1])
        had = take(rows, first + SLIP + part)
        put(rows, first + SLIP + part, choose(mask, had + (step + turn * middle), had))
    put_where(rows, at + TOGETHER, mask, 0.0)


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
        _apart((lines.edge_m.shape[1] - 1) // SOME, rows, first, together & ~holds)
    none = like(0.0, h0)
    shear = stuck = grip = none
    if some(holds):
        put_where(rows, first + SINCE, holds, since)
        length, sum_ = 2.0 * half, take(rows, first + SUM)
        shear = choose(holds, ratio * plus(sum_, since, length), none)
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
def _going(lines, i, rows, first, group, moves, law, acts, counts):
    """Move a group that goes together where none of its parts may slide.

    Parameters
    ----------
    group : int
    acts : tuple of 2 masks
        Where it counts; of that where all of it is pressed, now and at the last step.
    lines, i, rows, first, moves, law, counts
        See `rubbed`.

    Returns
    -------
    going, slips, firsts, squares, most
        Where it does; over its parts Σ length·slip, Σ length·s·slip, if energies are wanted
        Σ length·slip², and what no |slip| is above.
    """
    ((h0, h1), (step, more), _, _), (ratio, friction, _), (each, full) = moves, law, acts
    begin, at = SOME * group, first + GROUPS + OF_GROUP * group
    low, high = lines.edge_m[i, begin], lines.edge_m[i, begin + SOME]
    together = take(rows, at + TOGETHER) > 0.0
    slip, turn = take(rows, at + STEP) + step, take(rows, at + TURN) + more
    least = friction * max(min(plus(h0, h1, low), plus(h0, h1, high)), 0.0)
    top = take(rows, at + LARGEST) + plus(abs(slip), abs(turn), max(-low, high))
    going = together & full & (ratio * top <= least)
    parts = each & together & ~going
    if some(parts):
        _parted(lines, i, rows, first, group, parts)
    length, moment, second = high - low, 0.5 * (high * high - low * low), lines.second_m3[i, group]
    put_where(rows, at + STEP, going, slip)
    put_where(rows, at + TURN, going, turn)
    sums, firsts = take(rows, at + SUMS), take(rows, at + FIRST)
    stored = plus(plus(sums, slip, length), turn, moment)
    about = plus(plus(firsts, slip, moment), turn, second)
    squares = like(0.0, h0)
    if counts:
        squares = slip * (2.0 * sums + (slip * length + 2.0 * turn * moment))
        squares = take(rows, at + SQUARED) + squares + turn * (2.0 * firsts + turn * second)
    return going, stored, about, squares, top


@inlined
def _part_by_part(lines, i, rows, first, reach, moves, law, acts, counts):
    """As `rubbed`, part by part: where it is wanted, and where all of the line is pressed."""
    (low, high, low_then, high_then), ((h0, h1), (step, more), now, then) = reach, moves
    (ratio, friction, wanted), (each, throughout), half = law, acts, lines.half_m[i]
    shear = first_moment = stuck = grip = loss = stored = top = like(0.0, h0)
    none, kept = each & ~each, like(1.0, h0)
    alike = ~none  # where all groups so far go together
    over = 1.0 / ratio  # divisions are dear, and so are branches that go either way
    widens = counts or some(each & ((low < low_then) | (high > high_then)))
    for group in range((lines.edge_m.shape[1] - 1) // SOME):
        begin, of_group = SOME * group, first + GROUPS + OF_GROUP * group
        low_edge, high_edge = lines.edge_m[i, begin], lines.edge_m[i, begin + SOME]
        pressed = each & (min(high, high_edge) > max(low, low_edge))
        if not (counts or some(pressed)):
            alike = none
            continue
        full = (max(low, low_then) <= low_edge) & (min(high, high_then) >= high_edge)
        whole = full & pressed
        going, sums, firsts, squares, most_here = _going(
            lines, i, rows, first, group, moves, law, (each, whole), counts
        )
        if some(going):
            shear += choose(going, ratio * sums, 0.0)
            first_moment += choose(going, ratio * firsts, 0.0)
            stuck += choose(going, high_edge - low_edge, 0.0)
            grip += choose(going, squares, 0.0)
            stored += choose(going, sums, 0.0)
            top = max(top, choose(going, most_here, 0.0))
        mine = each & ~going
        pressed = pressed & ~going
        if not some(mine if counts else mine & pressed):
            alike = alike & going
            continue
        even, may_join = not counts and every(full | ~pressed), some(mine & whole)
        sums = firsts = squares = most_here = like(0.0, h0)
        slid = none
        for part in range(begin, begin + SOME):
            at = first + SLIP + part
            part_low, part_high = lines.edge_m[i, part], lines.edge_m[i, part + 1]
            if even:  # each part keeps its slip as it is
                start, stop = like(part_low, h0), like(part_high, h0)
                had, grows = take(rows, at), False
                shut, share = pressed, choose(pressed, part_high - part_low, 0.0)
            else:
                start, stop = max(low, part_low), min(high, part_high)
                shut = mine & (stop > start)
                had, share = take(rows, at), choose(shut, stop - start, 0.0)
                before, grows = share, False
                if widens:
                    before = max(min(high_then, part_high) - max(low_then, part_low), 0.0)
                    grows = some(before < share)
                if counts:
                    loss += 0.5 * ratio * before * had * had
                if grows:
                    kept = min(before, share) / choose(shut, share, 1.0)
                    had = had * kept
                if counts:
                    loss -= 0.5 * ratio * share * had * had
            middle = 0.5 * (start + stop)
            most = friction * max(plus(h0, h1, middle), 0.0)
            moved = plus(step, more, middle)
            if grows:
                moved = moved * (kept + (1.0 - kept) * _closed(now, then, middle, kept > 0.0))
            slip = had + moved
            held = ratio * slip
            force = min(max(held, -most), most)
            sticks = abs(held) <= most
            slides = shut & ~sticks
            slip, slid = choose(slides, over * force, slip), slid | slides
            of_part = share * force
            shear += of_part
            first_moment = plus(first_moment, of_part, middle)
            if may_join:
                most_here = max(most_here, choose(shut, abs(slip), 0.0))
                of_part = share * slip
                sums += of_part
                firsts = plus(firsts, of_part, middle)
            if wanted:
                stuck += choose(sticks, share, 0.0)
            # what is not pressed has a slip that counts for nothing once it is again
            put_where(rows, at, mine, slip)
            if counts:
                squares += share * slip * slip
                mean = 0.5 * (most + min(ratio * abs(had), abs(held)))
                loss += choose(sticks, 0.0, share * mean * abs(held - force) / ratio)
        grip, stored, top = grip + squares, stored + sums, max(top, most_here)
        least = friction * max(min(plus(h0, h1, low_edge), plus(h0, h1, high_edge)), 0.0)
        joins = mine & whole & ~slid & (2.0 * ratio * most_here < least)
        if some(joins):
            put_where(rows, of_group + TOGETHER, joins, 1.0)
            put_where(rows, of_group + STEP, joins, 0.0)
            put_where(rows, of_group + TURN, joins, 0.0)
            put_where(rows, of_group + SUMS, joins, sums)
            put_where(rows, of_group + FIRST, joins, firsts)
            put_where(rows, of_group + SQUARED, joins, squares)
            put_where(rows, of_group + LARGEST, joins, most_here)
        alike = alike & (going | joins)
    least = friction * max(min(h0 - h1 * half, h0 + h1 * half), 0.0)
    joins = each & throughout & alike & (2.0 * ratio * top < least)
    if some(joins):
        put_where(rows, first + WHOLE, joins, 1.0)
        put_where(rows, first + SINCE, joins, 0.0)
        put_where(rows, first + SUM, joins, stored)
        put_where(rows, first + SQUARES, joins, grip)
        put_where(rows, first + MOST, joins, top)
    return shear, first_moment, stuck, grip, loss
