"""Names of nodes, namespaces and topics: what is allowed, how they join, what a relative name stands for.

The rules are those of rmw (`rmw_validate_node_name`, `rmw_validate_namespace`, `rmw_validate_full_topic_name`) and
rcl (`rcl_validate_topic_name`, `rcl_expand_topic_name`, the lexer of its command line) in Jazzy.
"""

from __future__ import annotations

import re
from functools import lru_cache
from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.patterns import pattern

if TYPE_CHECKING:
    from collections.abc import Callable

_LONGEST_NODE_NAME = 255
_LONGEST_NAMESPACE = 245
_LONGEST_TOPIC_NAME = 247

_WORDS = "only letters, digits and '_' are allowed"
_PATHS = "only letters, digits, '_' and '/' are allowed"
_DIGITS = frozenset("0123456789")
_OF_A_SHELL = pattern(
    r"\$(?:\{([A-Za-z_][A-Za-z0-9_]*)\}|([A-Za-z_][A-Za-z0-9_]*))|\(var ([A-Za-z_][A-Za-z0-9_]*)\)"
    r"|\{\{\s*([A-Za-z_][A-Za-z0-9_]*)\s*\}\}"
    r"|LaunchConfiguration\(\s*[\"']([A-Za-z_][A-Za-z0-9_]*)[\"']\s*\)"
)
_SUBSTITUTION = pattern(r"\{([^{}]*)\}")
_NUMBERED = pattern(r"(?:(?<=/)|\A)([0-9]+)([A-Za-z0-9_]+)")  # a part that begins with a number
_SHORTEST = 3  # of a word: `1st` and `3d` are left alone
# What nothing can be wrong with but its length and `__`; anything else is looked at closely.
_PLAIN_WORD = pattern(r"[A-Za-z_][A-Za-z0-9_]*")
_PLAIN_PATH = pattern(r"(?:/[A-Za-z_][A-Za-z0-9_]*)+")
_PLAIN_TOPIC = pattern(r"(?:~?/)?[A-Za-z_][A-Za-z0-9_]*(?:/[A-Za-z_][A-Za-z0-9_]*)*")


@dataclass(frozen=True, slots=True)
class Fault:
    """Why a name is not allowed; `offset` counts code points up to the offending character."""

    reason: str
    offset: int


class InvalidName(ValueError):  # noqa: N818 - the name says what it is
    """A name that ROS does not allow."""

    def __init__(self, name: str, fault: Fault) -> None:
        super().__init__(f"'{name}': {fault.reason}")
        self.name = name
        self.fault = fault


def node_name_fault(name: str) -> Fault | None:
    """Return why a node cannot be given this name, None where it can."""
    if _PLAIN_WORD.fullmatch(name) and "__" not in name and len(name) <= _LONGEST_NODE_NAME:
        return None
    return rmw_node_name_fault(name) or _double_underscore(name)


@lru_cache(maxsize=1024)
def namespace_fault(namespace: str) -> Fault | None:
    """Return why a node cannot be given this full namespace, None where it can; the root is `/`."""
    return rmw_namespace_fault(namespace) or _double_underscore(namespace)


def rmw_node_name_fault(name: str) -> Fault | None:
    """Return why a node cannot have this name; in code it may hold `__`, which a command line cannot give."""
    if len(name) <= _LONGEST_NODE_NAME and _PLAIN_WORD.fullmatch(name):
        return None
    if not name:
        return Fault("it must not be empty", 0)
    if stray := re.search(r"[^A-Za-z0-9_]", name):
        slash = ", the namespace is given apart" if stray[0] == "/" else ""
        return Fault(f"{_WORDS}, not '{stray[0]}'{slash}", stray.start())
    if name[0] in _DIGITS:
        return Fault("it must not start with a digit", 0)
    if len(name) > _LONGEST_NODE_NAME:
        return Fault(f"it is longer than {_LONGEST_NODE_NAME} characters", _LONGEST_NODE_NAME)
    return None


def rmw_namespace_fault(namespace: str) -> Fault | None:
    """Return why this cannot be a full namespace; in code it may hold `__`, which a command line cannot give."""
    return None if namespace == "/" else _path_fault(namespace, _LONGEST_NAMESPACE)


def full_topic_name_fault(name: str) -> Fault | None:
    """Return why this cannot be the full name of a topic or service, None where it can."""
    return _path_fault(name, _LONGEST_TOPIC_NAME)


@lru_cache(maxsize=1024)
def rule_name_fault(name: str) -> Fault | None:
    """Return why this cannot be a side of a remap rule of topics and services, None where it can.

    rcl's rules know less than its names: no braces, no `__`, no bare `~`.
    """
    if _PLAIN_TOPIC.fullmatch(name):
        return _double_underscore(name)
    if name == "~":
        return Fault("a rule cannot name '~' alone", 0)
    if brace := re.search(r"[{}]", name):
        return Fault(f"a rule cannot hold '{brace[0]}'", brace.start())
    return topic_name_fault(name) or _double_underscore(name)


def topic_name_fault(name: str) -> Fault | None:
    """Return why this cannot stand for a topic or service in a node, None where it can.

    The name may be absolute, relative or private (`~/scan`) and may hold '{node}', '{ns}' and '{namespace}'.
    """
    if _PLAIN_TOPIC.fullmatch(name):
        return None
    if not name:
        return Fault("it must not be empty", 0)
    if name[0] in _DIGITS:
        return Fault("no part may start with a digit", 0)
    if name.endswith("/"):
        return Fault("it must not end with '/'", len(name) - 1)
    if fault := _character_fault(name):
        return fault
    # rcl lets "~a" pass by accident (its check leaves out the last character) and makes it "/ns/nodea".
    if name[0] == "~" and name[1:2] not in ("", "/"):
        return Fault("'~' must be followed by '/'", 1)
    if part := re.search(r"/[0-9]", name):
        return Fault("no part may start with a digit", part.start() + 1)
    return _substitution_fault(name) or _repeated_slash(name)


@lru_cache(maxsize=1024)  # of many nodes few are in a namespace of their own
def joined(base: str | None, namespace: str | None) -> str | None:
    """Return the absolute namespace that upstream makes of a base and what is added to it; None for two Nones.

    An absolute namespace replaces the base; slashes at the end fall away (launch_ros, `prefix_namespace`).
    """
    if base is None and namespace is None:
        return None
    if namespace is not None and namespace.startswith("/"):
        whole = namespace
    else:
        whole = "/".join(part for part in ((base or "").rstrip("/"), namespace or "") if part)
    return "/" + whole.rstrip("/").removeprefix("/")


@lru_cache(maxsize=4096)  # that of a node is asked for time and again
def full_name(namespace: str, name: str) -> str:
    """Return the full name of a node in an absolute namespace."""
    return f"{namespace.rstrip('/')}/{name}"


def expanded(name: str, namespace: str, node: str) -> str:
    """Return the full name of a topic or service name used by a node; `namespace` is absolute.

    Raises `InvalidName` where the name cannot be one. The result may still be too long.
    """
    if fault := topic_name_fault(name):
        raise InvalidName(name, fault)
    if name.startswith("~"):
        name = full_name(namespace, node) + name[1:]
    if "{" in name:
        known = {"node": node, "ns": namespace, "namespace": namespace}
        name = _SUBSTITUTION.sub(lambda found: known[found[1]], name)
    return name if name.startswith("/") else full_name(namespace, name)


def mended(name: str, fault: Callable[[str], Fault | None]) -> str | None:
    """Return a name without what ROS does not allow in it, None where that alone does not help.

    Other characters become `_`, slashes that are too many and quotes go away, a number in front goes to the end,
    `${name}` and `(var name)` are what they are in a launch file.
    """
    if not name.isascii() or not re.search("[A-Za-z]", name):
        return None
    if _OF_A_SHELL.search(name):
        return _OF_A_SHELL.sub(_substitution, name)
    words = re.sub(r"[^A-Za-z0-9_/~{}]+", "_", name.strip(" '\":"))
    found = re.sub("//+", "/", re.sub("^~(?=[A-Za-z0-9_])", "~/", words))
    found = _NUMBERED.sub(_number_last, found.rstrip("/") or found)
    return None if found == name or fault(found) is not None else found


def _number_last(found: re.Match[str]) -> str:
    """Return a part of a name with the number in front at its end: `uav_2` for `2_uav`, `uav2` for `2uav`."""
    first, _, rest = found[0].partition("_")
    if rest:
        return f"{rest}_{first}"
    return found[0] if len(found[2]) < _SHORTEST else f"{found[2]}{found[1]}"


def _substitution(found: re.Match[str]) -> str:
    name = next(filter(None, found.groups()))
    return f"$({'env' if name.isupper() and (found[1] or found[2]) else 'var'} {name})"


def _path_fault(path: str, longest: int) -> Fault | None:
    """Check an absolute path of words, in the order in which rmw does."""
    if len(path) <= longest and _PLAIN_PATH.fullmatch(path):
        return None
    if not path:
        return Fault("it must not be empty", 0)
    if not path.startswith("/"):
        return Fault("it must start with '/'", 0)
    if path.endswith("/"):
        return Fault("it must not end with '/'", len(path) - 1)
    if stray := re.search(r"[^A-Za-z0-9_/]", path):
        return Fault(f"{_PATHS}, not '{stray[0]}'", stray.start())
    if broken := re.search(r"/([/0-9])", path):
        if broken[1] == "/":
            return Fault("it must not contain '//'", broken.start() + 1)
        return Fault("no part may start with a digit", broken.start() + 1)
    return Fault(f"it is longer than {longest} characters", longest - 1) if len(path) > longest else None


def _character_fault(name: str) -> Fault | None:
    """Check the characters of a topic name one by one: what may stand depends on the braces before it."""
    opened: int | None = None
    for offset, character in enumerate(name):
        if re.match(r"[A-Za-z0-9_]", character):
            if character in _DIGITS and opened == offset - 1:
                return Fault("a substitution must not start with a digit", offset)
        elif opened is not None and character != "}":
            return Fault(f"in braces {_WORDS}, not '{character}'", offset)
        elif character == "{":
            opened = offset
        elif character == "}":
            if opened is None:
                return Fault("'}' closes nothing", offset)
            opened = None
        elif character == "~" and offset:
            return Fault("'~' is allowed only at the beginning", offset)
        elif character not in "~/":
            return Fault(f"{_PATHS} (and '~' and braces), not '{character}'", offset)
    return None if opened is None else Fault("'{' is never closed", opened)


def _substitution_fault(name: str) -> Fault | None:
    for found in _SUBSTITUTION.finditer(name):
        if found[1] not in ("node", "ns", "namespace"):
            return Fault(f"'{found[0]}' is none of '{{node}}', '{{ns}}' and '{{namespace}}'", found.start())
    return None


def _double_underscore(name: str) -> Fault | None:
    offset = name.find("__")
    return None if offset < 0 else Fault("rcl's command line does not take '__'", offset)


def _repeated_slash(name: str) -> Fault | None:
    offset = name.find("//")
    return None if offset < 0 else Fault("it must not contain '//'", offset + 1)
