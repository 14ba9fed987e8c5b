"""Processes whose arguments are of the usual kinds: one walk through them makes the fields of the model.

Launch files have hundreds of such processes, and what the constructor keeps of them in upstream's forms is seldom
looked at. It is made when somebody does. Nothing is read here that the constructor would read otherwise, and whatever
it might have something to say about is left to it.
"""

from __future__ import annotations

import math
import os
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.building import unchecked
from orchestra.compat.launch.actions.execute_local import OVERRIDE, ExecuteLocal
from orchestra.compat.launch_ros.made_later import Made, MadeLater, Usual
from orchestra.compat.launch_ros.plain_texts import (
    UnusualError,
    copied,
    divisible,
    entity,
    left,
    plain_text,
    standing_at,
    word,
)
from orchestra.compat.place import Arguments, Key, ValueOf
from orchestra.description.outputs import OUTPUTS, PLACES, STREAMS
from orchestra.description.parts import Pair

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from orchestra.compat.launch_ros.plain_texts import Readers
    from orchestra.description.entity import Action as Model


class PlainProcess(MadeLater, ExecuteLocal):
    """What a process is before somebody asks for more than its model: then it is constructed from its arguments."""

    def _keep(self, arguments: tuple[Any, ...], keywords: dict[str, Any]) -> bool:
        if arguments or self._is_constructed() or _says_output(os.environ):
            return False
        made = self._usual.made(keywords, self._made_at, type(self))
        if made is None:
            return False
        self._plain = made
        self._Action__condition = keywords.get("condition")
        return True

    def _construct(self) -> None:
        made: Made = vars(self)["_plain"]
        super()._construct()
        if made.prepared is not None:
            self._prepared_by(made.prepared)

    def _prepared_by(self, details: Callable[[], tuple[Any, ...]]) -> None:
        made: Made | None = vars(self).get("_plain")
        if made is not None:
            made.prepared = details
        else:
            super()._prepared_by(details)

    def _plain_model(self) -> Model | None:
        own = self.__dict__
        made: Made | None = own.get("_plain")
        if made is None or len(own) != _OF_PLAIN or own["_Action__condition"] is not None:
            return None
        usual = self._usual
        fields = made.fields(usual) if self._is_as_described() else None
        if fields is None:
            return None
        model: Model = entity(usual.model, fields, {"span": None, "at": (made, ()), "origin": self})
        return model

    def _to_model(self, common: Mapping[str, Any]) -> Model:
        own = vars(self)
        made: Made | None = own.get("_plain")
        if made is not None:  # nobody has asked for more
            if len(own) == _OF_PLAIN:  # nor set something
                model: Model | None = _model(made, self._usual, common)
                if model is not None:
                    return model
            self._construct()
        return super()._to_model(common)


def _says_output(environ: Any) -> bool:
    """Return whether the environment says where the output of all processes goes."""
    try:
        known = environ._data  # the table itself: to go through `os.environ` takes ten times as long
    except AttributeError:
        return OVERRIDE in environ
    return _OVERRIDE in known


def _model(made: Made, usual: Usual, common: Mapping[str, Any]) -> Any:
    """Return the model; `common` are the fields that every action has. None where an argument is usual no more."""
    fields = made.fields(usual)
    if fields is None:
        return None
    condition = unchecked(common)
    if condition is None:
        said = {name: value for name, value in fields.items() if value is not None}
        return usual.model.at(made.place.span, **said, **common)
    if condition:
        fields |= condition
    return entity(usual.model, fields, standing_at(made, (), common["origin"]))


def _prefix(name: str, value: Any, call: Arguments, fields: dict[str, Any], kept: dict[str, Any]) -> None:
    """Read the words before the command, which a text is taken apart into."""
    if type(value) is str:
        fields["launch_prefix"] = divisible(value, call.span((name,)))
    else:
        word("launch_prefix", name, value, call, fields, kept)


def words_of(field: str, *, empty: Any) -> Callable[..., None]:
    """Return what reads a list of texts, of which each is a word."""

    def read(name: str, value: Any, call: Arguments, fields: dict[str, Any], kept: dict[str, Any]) -> None:
        if type(value) is not list:
            raise UnusualError
        fields[field] = (
            tuple([plain_text(item, call, (name, index)) for index, item in enumerate(value)]) or empty
        )
        kept[name] = copied(value)

    return read


def _flag(name: str, value: Any, call: Arguments, fields: dict[str, Any], kept: dict[str, Any]) -> None:
    if value is False:
        fields[name] = plain_text("false", call, (name,))
    else:
        known_flag(name, value, call, fields, kept)


def known_flag(name: str, value: Any, call: Arguments, fields: dict[str, Any], kept: dict[str, Any]) -> None:
    """Read a truth value of which nothing is said where it is false."""
    del kept
    if value is True:
        fields[name] = plain_text("true", call, (name,))
    elif value is not False:
        raise UnusualError


def _respawn(name: str, value: Any, call: Arguments, fields: dict[str, Any], kept: dict[str, Any]) -> None:
    """Read whether a process is started again: a truth value, or what substitutions come to."""
    if type(value) is bool or type(value) is str:
        known_flag(name, value, call, fields, kept)
        return
    word(name, name, value, call, fields, kept)
    if fields[name].constant is not None:
        raise UnusualError


def _retries(name: str, value: Any, call: Arguments, fields: dict[str, Any], kept: dict[str, Any]) -> None:
    del kept
    if type(value) is not int or value < -1:
        raise UnusualError
    if value >= 0:
        fields[name] = plain_text(repr(value), call, (name,))


def _seconds(name: str, value: Any, call: Arguments, fields: dict[str, Any], kept: dict[str, Any]) -> None:
    """Read a time after which another signal follows, which is a text."""
    del kept
    if type(value) is not str or not value.isdecimal() or not value.isascii():
        raise UnusualError
    fields[name] = plain_text(value, call, (name,))


def _on_exit(name: str, value: Any, call: Arguments, fields: dict[str, Any], kept: dict[str, Any]) -> None:
    """Read the action that ends the run: nothing else may be done then, and no reason be given."""
    from orchestra.compat.launch.actions.shutdown_action import Shutdown  # noqa: PLC0415 - few nodes end a run

    ending = value[0] if type(value) is list and len(value) == 1 else value
    if type(ending) is not Shutdown or ending._says_more:
        raise UnusualError
    fields[name] = divisible("shutdown", call.place.span)
    kept[name] = copied(value)


def _delay(name: str, value: Any, call: Arguments, fields: dict[str, Any], kept: dict[str, Any]) -> None:
    del kept
    if type(value) not in _NUMBERS or value < 0 or not math.isfinite(value):
        raise UnusualError
    fields[name] = plain_text(repr(value), call, (name,))


def _output(name: str, value: Any, call: Arguments, fields: dict[str, Any], kept: dict[str, Any]) -> None:
    """Read where the output goes: one word, what a substitution comes to, or one place for each stream."""
    if type(value) is dict:
        if not (value and _STREAMS.issuperset(value) and all(map(_is_place, value.values()))):
            raise UnusualError
        places = value.items()
        fields[name] = {stream: (plain_text(place, call, (name, stream)),) for stream, place in places}
        kept[name] = value.copy()
        return
    if type(value) is str and value not in OUTPUTS:
        raise UnusualError
    fields[name] = made = plain_text(value, call, (name,))
    if type(value) is not str and made.constant is not None:
        raise UnusualError


def _is_place(value: Any) -> bool:
    return type(value) is str and value in PLACES


def _environment(field: str) -> Callable[..., None]:
    """Return what reads names of variables with their values."""

    def read(name: str, value: Any, call: Arguments, fields: dict[str, Any], kept: dict[str, Any]) -> None:
        if type(value) is not dict:
            raise UnusualError
        beside, keys, texts = standing_at(call, (name,)), Arguments(call.place), Arguments(call.place)
        fields[field] = tuple(
            [
                entity(
                    Pair,
                    {
                        "name": plain_text(key, keys, (name, Key(index))),
                        "value": plain_text(text, texts, (name, ValueOf(index))),
                    },
                    beside,
                )
                for index, (key, text) in enumerate(value.items())
            ]
        )
        kept[name] = {key: copied(text) for key, text in value.items()}

    return read


_OVERRIDE: Final = OVERRIDE.encode()
# What a process has as long as it is plain: where it was called, its condition, and what it is made of.
_OF_PLAIN: Final = 3
_NUMBERS: Final = (int, float)
_STREAMS: Final = frozenset(STREAMS)
OF_PROCESSES: Final[Readers] = {
    "prefix": _prefix,
    "cwd": "cwd",
    "output": _output,
    "emulate_tty": _flag,
    "respawn": _respawn,
    "respawn_delay": _delay,
    "respawn_max_retries": _retries,
    "shell": known_flag,
    "sigterm_timeout": _seconds,
    "sigkill_timeout": _seconds,
    "on_exit": _on_exit,
    "env": _environment("env_only"),
    "additional_env": _environment("env"),
    "condition": left,
}
