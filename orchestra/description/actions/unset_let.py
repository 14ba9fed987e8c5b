"""Unsets a variable (`UnsetLaunchConfiguration` in Python; no word of launch files in YAML and XML)."""

from __future__ import annotations

from orchestra.description.entity import Action
from orchestra.description.fields import Text


class UnsetLet(Action):
    """Unset the variable that `$(var NAME)` reads."""

    name: Text
