"""`ready` and `alive`, evaluated."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

from orchestra.description.conditions import STATES
from orchestra.description.ranges import COUNT, INTERVAL, RATE, SOME_SECONDS
from orchestra.description.text import span_of
from orchestra.description.written import escaped
from orchestra.errors import Code
from orchestra.location import is_python
from orchestra.patterns import pattern
from orchestra.resolve.addresses import http_address, tcp_address
from orchestra.resolve.amounts import UnfitError, amount, made, whole
from orchestra.resolve.awaited import (
    OWN,
    ResolvedAlive,
    ResolvedParameterFact,
    ResolvedReady,
    ResolvedStateFact,
    ResolvedTransformFact,
)
from orchestra.resolve.booleans import boolean
from orchestra.resolve.context import POISON, Evaluated, Poison, Value
from orchestra.resolve.parameters import typed
from orchestra.resolve.sound import Sound
from orchestra.resolve.words import split

if TYPE_CHECKING:
    from orchestra.description.conditions import Alive, ParameterFact, Ready, StateFact, TransformFact
    from orchestra.description.text import Template
    from orchestra.resolve.resolution import Resolution


# A backslash that takes the meaning from nothing.
_SINGLE: Final = pattern(r"(?<!\\)((?:\\\\)*)\\(?![\\$]|$)")


def readiness(written: Ready | None, run: Resolution) -> ResolvedReady | Poison | None:
    """Return when a process counts as ready, None where nothing is said."""
    if written is None:
        return None
    sound = Sound()
    found = ResolvedReady(
        log=sound(_pattern(written.log, run)),
        tcp=sound(made(written.tcp, tcp_address, run)),
        http=sound(made(written.http, http_address, run)),
        file=sound(made(written.file, _path, run)),
        command=sound(_command(written.command, written, run)),
        notify=sound(run.flag(written.notify)) is True,
        message=sound(run.evaluate(written.message)),
        topic=sound(run.evaluate(written.topic)),
        node=sound(_node(written.node, run)),
        service=sound(run.evaluate(written.service)),
        action=sound(run.evaluate(written.action)),
        parameter=sound(_parameter(written.parameter, run)),
        lifecycle=sound(_state(written.lifecycle, run)),
        tf=sound(_transform(written.tf, run)),
        timeout=sound(run.number(written.timeout)),
        interval=sound(amount(written.interval, INTERVAL, run)),
    )
    if sound.faulty or written.faulty:
        return POISON
    if found.empty:
        run.problems.error(
            Code.BAD_VALUE, "`ready` waits for nothing: all of it is false", run.at(written.span)
        )
        return POISON
    return found


def life(written: Alive | None, run: Resolution) -> ResolvedAlive | Poison | None:
    """Return the signs of life that a process gives, None where nothing is said."""
    if written is None:
        return None
    sound = Sound()
    found = ResolvedAlive(
        notify=sound(amount(written.notify, SOME_SECONDS, run)),
        message=sound(run.evaluate(written.message)),
        min_rate=sound(amount(written.min_rate, RATE, run)),
        window=sound(amount(written.window, SOME_SECONDS, run)),
        command=sound(_command(written.command, written, run)),
        interval=sound(amount(written.interval, INTERVAL, run)),
        timeout=sound(amount(written.timeout, SOME_SECONDS, run)),
        failures=sound(whole(written.failures, COUNT, run)),
        abort=sound(run.flag(written.abort)) is True,
        location=run.at((written.min_rate or written).span),
    )
    return POISON if sound.faulty or written.faulty else found


def _pattern(written: Template | None, run: Resolution) -> str | Poison | None:
    value = run.evaluate(written)
    if not isinstance(value, Value):
        return value
    try:
        re.compile(value.text)
    except re.error as error:
        plain = re.escape(value.text).replace("\\ ", " ")
        plain = plain if is_python(value.location) else escaped(plain)
        note = f"as plain text it is written: {plain}"
        message = f"this is no regular expression: {error}"
        run.problems.error(Code.BAD_VALUE, message, value.location, notes=(note,))
        return POISON
    _warn_of_backslashes(written, run)
    return value.text


def _warn_of_backslashes(written: Template | None, run: Resolution) -> None:
    """Tell that backslashes which a regular expression needs are taken away, as from any text with substitutions."""
    lost = None if written is None or written.constant is None else _SINGLE.search(written.raw)
    if written is None or lost is None:
        return
    doubled = _SINGLE.sub(r"\1\\\\", written.raw)
    message = f"the backslash before '{written.raw[lost.end()]}' is taken away: it has to stand twice"
    notes = (f"without quotes, or in single ones: {doubled}",)
    run.problems.warning(Code.SURPRISING_SCALAR, message, run.at(written.span), notes=notes)


def _path(text: str) -> str:
    if not text or "\0" in text:
        raise UnfitError("expected a path, found nothing" if not text else "a path cannot hold NUL")
    return text


def _command(
    argv: Template | tuple[Template, ...] | None, part: Ready | Alive, run: Resolution
) -> tuple[str, ...] | Poison | None:
    """Return the words of a command; there must be a first one."""
    if argv is None:
        return None
    words = split(argv, run.context)
    if isinstance(words, Poison):
        return POISON
    if not words or not words[0].text:
        run.problems.error(Code.BAD_VALUE, "the command is empty", run.at(span_of(argv) or part.span))
        return POISON
    return tuple(word.text for word in words)


def _node(written: Template | None, run: Resolution) -> Evaluated | None:
    """Return the name of a node: `true` is its own, `false` is none."""
    value = run.evaluate(written)
    if not isinstance(value, Value) or value.text.strip().lower() not in ("true", "false"):
        return value
    return Value(OWN, value.location) if boolean(value.text) else None


def _of(node: Template | None, run: Resolution, part: ParameterFact | StateFact) -> Evaluated:
    """Return the node that a fact is about, its own where none is named."""
    value = _node(node, run)
    return Value(OWN, run.at(part.span)) if value is None else value


def _parameter(written: ParameterFact | None, run: Resolution) -> ResolvedParameterFact | Poison | None:
    if written is None:
        return None
    node, name = _of(written.node, run, written), made(written.name, _parameter_name, run)
    value = None if written.value is None else typed(written.name.raw, written.value, run)
    if not isinstance(node, Value) or not isinstance(name, str) or isinstance(value, Poison):
        return POISON
    return ResolvedParameterFact(node, name, value)


def _parameter_name(text: str) -> str:
    if not text.strip():
        raise UnfitError("expected the name of a parameter, found nothing")
    return text


def _state(written: StateFact | None, run: Resolution) -> ResolvedStateFact | Poison | None:
    if written is None:
        return None
    node, state = _of(written.node, run, written), run.word(written.state, STATES)
    if not isinstance(node, Value) or not isinstance(state, str):
        return POISON
    return ResolvedStateFact(node, state)


def _transform(written: TransformFact | None, run: Resolution) -> ResolvedTransformFact | Poison | None:
    if written is None:
        return None
    parent, child = made(written.parent, _frame, run), made(written.child, _frame, run)
    if not isinstance(parent, str) or not isinstance(child, str):
        return POISON
    if parent == child:
        message = f"`tf` is between two frames: '{child}' is its own parent"
        run.problems.error(Code.BAD_VALUE, message, run.at(written.child.span))
        return POISON
    return ResolvedTransformFact(parent, child)


def _frame(text: str) -> str:
    """Return the id of a frame (tf2 refuses those that begin with a slash)."""
    if not text or text.startswith("/"):
        reason = f"the id of a frame does not begin with '/': '{text}'" if text else "a frame has an id"
        raise UnfitError(reason, text.lstrip("/") or None)
    return text
