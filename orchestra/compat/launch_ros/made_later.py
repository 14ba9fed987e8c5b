"""What is constructed from its arguments when somebody asks for more than its model."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar, Final

from orchestra.compat.launch_ros.plain_texts import read, unnoted
from orchestra.compat.place import Arguments, Place
from orchestra.compat.refusing import Refusing, standing
from orchestra.compat.text import is_changed, shown

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from types import CodeType, FrameType

    from orchestra.compat.launch_ros.call_code import Form
    from orchestra.compat.launch_ros.plain_texts import Readers
    from orchestra.description.entity import Entity


class Made(Arguments):
    """The arguments of a call of which the fields of a model are made, with lists and dictionaries of its own.

    They stand where a `kind` was made `at`. `resolved` and `prepared` give what a visit has come to, where that is
    told; `condition` is that of a component.
    """

    __slots__ = ("_fields", "_form", "_kept", "_shown", "at", "condition", "kind", "prepared", "resolved")
    __init__ = object.__init__  # launch files make thousands, which are filled in one place

    at: tuple[CodeType, int]
    kind: type[Any]
    condition: Any
    resolved: Callable[[], tuple[Any, ...]] | None
    prepared: Callable[[], tuple[Any, ...]] | None
    _kept: Any
    _fields: dict[str, Any] | None
    _form: Form | None
    _shown: int | None

    if not TYPE_CHECKING:  # else any attribute would be one

        def __getattr__(self, name: str) -> Any:
            """Return the place, which few calls are asked for; None where no visit has told what it has come to."""
            if name == "place":
                self.place = Place(*self.at, self.kind)
                return self.place
            return None if name in _TOLD else super().__getattr__(name)

    @property
    def given(self) -> dict[str, Any]:
        """The keywords of the call."""
        if self._form is not None:
            self._kept = self._form.given(self._kept)
            self._form = None
        kept: dict[str, Any] = self._kept
        return kept

    def fields(self, usual: Usual) -> dict[str, Any] | None:
        """Return the fields of the model; None where an argument is usual no more.

        They are for the first visit, and take more room than all that is left of it. Few objects have another one: then
        the arguments are read again. So they are where code may have changed what a substitution among them was given.
        """
        fields, self._fields = self._fields, _GONE
        if self._shown == shown[0]:
            if fields is None and self._form is not None:
                fields = self._form.make(self._kept, self)
            elif is_changed():
                fields = None
            if fields:
                return fields
        fields = usual.unwritten.copy()
        return None if read(self.given, self, usual.readers, fields) is None else fields


class Usual:
    """The arguments of one constructor that are of the usual kinds, and the forms of calls that many others have.

    They become a `model`, of which the fields that are `needed` are not None. `series` tells of lists by what a form
    reads them, into which field, and what an empty one is.
    """

    def __init__(
        self,
        model: type[Entity],
        readers: Readers,
        series: Mapping[str, tuple[str, str, Any]],
        needed: tuple[str, ...],
    ) -> None:
        self.model = model
        self.readers = readers
        self.unwritten = model._unwritten()
        self._series = series
        self._needed = needed
        self._forms: dict[tuple[str, ...], list[Form]] = {}
        self._seen: dict[Any, int] = {}

    def of(self, model: type[Entity], readers: Readers, needed: tuple[str, ...]) -> Usual:
        """Return those of a constructor that has the same ones and more, which are read by `readers`."""
        return Usual(model, {**self.readers, **readers}, self._series, needed)

    def made(self, given: dict[str, Any], at: tuple[CodeType, int], kind: type[Any]) -> Made | None:
        """Return what an object is made of that is constructed at a place; None where a keyword is not usual."""
        made: Made = Made()
        made.at = at
        made.kind = kind
        names, before = tuple(given), unnoted[0]
        forms = self._forms.get(names, ())
        for form in forms:
            leaves = form.take(given, made)
            if leaves is not None:
                made._kept = leaves
                made._fields = None
                made._form = form
                made._shown = shown[0] if before == unnoted[0] else None
                return made
        made._fields = fields = self.unwritten.copy()
        made._kept = kept = read(given, made, self.readers, fields)
        if kept is None or None in [fields[name] for name in self._needed]:
            return None
        if len(forms) < _MOST_FORMS:
            self._learn(names, kept)
        made._form = None
        made._shown = shown[0] if before == unnoted[0] else None
        return made

    def _learn(self, names: tuple[str, ...], given: dict[str, Any]) -> None:
        """Learn the form of a call where there have been some like it. Only every few calls are looked at."""
        seen = self._seen
        count = seen[names] = seen.get(names, 0) + 1
        if count % _EVERY or count > _MANY:
            return
        from orchestra.compat.launch_ros.call_forms import form_of, shape  # noqa: PLC0415 - few files have so many

        alike = names, *map(shape, given.values())
        seen[alike] = seen.get(alike, 0) + 1
        if seen[alike] == _ENOUGH:
            self._forms.setdefault(names, []).append(
                form_of(given, self.readers, self._series, self.unwritten)
            )


class MadeLater(Refusing):
    """An object that knows where it was made, and is `_plain` until it is constructed.

    That is for the very class that says what is `_usual`: those of users may look at what the constructor keeps.
    """

    _usual: ClassVar[Usual]

    @classmethod
    def _keeps(cls) -> Callable[[Any, tuple[Any, ...], dict[str, Any]], bool] | None:
        return cls._keep if "_usual" in vars(cls) else None

    def _taken(self, arguments: tuple[Any, ...], keywords: dict[str, Any], caller: FrameType) -> bool:
        if "_usual" not in vars(type(self)):
            return False
        self._made_at = caller.f_code, caller.f_lasti
        if self._keep(arguments, keywords):
            return True
        del self._made_at
        return False

    if not TYPE_CHECKING:  # else any attribute would be one

        def __getattr__(self, name: str) -> Any:
            """Return the place, or what the constructor makes."""
            made = vars(self).get("_plain")
            if made is None:
                return super().__getattr__(name)
            if name == "_place":
                return made.place
            self._construct()
            return getattr(self, name)

    def _is_constructed(self) -> bool:
        """Return whether the constructor has run before: what it has made is to be made anew, not to be kept."""
        return "_place" in self.__dict__

    def _construct(self) -> None:
        """Do what the constructor does; what users have set since stays."""
        own = vars(self)
        made: Made = own.pop("_plain")
        del own["_made_at"]
        self.__dict__ = {}
        with standing(made.place):
            self.__init__(**made.given)  # type: ignore[misc] # with the keywords of the subclass
        vars(self).update(own)


_GONE: Final[dict[str, Any]] = {}
_TOLD: Final = frozenset({"prepared", "resolved"})
# A form takes as long to be learned as some fifty calls to be read; there may be no other call of that form.
_EVERY: Final = 4
_ENOUGH: Final = 6
_MANY: Final = 400
_MOST_FORMS: Final = 4
