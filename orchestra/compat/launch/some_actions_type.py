"""`SomeActionsType`: an action, or several."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Union

from orchestra.compat.launch.action import Action

SomeActionsType = Union[Action, Iterable[Action]]  # noqa: UP007 - evaluated by users' own annotations

SomeActionsType_types_tuple = (Action, Iterable)
