"""Components as written, evaluated in the scope they stand in."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.dataclass import dataclass
from orchestra.errors import Code, Severity
from orchestra.nearest import is_slip, nearest
from orchestra.resolve.context import Poison, Value
from orchestra.resolve.interpret import wanted
from orchestra.resolve.model import InlineParameter, ResolvedComponent
from orchestra.resolve.namespaces import namespace_at
from orchestra.resolve.node_names import named
from orchestra.resolve.parameters import parameters
from orchestra.resolve.params_schema import params_schema
from orchestra.resolve.python_components import check_plugin
from orchestra.resolve.reactions import ResolvedLoad
from orchestra.resolve.refusals import missing_package, report_missing_package
from orchestra.resolve.remapping import remaps

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.description.components import ComposableNode
    from orchestra.resolve.resolution import Resolution

# What a container of rclcpp takes besides parameters.
_EXTRA: Final = frozenset(
    {
        "enable_logger_service",
        "enable_rosout",
        "enable_topic_statistics",
        "forward_global_arguments",
        "start_parameter_event_publisher",
        "start_parameter_services",
        "use_clock_thread",
        "use_global_arguments",
        "use_intra_process_comms",
    }
)


@dataclass(frozen=True, slots=True)
class Container:
    """What components are loaded into: a container by its full name, by the index of its process, or by its action."""

    name: Value | None = None
    process: int | None = None
    origin: Any = None
    faulty: bool = False


def add_components(
    written: Sequence[ComposableNode], container: Container, run: Resolution, *, delayed: bool
) -> None:
    """Add components to what has been found, but for those whose condition says no.

    Unless they are `delayed` they are loaded as soon as the container takes orders.
    """
    for item in written:
        if not wanted(item, "composable_node", run):
            continue
        component = _component(item, container, run, delayed=delayed)
        if delayed and run.occasion is not None:
            run.occasion.do.append(ResolvedLoad(len(run.found.components), component.location))
        run.found.components.append(component)


def _package(written: ComposableNode, run: Resolution) -> str | Poison | None:
    """Return the package of a component; one that is a slip for a package that is here is reported.

    Any other may be on the machine of its container.
    """
    package, packages = run.text(written.pkg), run.context.packages
    if isinstance(package, str) and packages.prefix(package) is None:
        missing = missing_package(package, packages.names(), Severity.WARNING)
        if missing.severity is Severity.ERROR:
            return report_missing_package(package, written.pkg, run.context)
    return package


def _component(
    written: ComposableNode, container: Container, run: Resolution, *, delayed: bool
) -> ResolvedComponent:
    package, plugin = _package(written, run), run.evaluate(written.plugin)
    if isinstance(package, str) and isinstance(plugin, Value) and not written.faulty:
        plugin = check_plugin(package, plugin, written.pkg, run)
    name, namespace = named(written.name, run), namespace_at(written.namespace, written, run)
    own, whole = parameters(written.param, run, component=True)
    extra, told = parameters(written.extra_arg, run, component=True, quotes=False)
    for item in extra:
        if isinstance(item, InlineParameter) and item.name not in _EXTRA:
            _check_extra(item, run)
    rules, regular = remaps(written.remap, run)
    autostart = run.flag(written.autostart, default=False)
    schema = params_schema(written.params_schema, run)
    values = (package, plugin, name, namespace, autostart, schema)
    sound = whole and told and regular and not any(isinstance(value, Poison) for value in values)
    return ResolvedComponent(
        package=package if isinstance(package, str) else written.pkg.raw,
        plugin=plugin.text if isinstance(plugin, Value) else written.plugin.raw,
        name=name if isinstance(name, Value) and not isinstance(namespace, Poison) else None,
        namespace=namespace if isinstance(namespace, Value) else None,
        container=container.name,
        container_process=container.process,
        container_origin=container.origin,
        parameters=(*run.scope.parameters, *own),
        extra_arguments=extra,
        remaps=(*run.scope.remaps, *rules),
        autostart=autostart is True,
        delayed=delayed,
        location=run.at(written.span),
        conditional=run.conditions > 0 or written.if_ is not None or written.unless is not None,
        faulty=not sound or container.faulty or written.faulty,
        params_schema=None if isinstance(schema, Poison) else schema,
        share=run.context.packages.share(package) if isinstance(package, str) else None,
        origin=written.origin,
    )


def _check_extra(argument: InlineParameter, run: Resolution) -> None:
    """Tell of an extra argument whose name is a slip for one that containers of rclcpp know; they ignore others."""
    meant = nearest(argument.name, _EXTRA)
    if meant is not None and is_slip(argument.name, meant):
        told = f"no container knows the extra argument '{argument.name}'"
        at = argument.keys[0][1] if argument.keys else argument.location
        run.problems.warning(Code.UNREAD_ARGUMENT, told, at, suggestion=meant)
