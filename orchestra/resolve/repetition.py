"""`for_each`: the same action once per value, each time in a scope of its own."""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING

from orchestra.description.text import Constant, Items, span_of
from orchestra.errors import Code
from orchestra.location import is_python
from orchestra.resolve.context import POISON, Evaluated, Poison, Value

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from orchestra.description.fields import Value as Written
    from orchestra.resolve.resolution import Resolution


def repeated(for_each: Mapping[str, Written | tuple[Written, ...]] | None, run: Resolution) -> Iterator[None]:
    """Yield once per combination of values, the first variable changing slowest; once where nothing is repeated.

    The variables and whatever the body sets are gone after each round. A single text stands for a list with commas
    between the values, so that an argument can carry one.
    """
    if for_each is None:
        yield
        return
    values = [_values(written, run) for written in for_each.values()]
    spans = [span for written in for_each.values() if (span := span_of(written)) is not None]
    for written in for_each.values():
        if isinstance(written, Items) and not written and not is_python(written.span):
            message = "the list is empty: there is nothing to repeat this for"
            run.problems.warning(Code.IDLE_KEY, message, run.at(written.span))
    for combination in product(*values):
        if not run.goes_on(spans[0]):
            return
        run.repetitions += 1
        with run.scope.nested():
            for name, value, span in zip(for_each, combination, spans, strict=True):
                at = value.location if isinstance(value, Value) else run.at(span)
                run.scope.set(name, value, at, "for_each")
            yield
        run.repetitions -= 1


def _values(written: Written | tuple[Written, ...], run: Resolution) -> tuple[Evaluated, ...]:
    if isinstance(written, tuple):
        return tuple(_value(item, run) for item in written)
    value = _value(written, run)
    if isinstance(value, Poison):
        return (POISON,)
    words = (word.strip() for word in value.text.strip("[] ").split(","))
    return tuple(Value(word.strip("'\""), value.location, through=value.through) for word in words if word)


def _value(written: Written, run: Resolution) -> Evaluated:
    if isinstance(written, Constant):
        return Value(str(written.value), run.at(written.span))
    return run.evaluate(written) or POISON
