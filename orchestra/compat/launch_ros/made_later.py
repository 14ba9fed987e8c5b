"""What is constructed from its arguments when somebody asks for more than its model."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.launch_ros.plain_texts import read, unnoted
from orchestra.compat.place import Arguments, Place
from orchestra.compat.refusing import Refusing, standing
from orchestra.compat.text import is_changed, shown

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from orchestra.compat.launch_ros.call_code import Form
    from orchestra.compat.launch_ros.plain_texts import Readers
    from orchestra.description.entity import Entity


class Made:
    """The arguments of which the fields of a model are made, with lists and dictionaries of its own.

    `resolved` and `prepared` give what a visit has come to, where that is told; `condition` is that of a component.
    """

    __slots__ = ("_fields", "_form", "_kept", "_shown", "call", "condition", "prepared", "resolved")

    condition: Any

    def __init__(
        self, call: Arguments, kept: Any, fields: dict[str, Any] | None, form: Form | None, *, noted: bool
    ) -> None:
        self.call = call
        self._kept = kept
        self._fields = fields
        self._form = form
        self._shown = shown[0] if noted else None
        self.resolved: Callable[[], tuple[Any, ...]] | None = None
        self.prepared: Callable[[], tuple[Any, ...]] | None = None

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
        if self._shown == shown[0] and not is_changed():
            if fields is None and self._form is not None:
                return self._form.make(self._kept, self.call)
            if fields:
                return fields
        fields = usual.unwritten.copy()
        return None if read(self.given, self.call, usual.readers, fields) is None else fields


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

    def made(self, given: dict[str, Any], place: Place) -> Made | None:
        """Return what an object is made of that is constructed at a place; None where a keyword is not usual."""
        call, names, before = Arguments(place), tuple(given), unnoted[0]
        forms = self._forms.get(names, ())
        for form in forms:
            leaves = form.take(given, call)
            if leaves is not None:
                return Made(call, leaves, None, form, noted=before == unnoted[0])
        fields = self.unwritten.copy()
        kept = read(given, call, self.readers, fields)
        if kept is None or None in [fields[name] for name in self._needed]:
            return None
        if len(forms) < _MOST_FORMS:
            self._learn(names, kept)
        return Made(call, kept, fields, None, noted=before == unnoted[0])

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
    """An object that has a place, and `_plain` until it is constructed."""

    _place: Place

    if not TYPE_CHECKING:  # else any attribute would be one

        def __getattr__(self, name: str) -> Any:
            """Return what the constructor makes."""
            if "_plain" not in vars(self):
                return super().__getattr__(name)
            self._construct()
            return getattr(self, name)

    def _construct(self) -> None:
        """Do what the constructor does; what users have set since stays."""
        own = vars(self)
        made: Made = own.pop("_plain")
        self.__dict__ = {}
        with standing(own["_place"]):
            self.__init__(**made.given)  # type: ignore[misc] # with the keywords of the subclass
        vars(self).update(own)


_GONE: Final[dict[str, Any]] = {}
# A form takes as long to be learned as some fifty calls to be read; there may be no other call of that form.
_EVERY: Final = 4
_ENOUGH: Final = 6
_MANY: Final = 400
_MOST_FORMS: Final = 4
