"""Triggers that wait, by what they wait for: of a thousand processes each can have its own, and ends are many."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

    from orchestra.plan.reactions import Trigger
    from orchestra.supervise.reactions.happening import Happening
    from orchestra.values import EventName


class Waiting:
    """Knows them in the order in which they began to wait, the latest last."""

    def __init__(self) -> None:
        self._begun = 0
        self._places: dict[str, dict[str, tuple[int, Trigger]]] = {}
        self._by_event: dict[EventName, dict[str | None, dict[str, tuple[int, Trigger]]]] = {}

    def add(self, trigger: Trigger) -> None:
        """Let one wait from now on, as the latest, whether or not it did before."""
        self.remove(trigger.id)
        self._begun += 1
        place = self._by_event.setdefault(trigger.on.event, {}).setdefault(trigger.on.target, {})
        place[trigger.id] = (self._begun, trigger)
        self._places[trigger.id] = place

    def remove(self, name: str) -> None:
        """Let one wait no more, if it does."""
        place = self._places.pop(name, None)
        if place is not None:
            del place[name]

    def has(self, event: EventName) -> bool:
        """Tell whether one waits for events of a kind, or has waited."""
        return event in self._by_event

    def about(self, happening: Happening) -> list[Trigger]:
        """Return those that wait for such an event of its target, or of any."""
        places = self._by_event.get(happening.event)
        if not places:
            return []
        targets = {None, happening.target}
        return _in_order(entry for target in targets for entry in places.get(target, {}).values())


def _in_order(entries: Iterable[tuple[int, Trigger]]) -> list[Trigger]:
    return [trigger for _, trigger in sorted(entries, key=lambda entry: entry[0])]
