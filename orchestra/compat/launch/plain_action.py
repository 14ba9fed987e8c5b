"""Actions that keep their arguments as they are given until somebody asks for more than their model.

Launch files have hundreds of them, and what their constructors keep in upstream's forms is seldom looked at.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from orchestra.compat.building import unchecked
from orchestra.compat.launch.action import ModelledAction
from orchestra.compat.launch.substitution import Substitution
from orchestra.compat.launch_ros.plain_texts import UnusualError, entity, plain_text
from orchestra.compat.place import Arguments, Way, argument
from orchestra.compat.refusing import standing
from orchestra.compat.text import kinds, template
from orchestra.description.text import matched_words

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from orchestra.description.entity import Action as Model
    from orchestra.description.text import Template


class PlainAction(ModelledAction):
    """Such an action. A class that is one says in `_plain` which arguments it has: in order, then those with names."""

    # The number of those that may come without their names, and of each the name.
    _plain: ClassVar[tuple[int, tuple[str, ...]]]
    _plain_names: ClassVar[frozenset[str]]
    _as_given: Any = None

    @classmethod
    def _keeps(cls) -> Callable[[Any, tuple[Any, ...], dict[str, Any]], bool] | None:
        if "_plain" not in vars(cls):
            return None
        cls._plain_names = frozenset(cls._plain[1])
        return _keeping(*cls._plain, cls._is_plain)

    def _is_plain(self, given: dict[str, Any]) -> bool:
        """Return whether the constructor has nothing to say about these arguments; what may change is copied.

        They are those of the class, and all of them, unless a subclass says so.
        """
        for name, value in given.items():
            if type(value) is not str and not is_text(given, name):
                return False
        return given.keys() == type(self)._plain_names

    def _make(self, given: Any) -> None:
        own = vars(self).copy()
        with standing(self._place):
            self.__init__(**given)  # type: ignore[misc] # with the keywords of the subclass
        vars(self).update(own)  # what users have set since stays

    def _plain_model(self) -> Model | None:
        own = self.__dict__
        given = own.get("_as_given")
        if (
            given is None
            or own["_Action__condition"] is not None
            or len(own) - ("_place" in own) != _OF_PLAIN
        ):
            return None
        return self._of_given(given, {}) if self._is_as_described() else None

    def _of_given(self, given: dict[str, Any], condition: dict[str, Any]) -> Model:
        """Return the model of arguments that have been kept, with its condition."""
        call: Any = _new(_Called)
        call._made = self
        kind, fields = self._read(given, call)
        beside = {"span": None, "at": (call, ()), "origin": self}
        made: Model = entity(kind, {**kind._unwritten(), **fields, **condition}, beside)
        return made

    def _to_model(self, common: Mapping[str, Any]) -> Model:
        given = self._as_given
        if given is not None:
            condition = unchecked(common)
            own = vars(self)
            if condition is not None and len(own) - ("_place" in own) == _OF_PLAIN:
                return self._of_given(given, condition)
            with standing(self._place):  # which is known as long as the arguments are
                self._as_given = None
                self._make(given)  # an attribute has been set, or the condition is for the validator
        return self._made(common)

    def _read(self, given: dict[str, Any], call: Arguments) -> tuple[type[Model], dict[str, Any]]:
        """Return the model for arguments that have been kept, and its fields that are written."""
        raise NotImplementedError

    def _made(self, common: Mapping[str, Any]) -> Model:
        """Return the model of what the constructor has made."""
        raise NotImplementedError


class _Called(Arguments):
    """The arguments of the call that an action was made by, which knows where that was."""

    __slots__ = ("_made",)

    _made: PlainAction

    if not TYPE_CHECKING:  # else any attribute would be one

        def __getattr__(self, name: str) -> Any:
            """Return the place, which few calls are asked for."""
            if name == "place":
                self.place = self._made._place
                return self.place
            return super().__getattr__(name)


def _keeping(
    most: int, names: tuple[str, ...], is_plain: Callable[[Any, dict[str, Any]], bool]
) -> Callable[[Any, tuple[Any, ...], dict[str, Any]], bool]:
    """Return what keeps the arguments of a class: it has at hand what the class says, which takes long to look up."""

    def keep(self: Any, arguments: tuple[Any, ...], keywords: dict[str, Any]) -> bool:
        condition = None
        if arguments:
            if len(arguments) > most:
                return False
            given = dict(zip(names, arguments))  # noqa: B905 - fewer than names, and a keyword takes its time
            if keywords:
                if not given.keys().isdisjoint(keywords):
                    return False
                given |= keywords
        else:
            given = keywords.copy()
        if keywords:
            condition = given.pop("condition", None)
        if not is_plain(self, given):
            return False
        self._Action__condition = condition
        self._as_given = given
        return True

    return keep


def is_text(given: dict[str, Any], name: str) -> bool:
    """Return whether an argument is a text, a substitution, or several of both; a list is copied."""
    value = given[name]
    kind = type(value)
    if kind is list or kind is tuple:
        for item in value:
            if type(item) is not str and type(item) not in kinds and not isinstance(item, Substitution):
                return False
        given[name] = [*value]
        return True
    return kind is str or isinstance(value, Substitution)


def text_at(value: Any, call: Arguments, *path: Way) -> Template:
    """Return the text of an argument, or of what it holds."""
    if type(value) is str and "$" not in value and "\\" not in value:
        return matched_words(value, False, call, path)  # type: ignore[arg-type] # its groups are paths
    if type(value) is list and len(value) == 1:
        value = value[0]
    try:
        return plain_text(value, call, path)
    except UnusualError:
        return template(value, argument(call.place, path))


# What an action has as long as it is plain: its arguments, its condition, and where it was called.
_OF_PLAIN = 3
_new = object.__new__
