"""Numbers side by side in compiled code: LLVM's own vectors behind Python's operators.

Code that keeps to arithmetic, comparisons, `min`, `max`, `abs`, `math.copysign` and the functions
below stands for one number and for `WIDTH` of them alike, with the same digits: each operation is
that of a single number, nothing is fused or summed across. Its memory has rows: of one number each
in an array of one dimension, of `WIDTH` in one of shape (rows, WIDTH).
"""

import math
import operator
from typing import Any

import numpy as np
from llvmlite import ir
from numba.core import cgutils, types
from numba.core.imputils import lower_builtin, lower_cast
from numba.core.typeconv import Conversion
from numba.core.typing.templates import ConcreteTemplate, infer_global, signature
from numba.extending import intrinsic, models, overload, register_model

from rocking.runtime.compiled import compiled, inlined

WIDTH = 8  # as many as one AVX-512 register holds; narrower machines take several for one
_REALS = ir.VectorType(ir.DoubleType(), WIDTH)
_TRUTHS = ir.VectorType(ir.IntType(1), WIDTH)
_BITS = ir.IntType(WIDTH)


class Lanes(types.Type):
    """`WIDTH` floats; a float where they are wanted counts for all of them."""

    def can_convert_from(self, typingctx, other):
        """Widen a float or an integer."""
        return Conversion.promote if other is types.float64 else None

    def unify(self, typingctx, other):
        """Lanes, where another branch has a float."""
        return self if other is types.float64 else None


class Mask(types.Type):
    """`WIDTH` truth values; a single one where they are wanted counts for all of them."""

    def can_convert_from(self, typingctx, other):
        """Widen a single one."""
        return Conversion.promote if other is types.boolean else None

    def unify(self, typingctx, other):
        """A mask, where another branch has a single one."""
        return self if other is types.boolean else None


LANES, MASK = Lanes("lanes"), Mask("mask")


@register_model(Lanes)
class _LanesModel(models.PrimitiveModel):
    def __init__(self, manager, kind):
        super().__init__(manager, kind, _REALS)


@register_model(Mask)
class _MaskModel(models.PrimitiveModel):
    def __init__(self, manager, kind):
        super().__init__(manager, kind, _TRUTHS)


def _wide(builder, value):
    """A float or truth value in all lanes; lanes and masks as they are."""
    if isinstance(value.type, ir.VectorType):
        return value
    first = ir.Constant(ir.IntType(32), 0)
    nothing = ir.Constant(ir.VectorType(value.type, WIDTH), ir.Undefined)
    one = builder.insert_element(nothing, value, first)
    everywhere = ir.Constant(ir.VectorType(ir.IntType(32), WIDTH), [0] * WIDTH)
    return builder.shuffle_vector(one, nothing, everywhere)


@lower_cast(types.float64, Lanes)
@lower_cast(types.boolean, Mask)
def _widen(context, builder, _from, _to, value):
    return _wide(builder, value)


def _call(name, arguments):
    """Emit a function of LLVM's on as many lanes."""

    def emit(builder, *values):
        kind = ir.FunctionType(_REALS, [_REALS] * arguments)
        name_here = f"llvm.{name}.v{WIDTH}f64"
        return builder.call(cgutils.get_or_insert_function(builder.module, kind, name_here), values)

    return emit


def _defined(function, result, cases, emit):
    """Let a function or operator take lanes."""
    signatures = [signature(result, *case) for case in cases]
    infer_global(function)(type("Typing", (ConcreteTemplate,), {"cases": signatures}))

    def lower(context, builder, sig, values):
        return emit(builder, *(_wide(builder, value) for value in values))

    for case in cases:
        lower_builtin(function, *case)(lower)


def _compare(sign):
    return lambda builder, one, other: builder.fcmp_ordered(sign, one, other)


def _extreme(sign):
    """As numba has it for floats: the second where it is beyond the first."""

    def emit(builder, one, other):
        return builder.select(builder.fcmp_ordered(sign, other, one), other, one)

    return emit


_PAIRS = [(LANES, LANES), (LANES, types.float64), (types.float64, LANES)]
for _functions, _emit in (
    ((operator.add, operator.iadd), ir.IRBuilder.fadd),
    ((operator.sub, operator.isub), ir.IRBuilder.fsub),
    ((operator.mul, operator.imul), ir.IRBuilder.fmul),
    ((operator.truediv,), ir.IRBuilder.fdiv),
    ((min,), _extreme("<")),
    ((max,), _extreme(">")),
    ((math.copysign,), _call("copysign", 2)),
):
    for _function in _functions:
        _defined(_function, LANES, _PAIRS, _emit)
for _function, _sign in ((operator.lt, "<"), (operator.le, "<="), (operator.gt, ">")):
    _defined(_function, MASK, _PAIRS, _compare(_sign))
_defined(operator.ge, MASK, _PAIRS, _compare(">="))
_defined(abs, LANES, [(LANES,)], _call("fabs", 1))
_defined(operator.neg, LANES, [(LANES,)], ir.IRBuilder.fneg)
for _function, _emit in ((operator.and_, ir.IRBuilder.and_), (operator.or_, ir.IRBuilder.or_)):
    _defined(_function, MASK, [(MASK, MASK), (MASK, types.boolean), (types.boolean, MASK)], _emit)
_defined(operator.invert, MASK, [(MASK,)], ir.IRBuilder.not_)


def _emitted(function) -> Any:
    """Let compiled code call what a function emits."""
    return intrinsic(function)


@_emitted
def _select(typingctx, mask, yes, no):
    def emit(context, builder, sig, values):
        return builder.select(values[0], _wide(builder, values[1]), _wide(builder, values[2]))

    return LANES(mask, yes, no), emit


@_emitted
def _some(typingctx, mask):
    def emit(context, builder, sig, values):
        bits = builder.bitcast(values[0], _BITS)
        return builder.icmp_unsigned("!=", bits, ir.Constant(_BITS, 0))

    return types.boolean(mask), emit


def choose(mask, yes, no):
    """`yes` where the mask is true, else `no`; both are computed."""
    return yes if mask else no


def some(mask):
    """Whether the mask is true anywhere."""
    return mask


def every(mask):
    """Whether the mask is true everywhere."""
    return mask


@overload(choose)
def _choose(mask, yes, no):
    if isinstance(mask, Mask):
        return lambda mask, yes, no: _select(mask, yes, no)
    return choose


@overload(some)
def _of_some(mask):
    if isinstance(mask, Mask):
        return lambda mask: _some(mask)
    return some


@overload(every)
def _of_every(mask):
    if isinstance(mask, Mask):
        return lambda mask: not _some(~mask)
    return every


@_emitted
def _widened(typingctx, value):
    kind = MASK if isinstance(value, types.Boolean) else LANES
    return kind(value), lambda context, builder, sig, values: _wide(builder, values[0])


def like(value, number):
    """`value`, a float or truth value, as many as `number` stands for."""
    return value


@overload(like)
def _like(value, number):
    if isinstance(number, Lanes) and not isinstance(value, Lanes | Mask):
        return lambda value, number: _widened(value)
    return like


def alone(number):
    """Whether a number stands for itself alone; a constant to the compiler."""
    return True


@overload(alone)
def _alone(number):
    if isinstance(number, Lanes):
        return lambda number: False
    return alone


@_emitted
def _lane(typingctx, lanes, lane):
    def emit(context, builder, sig, values):
        return builder.extract_element(*values)

    return types.float64(lanes, types.intp), emit


def lone(number):
    """A number that stands for itself alone; of lanes the first."""
    return number


@overload(lone)
def _lone(number):
    if isinstance(number, Lanes):
        return lambda number: _lane(number, 0)
    return lone


@_emitted
def _with_lane(typingctx, lanes, lane, value):
    def emit(context, builder, sig, values):
        return builder.insert_element(values[0], values[2], values[1])

    return LANES(lanes, types.intp, types.float64), emit


def cos_sin(angle, wanted):
    """Cosine and sine, those of the library, lane by lane where they are wanted."""
    return math.cos(angle), math.sin(angle)


@overload(cos_sin)
def _cos_sin(angle, wanted):
    if not isinstance(angle, Lanes):
        return cos_sin

    def lane_by_lane(angle, wanted):
        cos, sin, ask = _widened(1.0), _widened(0.0), choose(wanted, 1.0, _widened(0.0))
        for lane in range(WIDTH):
            if _lane(ask, lane) > 0.0:
                cos = _with_lane(cos, lane, math.cos(_lane(angle, lane)))
                sin = _with_lane(sin, lane, math.sin(_lane(angle, lane)))
        return cos, sin

    return lane_by_lane


def hypot(y, z):
    """√(y² + z²), that of the library, lane by lane."""
    return math.hypot(y, z)


@overload(hypot)
def _hypot(y, z):
    if not isinstance(y, Lanes):
        return hypot

    def lane_by_lane(y, z):
        found = y
        for lane in range(WIDTH):
            found = _with_lane(found, lane, math.hypot(_lane(y, lane), _lane(z, lane)))
        return found

    return lane_by_lane


def _at(context, builder, kind, array, row):
    """Address of a row, and how many numbers it has."""
    data = context.make_array(kind)(context, builder, array).data
    if kind.ndim == 1:
        return builder.gep(data, [row])
    first = builder.mul(row, ir.Constant(row.type, WIDTH))
    return builder.bitcast(builder.gep(data, [first]), _REALS.as_pointer())


@_emitted
def _take(typingctx, array, row):
    def emit(context, builder, sig, values):
        return builder.load(_at(context, builder, sig.args[0], *values), align=8)

    return (LANES if array.ndim == 2 else types.float64)(array, types.intp), emit


@_emitted
def _put(typingctx, array, row, value):
    def emit(context, builder, sig, values):
        where = _at(context, builder, sig.args[0], *values[:2])
        value = values[2] if sig.args[0].ndim == 1 else _wide(builder, values[2])
        builder.store(value, where, align=8)
        return context.get_dummy_value()

    return types.none(array, types.intp, value), emit


def take(array, row):
    """Number or lanes of a row of contiguous floats, shape (rows,) or (rows, WIDTH)."""
    return array[row]


def put(array, row, value):
    """Write a number or lanes into such a row."""
    array[row] = value


@overload(take)
def _taken(array, row):
    return lambda array, row: _take(array, row)


@overload(put)
def _written(array, row, value):
    return lambda array, row, value: _put(array, row, value)


@inlined
def put_where(array, row, mask, value):
    """Write into such a row where the mask is true."""
    put(array, row, choose(mask, value, take(array, row)))


@compiled
def rows_of_lanes(count):
    """Zeros, shape (count, WIDTH), each row in a line of the cache of its own."""
    size = count * WIDTH
    room = np.zeros(size + WIDTH)
    first = (WIDTH - room.ctypes.data // 8 % WIDTH) % WIDTH
    return room[first : first + size].reshape(count, WIDTH)
