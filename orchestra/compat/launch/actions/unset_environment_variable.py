"""`UnsetEnvironmentVariable`: removes an environment variable."""

from __future__ import annotations

from orchestra.compat.launch.actions.named import NamedAction
from orchestra.description.actions.unset_env import UnsetEnv


class UnsetEnvironmentVariable(NamedAction):
    """Remove an environment variable, where it is set, for what follows in this scope."""

    _model = UnsetEnv
    _plain = (1, ("name",))
