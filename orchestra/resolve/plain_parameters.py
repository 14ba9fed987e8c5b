"""Parameters that everybody reads alike, which most are: their places are worked out when somebody asks for one."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.description.parts import LateParam, row_of
from orchestra.description.text import Constant, Items, MatchedTemplate, Template, Words
from orchestra.resolve.evaluate import plainly as known_text
from orchestra.resolve.late_values import matched_value
from orchestra.resolve.model import FileParameters, InlineParameter
from orchestra.resolve.rcl.odd_names import may_be_odd
from orchestra.resolve.scalars import number_held
from orchestra.resolve.yaml_scalars import items_alike, read_alike, value_alike

if TYPE_CHECKING:
    from orchestra.description.actions.set_parameter import SetParameter
    from orchestra.description.parts import Param
    from orchestra.resolve.context import Read, Value
    from orchestra.resolve.resolution import Resolution
    from orchestra.values import ParameterValue


def plainly(param: Param, run: Resolution, everywhere: bool, quotes: bool) -> InlineParameter | None:
    """Return a parameter whose value everybody reads alike; None for one that takes a closer look.

    `everywhere`: it is for all nodes. Without `quotes`, a text in quotes is typed as any other.
    """
    reads: tuple[Read, ...] = ()
    if type(param) is LateParam:
        name, written = row_of(param)[:2]
    else:
        called, written = param.name, param.value
        if type(called) is not MatchedTemplate or param.type is not None or param.param is not None:
            return None
        name = called.constant
    if type(written) is not MatchedTemplate:
        if type(param) is LateParam and not isinstance(written, Template):
            value = held(written)
        elif type(written) is Constant and not everywhere:
            value = held(written.value)
        else:
            value = read_at_once(param, quotes)
    elif written.constant is None:
        known = known_text(written, run.context)
        if known is None or known[0][:1] == "/":  # a path may lead nowhere
            return None
        value, reads = value_alike(known[0]), known[1]
    elif written.constant and not (written.quoted and quotes):
        value = value_alike(written.constant)
    else:
        value = written.constant or None
    if value is None or not name or may_be_odd(name):
        return None
    made: Any = _new(InlineParameter)
    made.name = name
    made.value = value
    made.everywhere = everywhere
    made.through = reads
    made._written = param, run.context.included_from  # noqa: SLF001 - it is made here
    parameter: InlineParameter = made
    return parameter


def held(value: ParameterValue) -> ParameterValue | None:
    """Return a value that has its type, where rcl can hold it as it is; None where that takes a closer look."""
    kind = type(value)
    if kind is float or kind is bool:
        return value
    if kind is str:
        return value if value.isprintable() else None  # type: ignore[union-attr] # as it says
    if kind is not tuple:
        return number_held(value)
    kinds: Any = {*map(type, value)}  # type: ignore[arg-type] # as above
    return value if kinds in _ALIKE and None not in map(held, value) else None  # type: ignore[arg-type] # as above


def given_again(written: Template, run: Resolution, *, plain: bool) -> FileParameters | None:
    """Return a file that the same text has named before, with the same variables; None where it takes a look.

    `plain`: it may be one without sections.
    """
    known = named_by(written, run, plain=plain) if run.parameter_files else None
    file = None if known is None else run.parameter_files.get(known[0])
    if known is None or file is None:
        return None
    value = matched_value(file.path, written, run.context.included_from, known[1])  # type: ignore[arg-type]
    return given(file, value, everywhere=False)


def named_by(
    written: Template, run: Resolution, *, plain: bool
) -> tuple[tuple[object, ...], tuple[Read, ...]] | None:
    """Return what decides which file a text names, and what is noted of variables in it; None for other texts.

    A path has to be absolute besides.
    """
    if type(written) is not MatchedTemplate:
        return None
    context, pieces = run.context, written.pieces
    if pieces is None:
        return (written.raw, context.file, plain), ()
    names = pieces.beside if pieces.variables is None else pieces.variables
    if names is None:
        return None
    if not names:
        return (written.raw, context.file, plain), ()
    reads = context.variables.known(names)
    return (
        None
        if reads is None
        else ((written.raw, context.file, plain, *[item.value for item in reads]), reads)
    )


def given(file: FileParameters, value: Value, *, everywhere: bool) -> FileParameters:
    """Return a file as it is given by a value that is its path."""
    made: Any = _new(FileParameters)
    made._written = value  # noqa: SLF001 - it is made here
    made.path, made.sections, made.plain = file.path, file.sections, file.plain
    made.everywhere = everywhere
    made.through = value.through
    made.within, made.sound = file.within, file.sound
    found: FileParameters = made
    return found


_new = object.__new__
_ALIKE: Final = ({str}, {float}, {bool}, {int})


def read_at_once(param: Param | SetParameter, quotes: bool) -> ParameterValue | None:
    """Return a value without a type that everybody reads alike; None where it takes a closer look."""
    value = param.value
    if type(value) is Constant:
        return number_held(value.value) if param.type is None else None
    if param.type is not None or not isinstance(value, Template):
        return items_alike(value) if isinstance(value, Items) and param.type is None else None
    if type(value) is MatchedTemplate:
        text = value.constant
        return None if not text else text if value.quoted and quotes else value_alike(text)
    part = value.parts[0] if len(value.parts) == 1 and not value.faulty else None
    if type(part) is not Words:
        return None
    return part.text if value.quoted and quotes else read_alike(part.text)
