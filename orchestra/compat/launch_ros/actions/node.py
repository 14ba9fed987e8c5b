"""`Node`: starts a ROS node."""

from __future__ import annotations

import sys
from importlib import import_module
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.extensions import RUNNING, extension_fields
from orchestra.compat.launch_ros.actions.node_action_extension import NodeActionExtension
from orchestra.compat.launch_ros.models import params, remaps
from orchestra.compat.launch_ros.node_words import parameter_words, rules
from orchestra.compat.launch_ros.plain_nodes import USUAL, PlainNode
from orchestra.compat.launch_ros.substitutions.executable_in_package import ExecutableInPackage
from orchestra.compat.launch_ros.utilities.namespace_utils import make_namespace_absolute, prefix_namespace
from orchestra.compat.launch_ros.utilities.normalize_parameters import normalize_parameters
from orchestra.compat.launch_ros.utilities.normalize_remap_rule import normalize_remap_rules
from orchestra.compat.text import normalized, template
from orchestra.compat.values import optional, words
from orchestra.compat.wrong import WrongType
from orchestra.description.actions.node import Node as NodeModel
from orchestra.errors import Code

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.compat.launch.launch_description_entity import LaunchDescriptionEntity
    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.text import Sub
    from orchestra.description.entity import Action as Model
    from orchestra.description.text import Template

__all__ = ["Node", "NodeActionExtension"]

_FORMER: Final = {"node_executable": "executable", "node_name": "name", "node_namespace": "namespace"}
_ROS_ARGUMENTS: Final = "--ros-args"
# What of all processes is said of a node about which nothing else is: with nothing in it that can be wrong.
_PLAIN: Final = frozenset({"env", "origin"})


class Node(PlainNode):
    """Start a node: an executable of a package, without `package` any program.

    Instead of them a Python `module` or `script` may be given. `name` and `namespace` are the node's, `exec_name`
    labels the process. `arguments` are the program's own, `ros_arguments` follow `--ros-args`. All keywords of
    `ExecuteProcess` are taken but `cmd` and `name`. Raises `TypeError` for `parameters` and `ros_arguments` that are no
    list, for remappings that are not pairs in tuples, for values that no parameter can have, and where not one program
    is given.
    """

    _usual = USUAL
    _more_keywords = (*RUNNING, "lifecycle", "params_schema")

    UNSPECIFIED_NODE_NAME = "<node_name_unspecified>"
    UNSPECIFIED_NODE_NAMESPACE = "<node_namespace_unspecified>"

    def __init__(  # noqa: PLR0913 - upstream's signature
        self,
        *,
        executable: Sub | None = None,
        package: Sub | None = None,
        name: Sub | None = None,
        namespace: Sub | None = None,
        exec_name: Sub | None = None,
        parameters: Any = None,
        remappings: Any = None,
        ros_arguments: Iterable[Sub] | None = None,
        arguments: Iterable[Sub] | None = None,
        module: Sub | None = None,
        script: Sub | None = None,
        **kwargs: Any,
    ) -> None:
        _refuse_former(kwargs)
        _check_program({"executable": executable, "module": module, "script": script}, package)
        self.__instead = {
            key: normalized(value)
            for key, value in (("module", module), ("script", script))
            if value is not None
        }
        self.__package = package
        self.__node_executable = executable
        self.__node_name = name
        self.__node_namespace = namespace
        self.__arguments = None if arguments is None else words(arguments, "arguments")
        # read once: a word may come out of an iterator
        self.__argument_words = [normalized(word) for word in self.__arguments or ()]
        self.__ros_arguments = _checked(ros_arguments, "ros_arguments")
        self.__parameters = normalize_parameters(_checked(parameters, "parameters") or [])
        self.__remappings = normalize_remap_rules(() if remappings is None else remappings)
        self.__names = [None if item is None else normalized(item) for item in (package, name, namespace)]
        self.__expanded_node_name = self.UNSPECIFIED_NODE_NAME
        self.__expanded_node_namespace = self.UNSPECIFIED_NODE_NAMESPACE
        self.__expanded_remappings: list[tuple[str, str]] | None = None
        self.__final_node_name: str | None = None
        words_of_its_own = self.__words()
        self._word_count = len(words_of_its_own)
        super().__init__(cmd=words_of_its_own, name=exec_name, **kwargs)

    @staticmethod
    def parse_nested_parameters(params: Iterable[Any], parser: Any) -> list[Any]:
        """Return the parameters of entities of a launch file in XML or YAML, as the constructor takes them.

        Raises `RuntimeError` where one is neither a value nor a file.
        """
        read = import_module(
            "orchestra.compat.launch.frontend.reading.parameters"
        )  # which few launch files need
        parameters: list[Any] = read.parameters(params, parser)
        return parameters

    @property
    def node_package(self) -> Sub | None:
        """The package, as it was given."""
        return self.__package

    @property
    def node_executable(self) -> Sub | None:
        """The executable, as it was given; None where a module or a script is run."""
        return self.__node_executable

    @property
    def node_name(self) -> str:
        """The full name; what nobody said stands in it as a marker. Raises `RuntimeError` before the visit."""
        if self.__final_node_name is None:
            raise RuntimeError("the name of a node is not known before the node has been visited")
        return self.__final_node_name

    @property
    def expanded_node_namespace(self) -> str:
        """The absolute namespace; a marker where nobody said one, and before the visit."""
        return self.__expanded_node_namespace

    @property
    def expanded_remapping_rules(self) -> list[tuple[str, str]] | None:
        """The rules of all nodes and its own; None before the visit, and without any."""
        return self.__expanded_remappings

    def is_node_name_fully_specified(self) -> bool:
        """Return whether both name and namespace are said. Raises `RuntimeError` before the visit."""
        markers = (self.UNSPECIFIED_NODE_NAME, self.UNSPECIFIED_NODE_NAMESPACE)
        return not any(marker in self.node_name for marker in markers)

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Start the node."""
        self._perform_substitutions(context)
        return super().execute(context)

    def prepare(self, context: LaunchContext) -> None:
        """Perform the substitutions of the program, and find out what ROS makes of the rest."""
        self._perform_substitutions(context)
        super().prepare(context)

    def _is_as_described(self) -> bool:
        kind = type(self)
        if kind.visit is _visit and kind.execute is _execute and kind.prepare is _prepare:
            return True
        return super()._is_as_described()

    def _words_of_its_own(self, context: LaunchContext) -> list[str]:
        """Return the words that follow the last `--ros-args`: names, parameters and remappings."""
        known = self.is_node_name_fully_specified()
        name, namespace = self.__expanded_node_name, self.__expanded_node_namespace
        found = [] if name == self.UNSPECIFIED_NODE_NAME else ["-r", f"__node:={name}"]
        found += [] if namespace == self.UNSPECIFIED_NODE_NAMESPACE else ["-r", f"__ns:={namespace}"]
        found += parameter_words(self.__parameters, self.node_name if known else None, context)
        for left, right in self.__expanded_remappings or ():
            found += ["-r", f"{left}:={right}"]
        return found

    def _perform_substitutions(self, context: LaunchContext) -> None:
        """Find the names out."""
        name, namespace = (None if item is None else _performed(item, context) for item in self.__names[1:])
        base = context.launch_configurations.get("ros_namespace", None)
        absolute = make_namespace_absolute(prefix_namespace(base, namespace))
        self._resolved_as(name, absolute, rules(self.__remappings, context))

    def _resolved_as(self, name: str | None, namespace: str | None, rules: Iterable[tuple[str, str]]) -> None:
        """Take note of what a visit has come to. `rules` are the remappings of all nodes, then the node's own."""
        self.__expanded_node_name = self.UNSPECIFIED_NODE_NAME if name is None else name.removeprefix("/")
        self.__expanded_node_namespace = self.UNSPECIFIED_NODE_NAMESPACE if namespace is None else namespace
        self.__expanded_remappings = list(rules) or None
        self.__final_node_name = f"{self.__expanded_node_namespace.rstrip('/')}/{self.__expanded_node_name}"

    def _process_model(self, common: Mapping[str, Any]) -> Model:
        fields, more = self._node_fields(), {**self._running_fields(), **common}
        if fields["exec"] is not None and more.keys() <= _PLAIN:
            return NodeModel.made(self._place.span, {**fields, "env": more["env"]}, more.get("origin"))
        return NodeModel.at(self._place.span, **fields, **more)

    def _node_fields(self) -> dict[str, Any]:
        """Return the fields that the models of all kinds of nodes share."""
        at = self._place.at
        package, name, namespace = map(optional, self.__names, map(at, ("package", "name", "namespace")))
        words = enumerate(self.__argument_words)
        arguments = tuple(template(word, at("arguments", index)) for index, word in words)
        return {
            "pkg": package,
            "exec": self.__program(),
            **{key: template(value, at(key)) for key, value in self.__instead.items()},
            "name": name,
            "namespace": namespace,
            "exec_name": optional(self.process_description.name, at("exec_name")),
            "args": arguments or None,
            "ros_args": self.__ros_words(),
            "param": params(self.__parameters, at("parameters")),
            "remap": remaps(self.__remappings, at("remappings")),
        }

    def _extension_fields(self, extensions: Mapping[str, Any]) -> dict[str, Any]:
        return extension_fields(NodeModel, extensions, self._place, exec=self.__program())

    def __program(self) -> Template | None:
        if self.__node_executable is None:
            return None
        return template(self.__node_executable, self._place.at("executable"))

    def __words(self) -> list[Sub]:
        """Return the words of the command line that are known without a visit."""
        program: list[Sub]
        if self.__node_executable is None:
            program = [
                sys.executable,
                *(("-m",) if "module" in self.__instead else ()),
                *self.__instead.values(),
            ]
        elif self.__package is not None:
            program = [ExecutableInPackage(package=self.__package, executable=self.__node_executable)]
        else:
            program = [self.__node_executable]
        ros_arguments = () if self.__ros_arguments is None else (_ROS_ARGUMENTS, *self.__ros_arguments)
        return [*program, *self.__argument_words, *ros_arguments, _ROS_ARGUMENTS]

    def __ros_words(self) -> tuple[Template, ...] | None:
        """Return the ROS arguments, with what users have appended to `cmd` since, which ends with `--ros-args`."""
        appended = self.process_description.cmd[self._word_count :]
        if self.__ros_arguments is None and not appended:
            return None
        words = enumerate((*(self.__ros_arguments or ()), *appended))
        return tuple(template(word, self._place.at("ros_arguments", index)) for index, word in words)


_visit, _execute, _prepare = Node.visit, Node.execute, Node.prepare


def _refuse_former(kwargs: Mapping[str, Any]) -> None:
    for former, now in _FORMER.items():
        if former in kwargs:
            raise TypeError(f"Node has no argument '{former}' any more: it is called '{now}'")


def _check_program(given: Mapping[str, Any], package: Any) -> None:
    """Raise `TypeError` where not one program is given: as Python tells it where none is."""
    names = [name for name, value in given.items() if value is not None]
    if not names:
        raise TypeError("Node.__init__() missing 1 required keyword-only argument: 'executable'")
    if len(names) > 1:
        told = "a Node starts one of 'executable', 'module' and 'script'"
        raise WrongType(told, code=Code.CONFLICTING_KEYS, path=(names[-1],))
    if package is not None and names != ["executable"]:
        told = f"'package' goes with 'executable', not with '{names[0]}'"
        raise WrongType(told, code=Code.CONFLICTING_KEYS, path=("package",))


def _checked(value: Any, name: str) -> Any:
    """Return a list, None for None. Raises `TypeError` for anything else, as upstream."""
    if value is not None and not isinstance(value, list):
        raise TypeError(f"'{name}' of a Node is a list, not {type(value).__name__}: {value!r}")
    return value


def _performed(subs: Iterable[Substitution], context: LaunchContext) -> str:
    return "".join(context.perform_substitution(sub) for sub in subs)
