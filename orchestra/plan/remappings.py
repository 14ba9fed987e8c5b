"""Remapping rules that can never act, and the topics that readiness waits for."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.plan.conditions import Ready
from orchestra.resolve.names import InvalidName
from orchestra.resolve.remaps import dead_rules, read_rule, remapped

if TYPE_CHECKING:
    from orchestra.errors import Problems
    from orchestra.resolve.model import ResolvedComponent, ResolvedProcess


def check_remaps(process: ResolvedProcess | ResolvedComponent, problems: Problems) -> None:
    """Report rules that an earlier one, often of an outer scope, keeps from acting: the first that matches counts."""
    rules = [read_rule(rule.source.text, rule.target.text) for rule in process.remaps]
    namespace = process.namespace.text if process.namespace is not None else None
    for dead in dead_rules(rules, namespace, process.name.text if process.name is not None else None):
        rule, earlier = process.remaps[dead.rule], process.remaps[dead.caught_by]
        if rule.target.text == earlier.target.text:
            continue
        problems.warning(
            Code.DEAD_REMAP,
            f"'{rule.source.text}' is remapped to '{earlier.target.text}' before this rule is reached",
            rule.source.location,
            notes=(f"the rule that counts is at {earlier.source.location}",),
        )


def readiness(process: ResolvedProcess, problems: Problems) -> Ready | None:
    """Return when a process is ready; a topic is named as the process itself would name it."""
    ready = process.ready
    if ready is None:
        return None
    log = ready.log.text if ready.log is not None else None
    if ready.message is None:
        return Ready(log, None, ready.timeout)
    namespace = process.namespace.text if process.namespace is not None else "/"
    name = process.name.text if process.name is not None else "_"
    rules = [read_rule(rule.source.text, rule.target.text) for rule in process.remaps]
    try:
        topic = remapped(ready.message.text, rules, namespace, name)
    except InvalidName as error:
        message = f"'{ready.message.text}' cannot be a topic: {error.fault.reason}"
        problems.error(Code.BAD_NAME, message, ready.message.location)
        return None
    return Ready(log, topic, ready.timeout)
