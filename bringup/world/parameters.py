"""The table of settings as ROS parameters: declared with descriptors and ranges, changed while the node runs."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor, SetParametersResult
from rclpy.parameter import Parameter

from bringup.world import robots_file
from bringup.world.settings import Robot, Settings, SettingsError, checked, nearest, settings
from bringup.world.table import BY_NAME, EACH, TABLE, Setting

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from rclpy.node import Node

# What rclpy itself declares.
OTHERS = ("use_sim_time", "start_type_description_service", "qos_overrides.")


class Parameters:
    """The parameters of a node that was made with its overrides declared, and with undeclared ones allowed.

    Raises rclpy's InvalidParameterTypeException and InvalidParameterValueException for a wrong type and a value out
    of range, SettingsError for values that do not go together.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        given = {name: parameter.value for name, parameter in node.get_parameters_by_prefix("").items()}
        self._values = {setting.name: _declare(node, setting, given) for setting in TABLE}
        file = self._values["robots_file"]
        self._robots: Mapping[str, Robot] = {
            robot.name: robot for robot in (robots_file.read(Path(file)) if file else ())
        }
        names = settings(self._values, tuple(self._robots.values())).robots
        self._robots = {name: self._robots.get(name, Robot(name)) for name in names}
        self._robots = self._with(_own(given, self._robots))
        self.settings = self._settings(self._values, self._robots)
        self._declare_own()
        self._warn_of(given)

    def follow(self, changed: Callable[[Settings], None]) -> None:
        """From now on take changes that can be meant, and hand over the settings that they make."""

        def take(parameters: list[Parameter]) -> SetParametersResult:
            try:
                self._changed(parameters)
            except SettingsError as error:
                return SetParametersResult(successful=False, reason=str(error))
            return SetParametersResult(successful=True)

        def apply(parameters: list[Parameter]) -> None:
            self._values, self._robots = self._changed(parameters)
            self.settings = self._settings(self._values, self._robots)
            changed(self.settings)

        self._node.add_pre_set_parameters_callback(_real)
        self._node.add_on_set_parameters_callback(take)
        self._node.add_post_set_parameters_callback(apply)

    def _changed(self, parameters: Sequence[Parameter]) -> tuple[dict[str, Any], Mapping[str, Robot]]:
        """Values and robots after a change. Raises SettingsError."""
        values, given = dict(self._values), {}
        for parameter in parameters:
            if parameter.name in BY_NAME:
                values[parameter.name] = parameter.value
            elif not parameter.name.startswith(OTHERS):
                given[parameter.name] = parameter.value
        unknown = [name for name in given if not _is_own(name, self._robots)]
        if unknown:
            raise SettingsError(_unknown(unknown[0], self._robots))
        robots = self._with(_own(given, self._robots))
        self._settings(values, robots)
        return values, robots

    def _settings(self, values: Mapping[str, Any], robots: Mapping[str, Robot]) -> Settings:
        return settings(values, tuple(robots.values()))

    def _with(self, own: Mapping[str, Mapping[str, Any]]) -> dict[str, Robot]:
        """The robots with more values of their own."""
        return {
            name: Robot(name, robot.start, {**robot.own, **own.get(name, {})})
            for name, robot in self._robots.items()
        }

    def _declare_own(self) -> None:
        for robot in self._robots.values():
            for name, value in robot.own.items():
                full = f"{robot.name}.{name}"
                if self._node.has_parameter(full):
                    self._node.undeclare_parameter(full)
                self._node.declare_parameter(full, value, _descriptor(BY_NAME[name]), ignore_override=True)

    def _warn_of(self, given: Mapping[str, Any]) -> None:
        for name in given:
            if name not in BY_NAME and not name.startswith(OTHERS) and not _is_own(name, self._robots):
                self._node.get_logger().warning(_unknown(name, self._robots))


def _own(given: Mapping[str, Any], robots: Mapping[str, Robot]) -> dict[str, dict[str, Any]]:
    """What parameters called `ROBOT.setting` say, by robot. Raises SettingsError."""
    own: dict[str, dict[str, Any]] = {}
    for full, value in given.items():
        if _is_own(full, robots):
            robot, _, name = full.partition(".")
            try:
                own.setdefault(robot, {})[name] = checked(BY_NAME[name], value)
            except SettingsError as error:
                raise SettingsError(f"{robot}: {error}") from error
    return own


def _is_own(full: str, robots: Mapping[str, Robot]) -> bool:
    robot, _, name = full.partition(".")
    return robot in robots and any(setting.name == name for setting in EACH)


def _unknown(full: str, robots: Mapping[str, Robot]) -> str:
    robot, dot, name = full.partition(".")
    meant = nearest(name if dot else full, each=bool(dot))
    if dot and robot not in robots:
        return f"no parameter is called '{full}': no robot is called '{robot}'"
    return f"no parameter is called '{full}'" + (
        f"; '{robot + dot if dot else ''}{meant}' is" if meant else ""
    )


def _real(parameters: list[Parameter]) -> list[Parameter]:
    """Whole numbers as numbers where a setting is one: `speed 2` means 2.0."""
    return [_as_meant(parameter) for parameter in parameters]


def _as_meant(parameter: Parameter) -> Parameter:
    setting = BY_NAME.get(parameter.name.rpartition(".")[2])
    if (
        setting is not None
        and isinstance(setting.default, float)
        and parameter.type_ == Parameter.Type.INTEGER
    ):
        return Parameter(parameter.name, value=float(parameter.value))
    return parameter


def _declare(node: Node, setting: Setting, given: Mapping[str, Any]) -> Any:  # noqa: ANN401 - a parameter's value
    if node.has_parameter(setting.name):
        # Declared without descriptor, as all that is given is at first.
        node.undeclare_parameter(setting.name)
    descriptor, value = _descriptor(setting), given.get(setting.name)
    if isinstance(setting.default, float) or setting.default == ():
        value = _floats(value)
    elif isinstance(setting.default, tuple) and isinstance(value, str):
        value = [value]
    else:
        value = None
    if value is not None:
        return node.declare_parameter(setting.name, value, descriptor, ignore_override=True).value
    if setting.default == ():
        # Without a value the parameter has a type all the same; an empty list would be taken for bytes.
        return node.declare_parameter(setting.name, Parameter.Type.DOUBLE_ARRAY, descriptor).value or ()
    default = list(setting.default) if isinstance(setting.default, tuple) else setting.default
    return node.declare_parameter(setting.name, default, descriptor).value


def _floats(value: Any) -> float | list[float] | None:  # noqa: ANN401 - a parameter's value
    """Whole numbers as numbers, since `duration:=10` means 10.0; None for what is no number or an empty list."""
    if isinstance(value, bool | str | bytes | None):
        return None
    if isinstance(value, int | float):
        return float(value)
    numbers = [number for item in value if isinstance(number := _floats(item), float)]
    return numbers if numbers and len(numbers) == len(value) else None


def _descriptor(setting: Setting) -> ParameterDescriptor:
    descriptor = ParameterDescriptor(
        description=setting.description,
        additional_constraints=setting.constraints,
        read_only=not setting.changeable,
    )
    if isinstance(setting.default, float):
        descriptor.floating_point_range = [FloatingPointRange(from_value=setting.low, to_value=setting.high)]
    elif isinstance(setting.default, int) and not isinstance(setting.default, bool):
        descriptor.integer_range = [IntegerRange(from_value=int(setting.low), to_value=int(setting.high))]
    return descriptor
