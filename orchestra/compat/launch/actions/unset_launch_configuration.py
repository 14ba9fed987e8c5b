"""`UnsetLaunchConfiguration`: removes a launch configuration."""

from __future__ import annotations

from orchestra.compat.launch.actions.named import NamedAction
from orchestra.description.actions.unset_let import UnsetLet


class UnsetLaunchConfiguration(NamedAction):
    """Remove a launch configuration, where it is set, for what follows in this scope."""

    _model = UnsetLet
    _plain = (1, ("name",))
