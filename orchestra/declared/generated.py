"""Definition files of generate_parameter_library: from the tree of a file to the parameters of a node.

A file has one root, which names a C++ namespace. Below it mappings nest until one has a `type`: that is a parameter. A
level `__map_LIST` stands for one level for each item of the list of strings LIST, which is looked for beside it and
then further out. Parameters of type `none` tell of groups that others declare. Source: the documentation of
generate_parameter_library (YAML syntax, mapped parameters, validators).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.dataclass import dataclass
from orchestra.declared.documents import Document
from orchestra.declared.generated_rules import RULES, element_of, rule_of
from orchestra.declared.judging import DeclaredParameters, value_faults
from orchestra.declared.kinds import FIXED, NONE, TYPES, is_leaf, is_type
from orchestra.declared.model import Declarations, Parameter, RosType
from orchestra.declared.rules import objections
from orchestra.errors import Code, Problems
from orchestra.fields import field, replace
from orchestra.nearest import is_slip, nearest

if TYPE_CHECKING:
    from orchestra.declared.documents import Way
    from orchestra.values import ParameterValue

_MAP: Final = "__map_"
_KEYS: Final = ("type", "default_value", "description", "read_only", "validation", "additional_constraints")


def read_definition(document: Document, problems: Problems) -> DeclaredParameters | None:
    """Return what a definition file declares. What is wrong with it is reported; None where nothing is left of it."""
    data = document.data
    if not isinstance(data, dict) or len(data) != 1 or not isinstance(next(iter(data.values())), dict):
        told = "a definition of generate_parameter_library has one key, with parameters below it"
        problems.error(Code.BROKEN_DECLARATION, told, document.at())
        return None
    ((root, tree),) = data.items()
    found = _Definition(document, problems)
    found.level(tree, (root,), "", ())
    scoped = tuple(replace(item, keys=tuple(map(found.list_of, item.keys))) for item in found.parameters)
    return DeclaredParameters(Declarations(scoped, groups=tuple(found.groups)))


@dataclass(slots=True)
class _Definition:
    """A file that is being read. Until all is known `keys` of parameters are scope and list: `a.b|joints`."""

    document: Document
    problems: Problems
    parameters: list[Parameter] = field(default_factory=list)
    groups: list[str] = field(default_factory=list)

    def level(self, tree: dict[Any, Any], way: Way, above: str, keys: tuple[str, ...]) -> None:
        """Read the parameters of a level; `above` is what its names begin with."""
        for word, inner in tree.items():
            name, here = str(word), (*way, word)
            if not isinstance(inner, dict):
                self.refuse(f"'{name}' is no parameter: that is a mapping with a `type`", here)
            elif name.startswith(_MAP):
                self.level(inner, here, f"{above}{{}}.", (*keys, f"{above}|{name.removeprefix(_MAP)}"))
            elif is_leaf(inner):
                self.parameter(inner, here, f"{above}{name}", keys)
            elif inner and all(isinstance(item, dict) for item in inner.values()):
                self.level(inner, here, f"{above}{name}.", keys)
            else:
                self.refuse(f"the parameter '{name}' has no `type`", here, key=True)

    def parameter(self, leaf: dict[Any, Any], way: Way, name: str, keys: tuple[str, ...]) -> None:
        """Read one parameter."""
        for word in leaf:
            near = nearest(str(word), _KEYS)
            if word not in _KEYS and near is not None and near not in leaf and is_slip(str(word), near):
                self.refuse(f"a parameter has no key '{word}'", (*way, word), meant=near, key=True)
        if leaf["type"] == NONE:
            self.groups.append(name.partition(".{}")[0])
            return
        if not is_type(leaf["type"]):
            self.refuse(
                f"'{leaf['type']}' is no type of a parameter",
                (*way, "type"),
                meant=nearest(str(leaf["type"]), (*TYPES, NONE)),
            )
            self.groups.append(name.partition(".{}")[0])
            return
        kind = TYPES[FIXED.sub("", leaf["type"])]
        default, rules = _default(leaf.get("default_value"), kind), self.rules(leaf, kind, way)
        # A default that its own validation refuses is how an author says that a value must be given.
        refused = default is not None and any(any(objections(rule, default)) for rule in rules)
        made = Parameter(
            name=name,
            types=(kind,),
            required=refused or leaf.get("default_value") is None,
            default=default,
            description=str(leaf.get("description") or ""),
            read_only=leaf.get("read_only") is True,
            rules=rules,
            keys=keys,
        )
        self.parameters.append(made)
        self.check_default(made, leaf, way)

    def rules(self, leaf: dict[Any, Any], kind: RosType, way: Way) -> tuple[Any, ...]:
        """Read what validates a parameter. Functions of the user's own cannot be known; they are left to the node."""
        found = []
        fixed = FIXED.search(leaf["type"])
        if fixed is not None:
            found.append(rule_of("size_lt", [int(fixed["size"]) + 1], kind))
        validation = leaf.get("validation") or {}
        if isinstance(validation, list):  # of functions without arguments, as it was in the beginning
            validation = {item: None for item in validation if isinstance(item, str)}
        if not isinstance(validation, dict):
            self.refuse("`validation` is a mapping of functions", (*way, "validation"))
            return ()
        for word, arguments in validation.items():
            function, here = str(word).removesuffix("<>"), (*way, "validation", word)
            if function not in RULES:
                near = nearest(function, RULES)
                if "::" not in function and near is not None and is_slip(function, near):
                    self.refuse(f"there is no validation '{word}'", here, meant=f"{near}<>", key=True)
                continue
            given = arguments if isinstance(arguments, list) else [] if arguments is None else [arguments]
            try:
                found.append(rule_of(function, given, kind))
            except ValueError as error:
                self.refuse(f"'{word}' {error}", here)
        return tuple(rule for rule in found if rule is not None)

    def check_default(self, made: Parameter, leaf: dict[Any, Any], way: Way) -> None:
        """Report a default that the parameter itself refuses by its type; a value that must be set may be no value."""
        given = leaf.get("default_value")
        if given is not None and made.default is None:
            told = f"the default of '{made.name}' is no {element_of(leaf['type'])}"
            self.refuse(told, (*way, "default_value"))
        elif made.default is not None and made.default != ():
            typed = replace(made, rules=())
            for fault in value_faults(typed, made.name, made.default):
                self.refuse(f"the default: {fault.told}", (*way, "default_value"), meant=fault.meant)

    def list_of(self, key: str) -> str:
        """Return the full name of a list of strings that is named in a scope: the nearest there is further out."""
        scope, _, name = key.partition("|")
        lists = {item.name for item in self.parameters if item.types == ("string_array",)}
        while True:
            if f"{scope}{name}" in lists:
                return f"{scope}{name}"
            if not scope:
                return name
            scope = scope.rstrip(".").rpartition(".")[0]
            scope += "." if scope else ""

    def refuse(self, told: str, way: Way, *, meant: str | None = None, key: bool = False) -> None:
        """Report what is wrong with the file."""
        at = self.document.at(way, key=key)
        self.problems.error(Code.BROKEN_DECLARATION, told, at, suggestion=meant)


def _default(value: Any, kind: RosType) -> ParameterValue | None:  # noqa: ANN401 - as YAML has it
    """Return a default as a value of a parameter. Whole numbers are doubles where these are meant."""
    if isinstance(value, list):
        items = [_default(item, kind) for item in value]
        sound = tuple(item for item in items if item is not None and not isinstance(item, tuple))
        return sound if len(sound) == len(items) else None  # type: ignore[return-value]  # of one type, or told
    if isinstance(value, bool | str):
        return value
    if isinstance(value, int | float):
        return float(value) if kind.startswith("double") else value
    return None
