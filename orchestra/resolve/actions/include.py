"""`include`."""

from __future__ import annotations

from contextlib import nullcontext
from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.fields import replace
from orchestra.load.files import PYTHON, has_format, unknown_format
from orchestra.location import displayed, is_python
from orchestra.resolve.arguments import Given, settle
from orchestra.resolve.context import POISON, Poison, Value
from orchestra.resolve.declarations import check_twice
from orchestra.resolve.dependencies import dependencies
from orchestra.resolve.interpret import visit_file
from orchestra.resolve.mentions import is_fixed
from orchestra.resolve.other_kinds import refuse_included_parameters, refused_as_language
from orchestra.resolve.paths import existing_file, may_come
from orchestra.resolve.python.calling import user_code
from orchestra.resolve.python.deferral import Deferred, put_off
from orchestra.resolve.repetition import repeated
from orchestra.resolve.resolution import Frame

if TYPE_CHECKING:
    from orchestra.description.actions.include import Include
    from orchestra.description.entity import Action
    from orchestra.description.launch import Description
    from orchestra.location import Location
    from orchestra.resolve.model import ResolvedDependency
    from orchestra.resolve.resolution import Resolution

# How deep includes and groups may nest: far more than anybody writes, far from the interpreter's recursion limit.
_DEEPEST = 150


def visit(action: Include, run: Resolution) -> None:
    """Visit the actions of another file: in this scope as upstream, in one of its own where that is asked for.

    What is only included when something happens may be a file that something else of the run writes before.
    """
    for _ in repeated(action.for_each, run):
        if action.children is not None:
            with run.scope.nested() if run.flag(action.scoped) is True else nullcontext():
                _include_object(action, action.children, run)
            continue
        value = run.evaluate(action.file)
        if isinstance(value, Value) and run.later and not action.for_each and may_come(value, run):
            put_off(Deferred("action", action), run.at(action.span), run)
            continue
        path = existing_file(value, action.file, "launch file", run) if isinstance(value, Value) else None
        if path is not None and isinstance(value, Value) and not (action.language or has_format(path)):
            run.problems.error(Code.UNKNOWN_FORMAT, unknown_format(displayed(path)), value.location)
            path = None
        elif (
            path is not None
            and isinstance(value, Value)
            and refused_as_language(path, action, value.location, run)
        ):
            path = None
        description = _description(path, action, run) if path is not None else None
        if path is None or description is None:
            if path is not None and isinstance(value, Value):
                refuse_included_parameters(path, value.location, run)
            run.scope.ledger.incomplete = True
            run.scope.left_open |= path is None and run.flag(action.scoped) is not True
            continue
        with run.scope.nested() if run.flag(action.scoped) is True else nullcontext():
            _include(action, path, description, run)


def _include(action: Include, path: str, description: Description, run: Resolution) -> None:
    location = run.place(action)
    before, begun = run.scope.mark(), run.found.size
    given, used = _arguments(action, run)
    frame = _frame(action, path, frozenset(item.name for item in given), run)
    if _is_endless(frame, run):
        run.scope.ledger.incomplete = True
        return
    with run.inside(frame) as ledger:
        visit_file(description, run)
    missing = list(ledger.missing)
    if len(given) < len(action.arg) or (action.faulty and not action.arg):  # what was given is not known
        ledger.missing.clear()
    settle([item for item in given if item.name not in used], description, ledger, run, location)
    for name in missing:
        run.scope.forget(name)
    if path not in run.found.endless:
        run.scope.mark_leaks(before, action.span, wanted=run.found.size == begun)


def _include_object(action: Include, children: tuple[Action, ...], run: Resolution) -> None:
    """Visit what Python code includes without a file: it belongs to the file that the visit is in."""
    _arguments(action, run)
    frames = run.frames
    labels, depends_on = _marks(action, run)
    run.frames = (*frames[:-1], replace(run.frame, labels=labels, depends_on=depends_on))
    run.visit(children, run)
    run.frames = frames


def _marks(action: Include, run: Resolution) -> tuple[tuple[str, ...], tuple[ResolvedDependency, ...]]:
    """Return the labels of every process inside, and what each waits for."""
    label, edges = run.text(action.label), dependencies(action.depends_on, run)
    labels = run.frame.labels + ((label,) if isinstance(label, str) else ())
    return labels, run.frame.depends_on + (() if isinstance(edges, Poison) else edges)


def _frame(action: Include, path: str, given: frozenset[str], run: Resolution) -> Frame:
    labels, depends_on = _marks(action, run)
    return Frame(
        path,
        run.scope,
        run.scope.mark(),
        run.conditions + run.repetitions,
        is_fixed(action.file),
        run.place(action),
        given,
        labels,
        depends_on,
        private=action.for_each is not None or run.flag(action.scoped) is True,
        named_at=None if is_python(action.span) else run.place(action.file),
    )


def _arguments(action: Include, run: Resolution) -> tuple[list[Given], set[str]]:
    """Set the arguments in order, and return them with the names of those that a later one reads, as upstream."""
    given: list[Given] = []
    names: set[str] = set()
    used: set[str] = set()
    before: dict[str, tuple[Location, object]] = {}
    for pair in (*action.arg, *action.let):
        with run.scope.reading() as read:
            name, value = run.evaluate(pair.name), run.evaluate(pair.value)
        used |= read & names
        if isinstance(name, Value):
            if name.text not in read:
                check_twice(name, value, before, run)
            before[name.text] = (name.location, value)
            given.append(Given(name.text, name.location, value.text if isinstance(value, Value) else None))
            names.add(name.text)
            run.scope.set(name.text, value or POISON, run.place(pair.value), "include")
    return given, used


def _description(path: str, action: Include, run: Resolution) -> Description | None:
    """Return what a file says. One in Python says it anew each time, in the environment of this place."""
    location = run.at(action.span)
    chain = (location.span, *location.included_from)
    if action.language == "python" or (action.language is None and path.endswith(PYTHON)):
        with user_code(run, location.span):
            run.descriptions[path] = run.load(path, run.problems, chain, PYTHON)
    elif path not in run.descriptions:
        ending = () if action.language is None else (f".{action.language}",)
        run.descriptions[path] = run.load(path, run.problems, chain, *ending)
    return run.descriptions.get(path)


def _is_endless(frame: Frame, run: Resolution) -> bool:
    """Report a file that includes itself, however far around, and never ends.

    It never does where no condition and no repetition is on the way, nor where everything is set as it was at the
    last time; and it has not ended where it is included too deep to go on. Otherwise it may end, as upstream.
    """
    if frame.path in run.found.endless:
        return True
    around = [index for index, outer in enumerate(run.frames) if outer.path == frame.path]
    if not (around and _repeats(run.frames[around[-1] :], frame, run)) and run.depth < _DEEPEST:
        return False
    run.found.endless.add(frame.path)
    again = (*run.frames, frame)[around[1]] if len(around) > 1 else frame
    deep = f"includes nest {len(run.frames)} files deep, which is too deep"
    message = "the file includes itself without end" if around else deep
    run.problems.error(Code.INCLUDE_CYCLE, message, again.named_at or again.included_at)
    return True


def _repeats(circle: tuple[Frame, ...], frame: Frame, run: Resolution) -> bool:
    """Return whether the way from a file to itself will be gone again; `frame` is the file once more."""
    last = circle[0]
    if frame.choices == last.choices and all(step.fixed for step in (*circle[1:], frame)):
        return True
    return last.scope is run.scope and run.scope.unchanged_since(last.mark)
