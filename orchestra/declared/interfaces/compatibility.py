"""Whether a subscription gets what a publisher offers: the request-offer rules of DDS (DDS 1.4, 2.2.3).

What is not known fits everything.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.dataclass import dataclass

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.declared.interfaces.model import Qos

# By policy, from what promises least to what promises most.
_ORDERS: Final = {
    "reliability": ("best_effort", "reliable"),
    "durability": ("volatile", "transient_local"),
    "liveliness": ("automatic", "manual_by_topic"),
}
# Durations that must not be longer than what is asked for.
_DURATIONS: Final = ("deadline", "lease_duration")


@dataclass(frozen=True, slots=True)
class Misfit:
    """A policy of which less is offered than is asked for; values as people write them."""

    policy: str
    offered: str
    requested: str


def misfits(offered: Qos, requested: Qos) -> Iterator[Misfit]:
    """Yield the policies that keep a publisher and a subscription from being connected."""
    for policy, order in _ORDERS.items():
        offer, request = getattr(offered, policy), getattr(requested, policy)
        if offer in order and request in order and order.index(offer) < order.index(request):
            yield Misfit(policy, offer, request)
    for policy in _DURATIONS:
        offer, request = getattr(offered, policy), getattr(requested, policy)
        if offer is not None and request is not None and offer > request:
            yield Misfit(policy.replace("_", " "), _duration(offer), _duration(request))


def _duration(seconds: float) -> str:
    return "endless" if seconds == float("inf") else f"{seconds:g} s"
