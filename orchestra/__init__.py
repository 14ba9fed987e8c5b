"""Orchestra launches, checks and supervises systems of ROS 2 nodes. The names below are its public surface."""

from importlib import import_module

TYPE_CHECKING = False  # `typing` itself costs more than this module, which every process imports
if TYPE_CHECKING:
    from orchestra.errors import (
        Code,
        DescriptionError,
        OrchestraError,
        Problem,
        RunError,
        Severity,
        UsageError,
    )
    from orchestra.events import Event
    from orchestra.location import Location, Span
    from orchestra.pipeline import check, inputs_from, make_plan
    from orchestra.plan.model import Plan, Process
    from orchestra.resolve.inputs import Inputs

_HOMES = {
    "Code": "orchestra.errors",
    "DescriptionError": "orchestra.errors",
    "Event": "orchestra.events",
    "Inputs": "orchestra.resolve.inputs",
    "Location": "orchestra.location",
    "OrchestraError": "orchestra.errors",
    "Plan": "orchestra.plan.model",
    "Problem": "orchestra.errors",
    "Process": "orchestra.plan.model",
    "RunError": "orchestra.errors",
    "Severity": "orchestra.errors",
    "Span": "orchestra.location",
    "UsageError": "orchestra.errors",
    "check": "orchestra.pipeline",
    "inputs_from": "orchestra.pipeline",
    "make_plan": "orchestra.pipeline",
}

__all__ = [
    "Code",
    "DescriptionError",
    "Event",
    "Inputs",
    "Location",
    "OrchestraError",
    "Plan",
    "Problem",
    "Process",
    "RunError",
    "Severity",
    "Span",
    "UsageError",
    "check",
    "inputs_from",
    "make_plan",
]

if not TYPE_CHECKING:  # where types are checked, an unknown name is an error

    def __getattr__(name: str) -> object:
        """Import a public name when it is first asked for."""
        if name not in _HOMES:
            raise AttributeError(f"module 'orchestra' has no attribute '{name}'")
        return getattr(import_module(_HOMES[name]), name)

    def __dir__() -> list[str]:
        return [*globals(), *__all__]
