"""Components whose arguments are of the usual kinds: as nodes are (`plain_nodes.py`), by the same walk through them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.building import condition_fields
from orchestra.compat.launch_ros.made_later import Made, MadeLater, Usual
from orchestra.compat.launch_ros.plain_parameters import parameters, remaps
from orchestra.compat.launch_ros.plain_texts import entity, left, standing_at
from orchestra.description.components import ComposableNode

if TYPE_CHECKING:
    from orchestra.compat.launch_ros.plain_texts import Readers


class PlainComponent(MadeLater):
    """What a component is before somebody asks for more than its model: then it is constructed from its arguments."""

    def _keep(self, arguments: tuple[Any, ...], keywords: dict[str, Any]) -> bool:
        if arguments or self._is_constructed():
            return False
        made = self._usual.made(keywords, self._made_at, type(self))
        if made is None:
            return False
        made.condition = keywords.get("condition")
        self._plain = made
        return True

    def _plain_model(self) -> ComposableNode | None:
        """Return the model as long as nobody has asked for more, or set something; None where it takes another look."""
        own = vars(self)
        if "_plain" not in own:
            return None
        if len(own) > _OF_PLAIN:
            self._construct()
            return None
        made: Made = own["_plain"]
        condition = made.condition
        said = {} if condition is None else condition_fields(condition, self._place.at("condition"))
        if any(text.constant is not None for text in said.values()):  # the validator looks at its words
            return None
        fields = made.fields(USUAL)
        if fields is None:
            return None
        values = fields | {_CONDITIONS[word]: text for word, text in said.items()}
        model: ComposableNode = entity(ComposableNode, values, standing_at(made, (), self))
        return model


# What a component has as long as it is plain: where it was called, and what it is made of.
_OF_PLAIN: Final = 2
_CONDITIONS: Final = {"if": "if_", "unless": "unless"}
_READ: Final[Readers] = {
    "package": "pkg",
    "plugin": "plugin",
    "name": "name",
    "namespace": "namespace",
    "parameters": parameters("param"),
    "remappings": remaps,
    "extra_arguments": parameters("extra_arg"),
    "condition": left,
}
USUAL: Final = Usual(
    ComposableNode,
    _READ,
    {
        "parameters": ("params", "param", ()),
        "remappings": ("remaps", "remap", ()),
        "extra_arguments": ("params", "extra_arg", ()),
    },
    ("pkg", "plugin"),
)
