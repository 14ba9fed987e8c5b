"""`PathJoinSubstitution`: the parts of a path, joined."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Self, TypeGuard

from orchestra.compat.calls import own
from orchestra.compat.described import described
from orchestra.compat.launch.substitution import Substitution
from orchestra.compat.launch.substitutions.text_substitution import TextSubstitution
from orchestra.compat.parsed import ParsedSubstitution
from orchestra.compat.performed import Concatenated
from orchestra.compat.place import IN_CONSTRUCTOR, here
from orchestra.compat.text import LIST, joined, known_as, normalized, perform_alike
from orchestra.compat.wrong import WrongType
from orchestra.description.written import called, escaped

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from orchestra.compat.place import Step
    from orchestra.compat.text import Sub

# What gives an absolute path without a slash at its end.
_FOLDERS = frozenset({"dirname", "find-pkg-prefix", "find-pkg-share"})


class PathJoinSubstitution(ParsedSubstitution):
    """A path of its components; an absolute one discards those before it, as `os.path.join` does.

    A component that is a list is concatenated first, as in newer ROS releases. Raises `TypeError` without components.
    """

    _name = "path-join"
    __substitutions: list[Substitution] = own()

    def __init__(self, substitutions: Iterable[Sub]) -> None:
        self._place = here(self, IN_CONSTRUCTOR)
        components = [_component(item) for item in _listed(substitutions)]
        if not components:
            raise WrongType("a PathJoinSubstitution needs at least one component", path=("substitutions",))
        self.__substitutions = components

    def _keep(self, arguments: tuple[Any, ...], keywords: dict[str, Any]) -> bool:
        items = arguments[0] if len(arguments) == 1 and not keywords else None
        if type(items) is not list or not items:
            return False
        known, given = known_as(items), items.copy()
        if known is None:
            known = _known_in(given)
        if known is None or None in known:
            return False
        for item in given:
            for part in item if type(item) is list else (item,):
                if type(part) is not str and type(part) is not TextSubstitution:
                    part._hold(self)
        self._as_given = (given,), keywords
        self._known_as = "path-join", *known
        return True

    @classmethod
    def parse(cls, data: Sequence[Sub]) -> tuple[type[Self], dict[str, Any]]:
        """Return the class and the keywords of its constructor."""
        return cls, {"substitutions": data}

    @property
    def substitutions(self) -> list[Substitution]:
        """The components."""
        return self.__substitutions

    def describe(self) -> str:
        """Return the components and what they are in."""
        return f"PathJoin('{described(self.substitutions)}')"

    def _arguments(self) -> Sequence[Sequence[Substitution]]:
        return [[item] for item in self.substitutions]

    def _raw(self) -> str:
        """Return the path as launch files in YAML and XML have it: with slashes, where to join is no more than that."""
        first, *others = self.substitutions
        texts = [item.text if type(item) is TextSubstitution else None for item in others]
        if not _may_follow(texts, first):
            return super()._raw()
        whole = first._whole()
        return "/".join((first._raw() if whole is None else whole.raw, *map(escaped, texts)))

    def _written(self) -> str:
        given: Any = self._as_given  # which it has as long as it is known
        held = [item if type(item) is list else [item] for item in given[0][0]]
        components: list[Any] = [items[0] if len(items) == 1 else items for items in held]
        first, *others = components
        texts = [item.text if type(item) is TextSubstitution else item for item in others]
        if _may_follow(texts, first):
            return "/".join((first._whole().raw, *map(escaped, texts)))
        return called(self._name, [joined(items, self._place.span)[1] for items in held])

    def _paths(self) -> Sequence[tuple[Step, ...]]:
        return [("substitutions", index) for index in range(len(self.substitutions))]


perform_alike(PathJoinSubstitution)


def _may_follow(others: list[Any], first: Any) -> TypeGuard[list[str]]:
    """Return whether components are texts that may as well follow a slash, and the first one is a folder."""
    if getattr(first, "_name", None) not in _FOLDERS:
        return False
    if any(type(text) is not str or text[:1] in ("", "/") for text in others):
        return False
    return all(text[-1] != "/" for text in others[:-1])


def _known_in(items: list[Any]) -> tuple[Any, ...] | None:
    """Return what components are known as, lists among them; each is copied, for code may change its own later."""
    found: list[Any] = []
    for index, item in enumerate(items):
        held = [item]
        if type(item) is list and item:
            held = items[index] = item.copy()
        known = known_as(held)
        if known is None or None in known:
            return None
        found.append(known[0] if len(known) == 1 else (LIST, *known))
    return tuple(found)


def _component(item: Sub) -> Substitution:
    parts = normalized(item)
    return parts[0] if len(parts) == 1 else Concatenated(parts)


def _listed(substitutions: Sub | Iterable[Sub]) -> Iterable[Sub]:
    """Return the components: a text or a substitution by itself is one."""
    return [substitutions] if isinstance(substitutions, str | Substitution) else substitutions
