"""Whether nodes can talk with each other, as far as their executables declare topics, services and actions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.declared.interfaces.compatibility import misfits
from orchestra.errors import Code
from orchestra.plan.endpoints import Endpoints, Placed, endpoints_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from orchestra.errors import Problems
    from orchestra.plan.endpoints import Node

_KINDS: Final = (
    ("topic", ("publishers", "subscriptions")),
    ("service", ("service_servers", "service_clients")),
    ("action", ("action_servers", "action_clients")),
)


def check_connections(nodes: Iterable[Node], problems: Problems) -> None:
    """Report nodes that use one name with two types, or with qualities of service that do not fit, and near misses."""
    endpoints = endpoints_of(nodes, problems)
    told: set[object] = set()
    for what, kinds in _KINDS:
        _check_types(what, endpoints.of(*kinds), told, problems)
    publishers, subscriptions = endpoints.of("publishers"), endpoints.of("subscriptions")
    _check_qos(publishers, subscriptions, told, problems)
    _check_unfed(endpoints, publishers, subscriptions, told, problems)


def _check_types(what: str, placed: list[Placed], told: set[object], problems: Problems) -> None:
    first: dict[str, Placed] = {}
    for item in placed:
        other = first.setdefault(item.name, item)
        if other.endpoint.type == item.endpoint.type:
            continue
        culprit, fellow = (other, item) if other.remapped and not item.remapped else (item, other)
        if _is_told(told, culprit, culprit.endpoint.type, fellow.endpoint.type):
            continue
        message = (
            f"the {what} '{item.name}' has two types: {culprit.endpoint.type} of '{culprit.node}' "
            f"and {fellow.endpoint.type} of '{fellow.node}'"
        )
        notes = (f"the other one is at {fellow.location}",)
        problems.error(Code.TOPIC_TYPE, message, culprit.location, notes=notes)


def _check_qos(
    publishers: list[Placed], subscriptions: list[Placed], told: set[object], problems: Problems
) -> None:
    for subscription in subscriptions:
        for publisher in publishers:
            if not _are_meant_for_each_other(publisher, subscription):
                continue
            for misfit in misfits(publisher.endpoint.qos, subscription.endpoint.qos):
                if _is_told(told, subscription, misfit):
                    continue
                message = (
                    f"'{subscription.node}' gets nothing of '{subscription.name}' from '{publisher.node}': it asks for "
                    f"{misfit.policy} {misfit.requested}, and {misfit.offered} is offered"
                )
                notes = (f"the publisher is at {publisher.location}",)
                problems.warning(Code.TOPIC_QOS, message, subscription.location, notes=notes)


def _are_meant_for_each_other(publisher: Placed, subscription: Placed) -> bool:
    same = (publisher.name, publisher.endpoint.type) == (subscription.name, subscription.endpoint.type)
    return same and not publisher.tuned and not subscription.tuned


def _check_unfed(
    endpoints: Endpoints,
    publishers: list[Placed],
    subscriptions: list[Placed],
    told: set[object],
    problems: Problems,
) -> None:
    """Report subscriptions that nobody feeds beside a publication that looks meant for them."""
    fed, heard = {item.name for item in publishers}, {item.name for item in subscriptions}
    for item in subscriptions:
        if item.name in fed:
            continue
        near = list(_near(item, publishers, heard, whole=endpoints.whole))
        if len({other.name for other in near}) != 1:
            continue
        publisher = near[0]
        at, meant = item, publisher.name
        if publisher.remapped and not item.remapped:
            at, meant = publisher, item.name
        if _is_told(told, at, item.endpoint.type):
            continue
        notes = [f"'{publisher.node}' is at {publisher.location}"]
        if not at.remapped:
            notes.append(f"a remap from '{item.endpoint.name}' to '{publisher.name}' connects them")
        problems.warning(
            Code.UNFED_TOPIC,
            f"nobody publishes on '{item.name}', which '{item.node}' subscribes to; "
            f"'{publisher.node}' publishes on '{publisher.name}'",
            at.location,
            suggestion=meant if at.remapped else None,
            notes=notes,
        )


def _near(item: Placed, publishers: list[Placed], heard: set[str], *, whole: bool) -> Iterator[Placed]:
    """Yield publications of the type whose names differ in slashes and case or, if all is known, in the namespace."""
    for publisher in publishers:
        if publisher.endpoint.type != item.endpoint.type or publisher.node == item.node:
            continue
        alone = whole and publisher.name not in heard
        if _folded(publisher.name) == _folded(item.name) or (
            alone and _last(publisher.name) == _last(item.name)
        ):
            yield publisher


def _folded(name: str) -> str:
    return name.replace("/", "").replace("_", "").lower()


def _last(name: str) -> str:
    return name.rpartition("/")[2].lower()


def _is_told(told: set[object], at: Placed, *what: object) -> bool:
    """Return whether this has been told of this place of a file before, for another node that it makes."""
    key = (at.location.span, at.endpoint.name, *what)
    known = key in told
    told.add(key)
    return known
