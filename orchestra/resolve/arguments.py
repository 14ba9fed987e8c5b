"""Launch arguments that are given and not known, or wanted and not given: settled where a file ends."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.compat import argv
from orchestra.dataclass import dataclass
from orchestra.errors import Code, Problems, Severity
from orchestra.location import Location, is_python
from orchestra.nearest import is_slip, nearest
from orchestra.resolve.mentions import names_behind, names_in

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from orchestra.description.launch import Description
    from orchestra.resolve.ledger import Ledger
    from orchestra.resolve.resolution import Resolution

# Variables that upstream itself gives a meaning, so that they need no declaration.
_KNOWN = frozenset(
    {"launch-prefix", "launch-prefix-filter", "emulate_tty", "sigterm_timeout", "sigkill_timeout"}
)
_MOST = 64  # names that are taken apart to find one that is meant


@dataclass(frozen=True, slots=True)
class Given:
    """The name of an argument, where it is given, and the value where an include gives it."""

    name: str
    location: Location
    value: str | None = None


def settle(
    given: Sequence[Given],
    description: Description,
    ledger: Ledger,
    run: Resolution,
    included_at: Location | None = None,
) -> None:
    """Report arguments that the file neither declares nor reads, and those that it lacks.

    A lacking one for which a given name is misspelt is reported as that. An include may give more than a file takes,
    as upstream: then what is not a slip for something that it could have given is only a warning, as is all such
    in Python files.
    """
    others = ledger.declared - {item.name for item in given if included_at is not None}
    misspelt = set()
    for item in _unknown(given, description, ledger, run):
        meant = item.value if item.value in others else nearest(item.name, others)
        meant = meant or _of_the_same_words(item.name, others)
        if included_at is None:
            _refuse(item, meant, description, ledger, run)
        else:
            _refuse_in_include(item, meant, description, ledger, run)
        misspelt.add(meant)
    for name, declared_at in ledger.missing.items():
        if name not in misspelt:
            _report_missing(name, declared_at, description, run, included_at)


def _of_the_same_words(name: str, others: Collection[str]) -> str | None:
    """Return the one name that has all words of another one, or some of them and no others: `sim` for `use_sim`."""
    words = set(name.split("_"))
    if len(others) > _MOST:
        return None
    found = [other for other in others if words <= (its := set(other.split("_"))) or its <= words]
    return found[0] if len(found) == 1 else None


def _unknown(
    given: Sequence[Given], description: Description, ledger: Ledger, run: Resolution
) -> tuple[Given, ...]:
    known = ledger.declared | ledger.read | run.found.lost | _KNOWN
    unknown = tuple(
        item for item in given if item.name not in known and not _is_in_code(item.name, description)
    )
    if not unknown or argv.seen():
        return ()
    unvisited, more = names_behind(ledger.hidden, run.context, lambda path: _glance(path, run))
    unvisited |= names_in(description.actions)
    ledger.incomplete |= more
    return tuple(item for item in unknown if item.name not in unvisited)


def _is_in_code(name: str, description: Description) -> bool:
    """Return whether a launch file in Python has a name as a text: a branch that was not taken may read it."""
    if not description.path.endswith(".py"):
        return False
    import linecache  # noqa: PLC0415 - slow, and other launch files have no use for it

    source = "".join(linecache.getlines(description.path))
    return any(f"{quote}{name}{quote}" in source for quote in ("'", '"'))


def _glance(path: str, run: Resolution) -> Description | None:
    """Return a description that is not part of this launch, without a word about its faults.

    None for one in Python: to know it, it would have to be run.
    """
    known = run.descriptions.get(path)
    return known if known is not None or path.endswith(".py") else run.load(path, Problems(), ())


def _refuse(
    item: Given, meant: str | None, description: Description, ledger: Ledger, run: Resolution
) -> None:
    if meant is None and ledger.incomplete:
        message = f"what could be read of {description.file} has no argument '{item.name}'"
        run.problems.warning(Code.UNREAD_ARGUMENT, message, item.location)
        return
    message = f"{description.file} has no argument '{item.name}'"
    run.problems.error(Code.UNKNOWN_ARGUMENT, message, item.location, suggestion=meant)


def _refuse_in_include(
    item: Given, meant: str | None, description: Description, ledger: Ledger, run: Resolution
) -> None:
    message = f"{description.file} has no argument '{item.name}'"
    swapped = ("the name and the value are in each other's place",) if meant == item.value else ()
    slip = meant is not None and is_slip(item.name, meant) and not is_python(item.location)
    if slip or meant in ledger.missing:
        run.problems.error(Code.UNKNOWN_ARGUMENT, message, item.location, suggestion=meant, notes=swapped)
    elif not ledger.incomplete:
        message += " and reads no variable of that name"
        run.problems.warning(Code.UNREAD_ARGUMENT, message, item.location, suggestion=meant, notes=swapped)


def lacking(name: str) -> str:
    """Return what is said of an argument that cannot be without a value."""
    return f"the argument '{name}' has no default and no value"


def _report_missing(
    name: str, declared_at: Location, description: Description, run: Resolution, included_at: Location | None
) -> None:
    message = lacking(name)
    if included_at is None:
        weight = run.inputs.weights.argument
        lacked = f"give '{name}:=VALUE'"
        if weight is not Severity.ERROR:
            lacked = f"what it would give is left open; who launches or includes this gives '{name}:=VALUE'"
        run.problems.weighed(weight, Code.MISSING_ARGUMENT, f"{message}: {lacked}", declared_at)
        return
    note = f"declared at {declared_at}"
    message = f"{message}: {description.file} needs one from its include"
    run.problems.error(Code.MISSING_ARGUMENT, message, included_at, notes=(note,))
