"""Remapping rules as written, evaluated and checked."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.description.parts import LateRemap, row_of
from orchestra.description.text import MatchedTemplate
from orchestra.errors import Code
from orchestra.location import is_python
from orchestra.resolve.context import Value
from orchestra.resolve.late_values import matched_value
from orchestra.resolve.model import ResolvedRemap, new_remap
from orchestra.resolve.names import InvalidName, mended, rule_name_fault
from orchestra.resolve.refusals import refuse_value
from orchestra.resolve.remaps import read_rule

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.description.parts import Remap
    from orchestra.description.text import Template
    from orchestra.location import Span
    from orchestra.resolve.resolution import Resolution


class LateRule(ResolvedRemap):
    """A rule by its two texts: values of literal ones are made when somebody asks for them; equal to any other."""

    __slots__ = ("_written", "texts")

    _written: tuple[Remap, tuple[Span, ...]]
    texts: tuple[str, str]

    if not TYPE_CHECKING:  # else any attribute would be one

        def __getattr__(self, name: str) -> Value:
            """Return a side."""
            if name not in ("source", "target"):
                raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")
            written, chain = self._written
            side = written.from_ if name == "source" else written.to
            made = matched_value(side.constant, side, chain)
            object.__setattr__(self, name, made)
            return made

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, ResolvedRemap):
            return NotImplemented
        return self.source == other.source and self.target == other.target

    __hash__ = ResolvedRemap.__hash__

    def __reduce__(self) -> Any:  # noqa: ANN401 - what makes it, and of what
        return ResolvedRemap, (self.source, self.target)


def remap(source: Template, target: Template, run: Resolution) -> ResolvedRemap | None:
    """Return a rule, None where it cannot be one (which has been reported)."""
    left, right = run.evaluate(source), run.evaluate(target)
    if not isinstance(left, Value) or not isinstance(right, Value):
        return None
    try:
        read_rule(left.text, right.text)
    except InvalidName as error:
        _refuse(left, right, error, run)
        return None
    if left.text == right.text and _are_written_alike(source, target):
        message = f"'{left.text}' is remapped to itself"
        run.problems.warning(Code.IDLE_REMAP, message, right.location)
    return new_remap(left, right)


def _refuse(left: Value, right: Value, error: InvalidName, run: Resolution) -> None:
    """Report a side that no rule can have."""
    value = left if error.name == left.text else right
    message = f"'{error.name}' cannot be a name: {error.fault.reason}"
    name = value.text.partition(":=")[0] if value is left else value.text
    meant = name if rule_name_fault(name) is None else mended(name, rule_name_fault)
    refuse_value(value, run.problems, Code.BAD_NAME, message, meant=meant)


def _are_written_alike(source: Template, target: Template) -> bool:
    """Return whether two texts of a file are the same words."""
    written = source.constant
    return written is not None and written == target.constant and not is_python(source.span)


def remaps(written: Sequence[Remap], run: Resolution) -> tuple[tuple[ResolvedRemap, ...], bool]:
    """Return the rules of a node in order, and whether all of them are sound."""
    if not written:
        return (), True
    rules = []
    for item in written:
        rule = _known(item, run) if type(item) is LateRemap else _plainly(item, run)
        if rule is not None:
            rules.append(rule)
    return tuple(rules), len(rules) == len(written)


def _known(written: LateRemap, run: Resolution) -> ResolvedRemap | None:
    """Return a rule by its two sides."""
    source, target = row_of(written)[:2]
    is_text = type(target) is MatchedTemplate and target.constant is None
    if type(source) is not str or not (type(target) is str or is_text):
        return _plainly(written, run)
    return _rule(written, source, target, run)


def _plainly(written: Remap, run: Resolution) -> ResolvedRemap | None:
    """Return a rule; the value of a literal text is made when somebody asks for it."""
    from_, to = written.from_, written.to
    if type(from_) is not MatchedTemplate or type(to) is not MatchedTemplate:
        return remap(from_, to, run)
    source, target = from_.constant, to.constant
    if source is None or source == target:
        return remap(from_, to, run)
    return _rule(written, source, to if target is None else target, run)


def _rule(written: Remap, source: str, target: str | Template, run: Resolution) -> ResolvedRemap | None:
    """Return a rule of a literal text and another text."""
    made: Any = _new(LateRule)
    if type(target) is not str:
        value = run.evaluate(target)  # type: ignore[arg-type] # as it says
        if not isinstance(value, Value):
            return None
        made.target, target = value, value.text
    made.texts = source, target
    made._written = written, run.context.included_from  # noqa: SLF001 - it is made here
    rule: LateRule = made
    try:
        read_rule(source, target)
    except InvalidName as error:
        _refuse(rule.source, rule.target, error, run)
        return None
    return rule


_new: Final = object.__new__
