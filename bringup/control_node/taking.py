"""Subscriptions that nobody waits for: their messages stay with the middleware until they are taken."""

from __future__ import annotations

from rclpy.callback_groups import MutuallyExclusiveCallbackGroup


class TakenWhenNeeded(MutuallyExclusiveCallbackGroup):  # type: ignore[misc] # rclpy is untyped
    """A group that no executor waits for."""

    def can_execute(self, entity: object) -> bool:  # noqa: ARG002 - the signature is rclpy's
        """Never."""
        return False


TAKEN_WHEN_NEEDED = TakenWhenNeeded()
