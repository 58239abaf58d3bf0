"""Numbers side by side in compiled code: LLVM's own vectors behind Python's operators.

Code that keeps to arithmetic, comparisons, `min`, `max`, `abs`, some of `math` and the functions
below stands for one number and for `WIDTH` of them alike, with the same digits: each operation is
that of a single number, fused are `plus` and `minus` alone, nothing is summed across. Its memory
has rows: of one number each in an array of one dimension, of `WIDTH` in one of shape (rows, WIDTH).
"""

import math
import operator

import numpy as np
from llvmlite import ir
from numba.core import cgutils, types
from numba.core.imputils import lower_builtin, lower_cast
from numba.core.typeconv import Conversion
from numba.core.typing.templates import (
    AbstractTemplate,
    ConcreteTemplate,
    infer_global,
    signature,
)
from numba.extending import models, register_model

from rocking.runtime.compiled import inlined

WIDTH = 8  # as many as one AVX-512 register holds; narrower machines take several for one
_REALS = ir.VectorType(ir.DoubleType(), WIDTH)
_TRUTHS = ir.VectorType(ir.IntType(1), WIDTH)
_BITS = ir.IntType(WIDTH)


class _Many(types.Type):
    """`WIDTH` of a kind; a single one where they are wanted counts for all of them."""

    single: types.Type

    def can_convert_from(self, typingctx, other):
        """Widen a single one."""
        return Conversion.promote if other is self.single else None

    def unify(self, typingctx, other):
        """As many, where another branch has a single one."""
        return self if other is self.single else None


class Lanes(_Many):
    """`WIDTH` floats."""

    single = types.float64


class Mask(_Many):
    """`WIDTH` truth values."""

    single = types.boolean


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
    inserted = builder.insert_element(nothing, value, first)
    everywhere = ir.Constant(ir.VectorType(ir.IntType(32), WIDTH), [0] * WIDTH)
    return builder.shuffle_vector(inserted, nothing, everywhere)


@lower_cast(types.float64, Lanes)
@lower_cast(types.boolean, Mask)
@lower_cast(types.BooleanLiteral, Mask)
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
    ((math.pow,), _call("pow", 2)),
):
    for _function in _functions:
        _defined(_function, LANES, _PAIRS, _emit)
for _function, _sign in ((operator.lt, "<"), (operator.le, "<="), (operator.gt, ">")):
    _defined(_function, MASK, _PAIRS, _compare(_sign))
_defined(operator.ge, MASK, _PAIRS, _compare(">="))
_defined(abs, LANES, [(LANES,)], _call("fabs", 1))
_defined(math.sqrt, LANES, [(LANES,)], _call("sqrt", 1))
_defined(operator.neg, LANES, [(LANES,)], ir.IRBuilder.fneg)
for _function, _emit in ((operator.and_, ir.IRBuilder.and_), (operator.or_, ir.IRBuilder.or_)):
    _defined(_function, MASK, [(MASK, MASK), (MASK, types.boolean), (types.boolean, MASK)], _emit)
_defined(operator.invert, MASK, [(MASK,)], ir.IRBuilder.not_)


def _emitted(typed, emit):
    """Let compiled code have what is emitted for a function; Python calls the function itself.

    Nothing is compiled for it, as it would be for every kind of numbers of an overload.

    Parameters
    ----------
    typed : callable
        From the typing context and the types of the arguments: type of the result, and of the
        arguments as the emitter takes them.
    emit : callable
        Takes the target's context, builder, signature and the values.
    """

    def decorate(function):
        class Typing(AbstractTemplate):
            key = function

            def generic(self, args, kws):
                result, *wanted = typed(self.context, *map(types.unliteral, args))
                return signature(result, *wanted)

        infer_global(function, types.Function(Typing))

        @lower_builtin(function, *[types.Any] * function.__code__.co_argcount)
        def lower(context, builder, sig, values):
            return emit(context, builder, sig, *values)

        return function

    return decorate


def _as_many(kind, number):
    """Type of a float or truth value, of as many as a number or mask stands for."""
    if not isinstance(number, Lanes | Mask):
        return kind
    return MASK if isinstance(kind, types.Boolean | Mask) else LANES


def _of_choice(context, mask, yes, no):
    kind = _as_many(context.unify_types(yes, no), mask)
    return kind, mask, kind, kind


@_emitted(_of_choice, lambda context, builder, sig, *values: builder.select(*values))
def choose(mask, yes, no):
    """`yes` where the mask is true, else `no`; both are computed."""
    return yes if mask else no


def _of_product(context, number, one, other):
    wide = any(isinstance(kind, Lanes) for kind in (number, one, other))
    return (LANES if wide else types.float64,) * 4


def _fused(negate):
    """Emit number ± one·other, which is rounded once."""

    def emit(context, builder, sig, number, one, other):
        kind = number.type
        name = f"llvm.fma.v{WIDTH}f64" if isinstance(kind, ir.VectorType) else "llvm.fma.f64"
        fused = ir.FunctionType(kind, [kind] * 3)
        one = builder.fneg(one) if negate else one
        intrinsic = cgutils.get_or_insert_function(builder.module, fused, name)
        return builder.call(intrinsic, (one, other, number))

    return emit


@_emitted(_of_product, _fused(False))
def plus(number, one, other):
    """number + one·other, rounded once: one operation where the processor has it."""
    return number + one * other


@_emitted(_of_product, _fused(True))
def minus(number, one, other):
    """number − one·other, rounded once."""
    return number - one * other


@inlined
def dot(row, column):
    """Sum of products of three numbers each."""
    return plus(plus(row[0] * column[0], row[1], column[1]), row[2], column[2])


@inlined
def less_dot(number, row, column):
    """A number less the sum of products of three numbers each."""
    rest = minus(minus(number, row[0], column[0]), row[1], column[1])
    return minus(rest, row[2], column[2])


def _stack_in_lines(context, builder, sig):
    builder.function.attributes.alignstack = 8 * WIDTH
    return context.get_dummy_value()


@_emitted(lambda context: (types.none,), _stack_in_lines)
def align_stack():
    """Let lanes that the function it stands in keeps on its stack begin a line of the cache.

    Elsewhere most of them would lie across two lines, which costs a step of courses up to a tenth.
    """


def _bits(sign, bits):
    """Emit how the bits of a mask are held against others; one truth value is itself."""

    def emit(context, builder, sig, mask):
        if not isinstance(sig.args[0], Mask):
            return mask
        return builder.icmp_unsigned(sign, builder.bitcast(mask, _BITS), ir.Constant(_BITS, bits))

    return emit


def _of_mask(context, mask):
    return types.boolean, mask


@_emitted(_of_mask, _bits("!=", 0))
def some(mask):
    """Whether the mask is true anywhere."""
    return mask


@_emitted(_of_mask, _bits("==", 2**WIDTH - 1))
def every(mask):
    """Whether the mask is true everywhere."""
    return mask


def _of_like(context, value, number):
    kind = _as_many(value, number)
    return kind, kind, number


@_emitted(_of_like, lambda context, builder, sig, value, number: value)
def like(value, number):
    """`value`, a float or truth value, as many as `number` stands for."""
    return value


def _whether_one(context, builder, sig, number):
    return ir.Constant(ir.IntType(1), not isinstance(sig.args[0], Lanes))


@_emitted(lambda context, number: (types.boolean, number), _whether_one)
def alone(number):
    """Whether a number stands for itself alone; a constant to the compiler."""
    return True


def _first(context, builder, sig, number):
    if not isinstance(sig.args[0], Lanes):
        return number
    return builder.extract_element(number, ir.Constant(ir.IntType(32), 0))


@_emitted(lambda context, number: (types.float64, number), _first)
def lone(number):
    """A number that stands for itself alone; of lanes the first."""
    return number


def _at(context, builder, kind, array, row):
    """Address of a row."""
    data = context.make_array(kind)(context, builder, array).data
    if kind.ndim == 1:
        return builder.gep(data, [row])
    first = builder.mul(row, ir.Constant(row.type, WIDTH))
    return builder.bitcast(builder.gep(data, [first]), _REALS.as_pointer())


def _of_row(array):
    """Type of what a row has."""
    return LANES if array.ndim == 2 else array.dtype


def _load(context, builder, sig, array, row):
    return builder.load(_at(context, builder, sig.args[0], array, row), align=8)


def _store(context, builder, sig, array, row, value):
    builder.store(value, _at(context, builder, sig.args[0], array, row), align=8)
    return context.get_dummy_value()


@_emitted(lambda context, array, row: (_of_row(array), array, types.intp), _load)
def take(array, row):
    """Number or lanes of a row of contiguous floats, shape (rows,) or (rows, WIDTH)."""
    return array[row]


@_emitted(lambda context, array, row, _: (types.none, array, types.intp, _of_row(array)), _store)
def put(array, row, value):
    """Write a number or lanes into such a row."""
    array[row] = value


@inlined
def put_where(array, row, mask, value):
    """Write into such a row where the mask is true."""
    put(array, row, choose(mask, value, take(array, row)))


def rows_of_lanes(count):
    """Zeros, shape (count, WIDTH), each row in a line of the cache of its own."""
    size = count * WIDTH
    room = np.zeros(size + WIDTH)
    first = (WIDTH - room.ctypes.data // 8 % WIDTH) % WIDTH
    return room[first : first + size].reshape(count, WIDTH)
