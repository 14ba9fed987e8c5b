"""Nodes whose arguments are of the usual kinds: one walk through them makes the fields of the model.

Launch files have hundreds of such nodes, and what the constructor keeps of them in upstream's forms is seldom looked
at. It is made when somebody does. Nothing is read here that the constructor would read otherwise, and whatever it
might have something to say about is left to it.
"""

from __future__ import annotations

import math
import os
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.building import unchecked
from orchestra.compat.launch.actions.execute_local import OVERRIDE
from orchestra.compat.launch.actions.execute_process import ExecuteProcess
from orchestra.compat.launch_ros.made_later import Made, MadeLater, Usual
from orchestra.compat.launch_ros.plain_parameters import parameters, remaps
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
from orchestra.compat.place import Arguments, Key, Place, ValueOf
from orchestra.description.actions.node import Node as NodeModel
from orchestra.description.outputs import OUTPUTS
from orchestra.description.parts import Pair

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from types import FrameType

    from orchestra.description.entity import Action as Model


class PlainNode(MadeLater, ExecuteProcess):
    """What a node is before somebody asks for more than its model: then it is constructed from its arguments.

    That is for the very class that says `_may_be_plain`: those of users may look at what the constructor keeps.
    """

    _may_be_plain = False

    def _taken(self, keywords: dict[str, Any], caller: FrameType) -> bool:
        kind = type(self)
        if "_may_be_plain" not in vars(kind) or _says_output(os.environ):
            return False
        place = Place(caller.f_code, caller.f_lasti, kind)
        made = USUAL.made(keywords, place)
        if made is None:
            return False
        condition = keywords.get("condition")
        self.__dict__ = {"_place": place, "_plain": made, "_Action__condition": condition}
        return True

    def _construct(self) -> None:
        made: Made = vars(self)["_plain"]
        super()._construct()
        if made.resolved is not None:
            self._resolved_by(made.resolved)
        if made.prepared is not None:
            self._prepared_by(made.prepared)

    def _plainly(self) -> Made | None:
        """Return what the node is made of as long as nobody has asked for more, or set something."""
        own = vars(self)
        made: Made | None = own.get("_plain")
        if made is not None and len(own) > _OF_PLAIN:
            self._construct()
            return None
        return made

    def _resolved_by(self, names: Callable[[], tuple[Any, ...]]) -> None:
        """Take note of what gives what a visit has come to."""
        made: Made | None = vars(self).get("_plain")
        if made is not None:
            made.resolved = names
        else:
            self._resolved_as(*names())

    def _resolved_as(self, name: str | None, namespace: str | None, rules: Any) -> None:
        """Take note of what a visit has come to; a node does."""

    def _prepared_by(self, details: Callable[[], tuple[Any, ...]]) -> None:
        made: Made | None = vars(self).get("_plain")
        if made is not None:
            made.prepared = details
        else:
            super()._prepared_by(details)

    def _to_model(self, common: Mapping[str, Any]) -> Model:
        made = self._plainly()
        model: Model | None = None if made is None else _model(made, self._place, common)
        if model is None:
            if made is not None:
                self._construct()
            return super()._to_model(common)
        return model


def _says_output(environ: Any) -> bool:
    """Return whether the environment says where the output of all processes goes."""
    known = getattr(
        environ, "_data", None
    )  # the table itself: to go through `os.environ` takes ten times as long
    return OVERRIDE in environ if known is None else _OVERRIDE in known


def _model(made: Made, place: Place, common: Mapping[str, Any]) -> Model | None:
    """Return the model; `common` are the fields that every action has. None where an argument is usual no more."""
    origin, fields = common["origin"], made.fields(USUAL)
    if fields is None:
        return None
    model: Model
    if len(common) == 1:
        model = entity(NodeModel, fields, standing_at(made.call, (), origin))
        return model
    condition = unchecked(common)
    if condition is not None:
        model = entity(NodeModel, {**fields, **condition}, standing_at(made.call, (), origin))
        return model
    said = {name: value for name, value in fields.items() if value is not None}
    return NodeModel.at(place.span, **said, **common)


def _prefix(name: str, value: Any, call: Arguments, fields: dict[str, Any], kept: dict[str, Any]) -> None:
    """Read the words before the command, which a text is taken apart into."""
    if type(value) is str:
        fields["launch_prefix"] = divisible(value, call.span((name,)))
    else:
        word("launch_prefix", name, value, call, fields, kept)


def _words(field: str, *, empty: Any) -> Callable[..., None]:
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
    del kept
    if value is True:
        fields[name] = plain_text("true", call, (name,))
    elif value is not False:
        raise UnusualError
    elif name == "emulate_tty":
        fields[name] = plain_text("false", call, (name,))


def _delay(name: str, value: Any, call: Arguments, fields: dict[str, Any], kept: dict[str, Any]) -> None:
    del kept
    if type(value) not in _NUMBERS or value < 0 or not math.isfinite(value):
        raise UnusualError
    fields[name] = plain_text(repr(value), call, (name,))


def _output(name: str, value: Any, call: Arguments, fields: dict[str, Any], kept: dict[str, Any]) -> None:
    del kept
    if type(value) is str and value not in OUTPUTS:
        raise UnusualError
    fields[name] = made = plain_text(value, call, (name,))
    if type(value) is not str and made.constant is not None:
        raise UnusualError


def _environment(
    name: str, value: Any, call: Arguments, fields: dict[str, Any], kept: dict[str, Any]
) -> None:
    if type(value) is not dict:
        raise UnusualError
    beside, keys, texts = standing_at(call, (name,)), Arguments(call.place), Arguments(call.place)
    fields["env"] = tuple(
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


_OVERRIDE: Final = OVERRIDE.encode()
# What a node has as long as it is plain: its place, its condition, and what it is made of.
_OF_PLAIN: Final = 3
_NUMBERS: Final = (int, float)
_READ: Final[dict[str, Callable[..., None] | str]] = {
    "package": "pkg",
    "executable": "exec",
    "name": "name",
    "namespace": "namespace",
    "exec_name": "exec_name",
    "prefix": _prefix,
    "cwd": "cwd",
    "parameters": parameters("param"),
    "remappings": remaps,
    "arguments": _words("args", empty=None),
    "ros_arguments": _words("ros_args", empty=()),
    "output": _output,
    "emulate_tty": _flag,
    "respawn": _flag,
    "respawn_delay": _delay,
    "additional_env": _environment,
    "condition": left,
}
USUAL: Final = Usual(
    _READ,
    {
        "parameters": ("params", "param", ()),
        "remappings": ("remaps", "remap", ()),
        "arguments": ("words", "args", None),
        "ros_arguments": ("words", "ros_args", ()),
    },
    NodeModel._unwritten(),
    ("exec",),
)
