"""Cosine and sine of rotations: series, with the same digits in a vector and on any machine.

A library's own go lane by lane, which takes a third of the march of courses, and their last digit
differs from one processor to another.
"""

import math

from rocking.runtime.compiled import inlined

from .vectors import choose, like, some

EIGHTH = math.pi / 4.0  # of a turn; up to there the series are right to their last digit or two
SINE = tuple((-1.0) ** k / math.factorial(2 * k + 1) for k in range(1, 9))  # after the angle
COSINE = tuple((-1.0) ** k / math.factorial(2 * k) for k in range(2, 9))  # after 1 − z/2
S3, S5, S7, S9, S11, S13, S15, S17 = SINE
C4, C6, C8, C10, C12, C14, C16 = COSINE
# π/2 in parts: whole numbers of quarters below 2²⁰ times the first two are exact
QUARTER = float.fromhex("0x1.921fb544p0")
QUARTER_REST = float.fromhex("0x1.0b4611a6p-34")
QUARTER_LAST = float.fromhex("0x1.3198a2e037073p-69")
WHOLE = 1.5 * 2.0**52  # a float next to it has no places after the point


@inlined
def _whole(number):
    """Nearest whole number, of less than 2⁵¹."""
    return (number + WHOLE) - WHOLE


@inlined
def cos_sin(angle, wanted):
    """Cosine and sine [-] of an angle [rad]; of an angle of zero where they are not wanted.

    Taylor's series of what is left of the angle beyond whole quarters of a turn, up to π/4; the
    terms left out are below 2⁻⁵⁴ of the result. Right to 0.8 units of the last digit up to π/4,
    to 1.5 up to 1,000 rad. NaN of what is not finite.
    """
    rest = angle = choose(wanted, angle, 0.0)
    quarters, far = like(0.0, angle), abs(angle) > EIGHTH
    if some(far):
        quarters = choose(far, _whole(angle * (2.0 / math.pi)), 0.0)
        rest = ((angle - quarters * QUARTER) - quarters * QUARTER_REST) - quarters * QUARTER_LAST
    z = rest * rest
    sin = S3 + z * (S5 + z * (S7 + z * (S9 + z * (S11 + z * (S13 + z * (S15 + z * S17))))))
    cos = C4 + z * (C6 + z * (C8 + z * (C10 + z * (C12 + z * (C14 + z * C16)))))
    half = 0.5 * z
    near = 1.0 - half  # what it is rounded by is added again
    sin, cos = rest + rest * (z * sin), near + (((1.0 - near) - half) + z * z * cos)
    if some(far):
        left = quarters - 4.0 * _whole(0.25 * quarters)  # from −2 to 2
        odd = (abs(left) > 0.5) & (abs(left) < 1.5)
        sin, cos = choose(odd, cos, sin), choose(odd, sin, cos)
        sin = choose((left < -0.5) | (left > 1.5), -sin, sin)
        cos = choose((left > 0.5) | (left < -1.5), -cos, cos)
    return cos, sin
