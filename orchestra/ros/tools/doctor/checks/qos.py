"""Publishers and subscriptions that the middleware does not connect."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.ros.tools.doctor.observed import Finding
from orchestra.ros.tools.graph.system import mismatch

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.declared.interfaces.compatibility import Misfit
    from orchestra.ros.tools.doctor.observed import Observed


def check(seen: Observed) -> Iterator[Finding]:
    """Yield each pair once, with all policies that keep it apart."""
    told = set()
    for publisher, subscription in seen.system.pairs():
        policies = mismatch(publisher, subscription)
        pair = (publisher.topic, publisher.node, subscription.node, tuple(policies))
        if policies and pair not in told:
            told.add(pair)
            message = (
                f"{publisher.topic}: nothing that {publisher.node} publishes reaches {subscription.node}: "
                + "; ".join(map(_told, policies))
            )
            facts = [
                {"policy": one.policy, "offered": one.offered, "requested": one.requested} for one in policies
            ]
            yield Finding(
                "qos",
                message,
                (publisher.topic, publisher.node, subscription.node),
                {
                    "topic": publisher.topic,
                    "publisher": publisher.node,
                    "subscription": subscription.node,
                    "policies": facts,
                },
            )


def _told(one: Misfit) -> str:
    return f"{one.policy} is {one.offered}, asked for is {one.requested}"
