"""Gives components a service `get_type_description` that goes with them.

The one that rclpy 7.1 makes is never finalised: it stays in the graph as long as the process lives. Its answers come
from the node alone, so a plain service that hands requests on to the one of the container answers the same.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from rclpy.type_description_service import TypeDescriptionService
from type_description_interfaces.srv import GetTypeDescription

if TYPE_CHECKING:
    from rclpy.node import Node


def install(manager: Node) -> None:
    """Have every node of this process made with such a service, from now on."""
    answering = manager._type_description_service._type_description_srv  # noqa: SLF001 - rclpy has no other way
    if answering is None:  # the container was told not to have one
        return

    def start(of_node: Any) -> None:  # noqa: ANN401 - of an untyped package
        node = of_node._get_node()  # noqa: SLF001 - as above
        node.create_service(
            GetTypeDescription, "~/get_type_description", partial(_answer, answering, node.handle)
        )

    TypeDescriptionService._start_service = start  # noqa: SLF001 - as above


def _answer(answering: Any, handle: Any, request: Any, _response: Any) -> Any:  # noqa: ANN401 - as above
    return answering.handle_request(request, GetTypeDescription.Response, handle)
