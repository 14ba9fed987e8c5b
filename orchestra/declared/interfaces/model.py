"""Interfaces as an executable declares them."""

from __future__ import annotations

from typing import Final, Literal, TypeAlias, get_args

from orchestra.dataclass import dataclass

EndpointKind: TypeAlias = Literal[
    "publishers", "subscriptions", "service_servers", "service_clients", "action_servers", "action_clients"
]
KINDS: Final[tuple[EndpointKind, ...]] = get_args(EndpointKind)


@dataclass(frozen=True, slots=True)
class Qos:
    """Quality of service, as far as it decides who talks with whom; None where it is not known.

    Durations are in seconds, `inf` for endless ones.
    """

    reliability: str | None = None
    durability: str | None = None
    liveliness: str | None = None
    deadline: float | None = None
    lease_duration: float | None = None


@dataclass(frozen=True, slots=True)
class Endpoint:
    """One topic, service or action, by the name that the program uses, and its type (`std_msgs/msg/String`)."""

    kind: EndpointKind
    name: str
    type: str
    qos: Qos = Qos()


@dataclass(frozen=True, slots=True)
class Interface:
    """What one node has; `node` is the name that the program gives itself, where that is known."""

    endpoints: tuple[Endpoint, ...]
    node: str | None = None
