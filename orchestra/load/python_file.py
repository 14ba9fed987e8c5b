"""Launch files in Python: the file is run, and its `generate_launch_description` says what there is to visit.

A file is run anew each time it is included, as upstream does: what it makes belongs to that visit. Bytecode is never
written beside it.
"""

from __future__ import annotations

import sys
from contextlib import contextmanager
from importlib.machinery import ModuleSpec
from types import CoroutineType, FunctionType, ModuleType
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.columns import keep_plain
from orchestra.compat.explanation import told
from orchestra.compat.idle_names import has_idle_actions
from orchestra.compat.launch.launch_description import LaunchDescription
from orchestra.compat.launch.launch_description_entity import LaunchDescriptionEntity
from orchestra.compat.looks import Compiled, has_doubled_keys, tell_misused, tell_slips
from orchestra.compat.place import show
from orchestra.compat.refusing import collecting, is_lost
from orchestra.compat.reported import CARRYING
from orchestra.compat.seam import connection
from orchestra.compat.wrong import WrongType
from orchestra.description.actions.opaque import OpaqueAction
from orchestra.description.launch import Description
from orchestra.description.text import Template, Words
from orchestra.errors import Code, Problems, Severity
from orchestra.fields import replace
from orchestra.load.tested import description_in
from orchestra.location import Location, displayed, point
from orchestra.nearest import nearest
from orchestra.witness.looking import read as content
from orchestra.witness.observing import observer
from orchestra.witness.once import real

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from types import CodeType

    from orchestra.compat.carrying_on import CarryingOn
    from orchestra.errors import Problem
    from orchestra.location import Span

FUNCTION: Final = "generate_launch_description"
_MODULE: Final = "python_launch_file"


def read(path: str, problems: Problems, included_from: tuple[Span, ...]) -> Description | None:
    """Run a launch file and return what it describes. What goes wrong is reported; None where nothing comes of it."""
    if "linecache" in sys.modules:  # else nobody can have read the file by it
        sys.modules["linecache"].checkcache(path)
    file = displayed(path, real)
    at = point(file)
    try:
        source = _source(path)
    except OSError as error:  # what code raises when it opens files of its own is another thing
        location = Location(included_from[0], included_from[1:]) if included_from else Location(at)
        problems.error(Code.UNREADABLE_FILE, f"cannot read {file}: {error.strerror}", location)
        return None
    ran = _ran(path, source, at, problems, included_from)
    if ran is None:
        return None
    module, made, at, compiled = ran
    if is_lost(made):
        return None
    if isinstance(made, LaunchDescription):
        _look_for_slips(module, compiled, path, problems, included_from)
        return _described(path, file, made)
    if getattr(vars(module).get(CARRYING), "has_guessed", False):
        return None
    tell_misused(compiled, path, problems, included_from)
    message, *notes = _undescribed(module, made, file)
    where, meant = _undescribed_at(module, made, at)
    problems.error(
        Code.NO_DESCRIPTION, message, Location(where, included_from), suggestion=meant, notes=notes
    )
    instead = _instead(module, made, problems, included_from)
    return None if instead is None else _described(path, file, instead)


def _described(path: str, file: str, made: LaunchDescription) -> Description:
    at = point(file)
    opaque = OpaqueAction.made(at, {"target": made}, made)
    return Description(path, file, (opaque,), _deprecated(made, at))


def _instead(
    module: ModuleType, made: object, problems: Problems, included_from: tuple[Span, ...]
) -> LaunchDescription | None:
    """Return the launch description that was meant: what is wrong in it is told as well."""
    with collecting(problems, included_from), _in_place(module):
        if made is module:
            meant = _meant(module)
            try:
                made = None if meant is None or _needs_arguments(meant) else meant()
            except Exception:  # noqa: BLE001 - what is wrong with the file has been told
                return None
        elif made is None:
            made = _unreturned(module)
        if isinstance(made, LaunchDescription):
            return made
        actions: Any = made if isinstance(made, list | tuple) else [made]
        if actions and all(isinstance(item, LaunchDescriptionEntity) for item in actions):
            return LaunchDescription(actions)
    return None


def _unreturned(module: ModuleType) -> Any:  # noqa: ANN401 - whatever the user's function returns
    """Return what the file's function makes and does not return; None where that is not plain."""
    from orchestra.compat.missing_return import code_with_return  # noqa: PLC0415 - only mistakes need it

    path = str(module.__file__)
    code = code_with_return(path, FUNCTION)
    if code is None:
        return None
    try:
        return _made(load_module(path, code, {}))
    except Exception:  # noqa: BLE001 - what is wrong with the file has been told
        return None


def _ran(
    path: str, source: bytes, at: Span, problems: Problems, included_from: tuple[Span, ...]
) -> tuple[ModuleType, Any, Span, Compiled] | None:
    """Return the module of a file, what it describes, and where, and its code.

    None where it is not known how to go on.
    """
    carrying: CarryingOn | None = None
    code: Compiled | None = None
    ran: Compiled | None = None  # the file as it is, where it is Python
    known: dict[str, Any] = {}
    while True:
        try:
            with collecting(problems, included_from):
                code = ran = connection().code(path, source) if code is None else code
                _get_ready(path, at, code)
                module = load_module(path, code.code, known)
                at = _definition(module, at)
                with _in_place(module):
                    return module, _made(module), at, code
        except KeyboardInterrupt:
            raise
        except BaseException as error:  # noqa: BLE001 - the boundary of user code
            # Here, because only mistakes need it, and what it imports.
            from orchestra.compat.carrying_on import CarryingOn  # noqa: PLC0415

            if code is None:
                _get_ready(path, at)
            carrying = carrying or CarryingOn(path, included_from, at)
            found = carrying.problems(error)
            problems.extend(found if included_from else map(_grave, found))
            mended, known = carrying.code(error), {CARRYING: carrying}
            code = None if mended is None else Compiled(mended, source, {})
            if code is None:
                from orchestra.compat.calls_behind import tell_keywords  # noqa: PLC0415 - as above

                tell_keywords(path, FUNCTION, problems, included_from)
                if ran is not None:
                    tell_misused(ran, path, problems, included_from)
                    tell_slips(ran, path, problems, included_from)
                return None


def _get_ready(path: str, at: Span, code: Compiled | None = None) -> None:
    connection().prepare(code)
    show(path, at.file)


def _look_for_slips(
    module: ModuleType, compiled: Compiled, path: str, problems: Problems, included_from: tuple[Span, ...]
) -> None:
    """Warn of what code does in vain, or surely does not mean: actions that are added to nothing, and the like."""
    if compiled.is_sound:
        return
    tell_misused(compiled, path, problems, included_from)
    # Here, because only what may be a mistake needs them.
    may, source = compiled.may, compiled.source
    if may("idle") and has_idle_actions(module, source):
        from orchestra.compat.unadded import tell_unadded  # noqa: PLC0415

        tell_unadded(path, problems, included_from)
    if may("doubled") and has_doubled_keys(module, source):
        from orchestra.compat.doubled_keys import tell_doubled_keys  # noqa: PLC0415

        tell_doubled_keys(path, problems, included_from)
    tell_slips(compiled, path, problems, included_from)


def _undescribed_at(module: ModuleType, made: object, at: Span) -> tuple[Span, str | None]:
    """Return where it stands that nothing is described, and what should stand there."""
    # Here, because only mistakes need it, and what it imports.
    from orchestra.compat.functions import described_by, name_of, returned_by  # noqa: PLC0415

    if made is module:
        meant = _meant(module)
        span = None if meant is None else name_of(meant)
        return (at, None) if span is None else (span, FUNCTION)
    generate = getattr(module, FUNCTION, None)
    if isinstance(made, CoroutineType):
        return name_of(generate) or at, None
    returned = returned_by(generate, made)
    return (at, None) if returned is None else (returned.whole, described_by(returned, made))


def _meant(module: ModuleType) -> FunctionType | None:
    """Return the function of the file whose name is a slip for the one that is wanted."""
    functions = (item for item in vars(module).values() if isinstance(item, FunctionType))
    own = {item.__name__: item for item in functions if item.__code__.co_filename == module.__file__}
    meant = nearest(FUNCTION, own)
    return None if meant is None else own[meant]


def _source(path: str) -> bytes:
    """Return what is in a file."""
    source = content(path)
    keep_plain(path, source)
    observer().read(path, source)
    return source


def _grave(problem: Problem) -> Problem:
    """Return what keeps the file from being read with which all begins: an error, even if only on this host."""
    return replace(problem, severity=Severity.ERROR)


def load_module(path: str, code: CodeType, known: Mapping[str, Any]) -> ModuleType:
    """Run the code of a Python file as a module of its own, which stays out of `sys.modules`; some is `known` to it."""
    module = ModuleType(_MODULE)
    module.__file__ = path
    module.__spec__ = ModuleSpec(_MODULE, None, origin=path)
    vars(module).update(known)
    with _in_place(module):
        exec(code, vars(module))  # noqa: S102 - a launch file is code
    return module


@contextmanager
def _in_place(module: ModuleType) -> Iterator[None]:
    """Have the module in `sys.modules` for a while: dataclasses and pickles look there for the one that they are in."""
    outer = sys.modules.get(_MODULE)
    sys.modules[_MODULE] = module
    try:
        yield
    finally:
        sys.modules.pop(_MODULE, None)
        if outer is not None:
            sys.modules[_MODULE] = outer


def _made(module: ModuleType) -> Any:  # noqa: ANN401 - whatever the user's function returns
    """Return what the file's function returns, or the module where it has no such function."""
    generate = getattr(module, FUNCTION, None)
    if generate is not None:
        if _needs_arguments(generate):
            from orchestra.compat.functions import name_of  # noqa: PLC0415 - only mistakes need it

            told_so = f"{FUNCTION} is called without arguments: an OpaqueFunction is given the context"
            raise WrongType(told_so, at=name_of(generate))
        return generate()
    tested = description_in(module)
    return module if tested is None else tested


def _needs_arguments(function: Any) -> bool:  # noqa: ANN401 - whatever has the name
    code = getattr(function, "__code__", None)
    return code is not None and code.co_argcount > len(function.__defaults__ or ())


def _definition(module: ModuleType, otherwise: Span) -> Span:
    """Return where the file's function is defined, the beginning of the file where that is elsewhere."""
    code = getattr(getattr(module, FUNCTION, None), "__code__", None)
    if code is None or code.co_filename != module.__file__:
        return otherwise
    return point(otherwise.file, code.co_firstlineno)


def _undescribed(module: ModuleType, made: object, file: str) -> tuple[str, ...]:
    """Return why nothing is described, and what may help."""
    if made is module:
        meant = _meant(module)
        told_so = f"{file} has no function {FUNCTION}()"
        return (told_so, *([] if meant is None else [f"it has {meant.__name__}()"]))
    if made is None:
        return (f"{FUNCTION}() returns nothing: its `return` is missing",)
    if isinstance(made, CoroutineType):
        made.close()
        return (f"{FUNCTION}() returns a coroutine: it is a function without `async`",)
    message = f"{FUNCTION}() returns a LaunchDescription, not {told(made)}"
    return (message, "put it into LaunchDescription([...])") if isinstance(made, list | tuple) else (message,)


def _deprecated(made: LaunchDescription, at: Span) -> Template | None:
    reason = made.deprecated_reason
    return None if reason is None else Template((Words(reason, at),), reason, at)
