"""What a launch description does about events. No file format has a tag for it: Python makes these."""

from __future__ import annotations

from typing import Any, Literal, TypeAlias

from orchestra.description.entity import Entity
from orchestra.description.nested import Children
from orchestra.values import EventName

HandledEvent: TypeAlias = EventName | Literal["custom"]


class Handler(Entity):
    """What is done whenever an event comes; `origin` is the event handler of the launch file.

    `target` narrows the event to an action (None: any; an object: this very one; a callable: those that it holds for,
    and where it is an `ActionMatcher` it tells what it looks for). `process_completed` of an action that is no process
    is the end of its execution. What is done is either `children`, or whatever entities `callback(event, context)`
    returns when it is called with the event, which only happens during the run. `custom` events are those that only
    `origin.matches(event)` knows: any event object may be one, those of processes included.
    """

    event: HandledEvent
    target: Any = None
    stream: Literal["stdin", "stdout", "stderr"] | None = None
    transition: str | None = None
    start_state: str | None = None
    goal_state: str | None = None
    children: Children | None = None
    callback: Any = None
    once: bool = False
