"""Texts with substitutions as expressions of Python: objects instead of `$(...)`."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from orchestra.convert.python.code import Bracket, Code, Element, a_list, call, string
from orchestra.convert.python.imports import PARAMETER_SUBSTITUTION
from orchestra.convert.remarks import UnsayableError
from orchestra.convert.texts import normal

if TYPE_CHECKING:
    from orchestra.description.text import Template
    from orchestra.location import Span

Parts: TypeAlias = tuple[Any, ...]

# Classes whose arguments are those of the call, in order.
_PLAIN: Final = {
    "all": "AllSubstitution",
    "and": "AndSubstitution",
    "anon": "AnonName",
    "any": "AnySubstitution",
    "dirname": "ThisLaunchFileDir",
    "equals": "EqualsSubstitution",
    "exec-in-pkg": "ExecutableInPackage",
    "file-content": "FileContent",
    "filename": "ThisLaunchFile",
    "find-pkg-prefix": "FindPackagePrefix",
    "find-pkg-share": "FindPackageShare",
    "launch_log_dir": "LaunchLogDir",
    "not": "NotSubstitution",
    "not-equals": "NotEqualsSubstitution",
    "or": "OrSubstitution",
}
# Classes whose last arguments have keywords.
_KEYWORDS: Final = {
    "command": ("Command", ("", "on_stderr")),
    "env": ("EnvironmentVariable", ("", "default_value")),
    "find-exec": ("FindExecutable", ("name",)),
    "var": ("LaunchConfiguration", ("", "default")),
    "yaml-value": ("YamlValue", ("", "", "default")),
}
_FOLDERS: Final = frozenset({"dirname", "find-pkg-prefix", "find-pkg-share"})


class Texts:
    """Writes texts; `used` are the names that must be imported."""

    def __init__(self) -> None:
        self.used: set[str] = set()

    def name(self, name: str) -> str:
        """Return a name, which is in use from now on."""
        self.used.add(name)
        return name.rpartition(" ")[2]

    def of(self, template: Template) -> Code:
        """Return the expression for a text: a string, an object, or a list of both. Raises `UnsayableError`."""
        return self._parts(normal(template), template.span)

    def whole(self, template: Template) -> Code:
        """Return the same where a list means several values: what is concatenated is one object."""
        code = self.of(template)
        if isinstance(code, Bracket) and code.start == "[":
            return call(self.name("StringJoinSubstitution"), [Element(code)])
        return code

    def key(self, template: Template) -> Code:
        """Return the same as the key of a dictionary, where a list cannot stand."""
        code = self.of(template)
        return Bracket("(", code.elements, ")") if isinstance(code, Bracket) and code.start == "[" else code

    def substitution(self, template: Template) -> Code:
        """Return an expression that is an object, or a list of them, for a text too."""
        constant = template.constant
        if constant is None:
            return self.of(template)
        return call(self.name("TextSubstitution"), [Element(string(constant), "text=")])

    def _parts(self, parts: Parts, span: Span) -> Code:
        found = [self._part(part, span) for part in parts]
        if not found:
            return string("")
        path = self._path(parts, span)
        if path is not None:
            return path
        return found[0] if len(found) == 1 else a_list(found)

    def _path(self, parts: Parts, span: Span) -> Code | None:
        """Return a folder with a relative path behind it as people write it, None for anything else."""
        match parts:
            case (tuple(folder), str(rest)) if folder[0] in _FOLDERS and _is_path(rest):
                components = [self._part(folder, span), *map(string, rest[1:].split("/"))]
                return call(self.name("PathJoinSubstitution"), [Element(a_list(components))])
        return None

    def _part(self, part: Any, span: Span) -> Code:  # noqa: ANN401 - a part of a description, whatever it is
        if isinstance(part, str):
            return string(part)
        if isinstance(part, int):
            raise UnsayableError("only its own code knows what this substitution comes to", span)
        name, *arguments = part
        return _WRITERS.get(name, _call)(self, name, [self._parts(item, span) for item in arguments], part)


def _call(texts: Texts, name: str, arguments: list[Code], part: Parts) -> Code:
    del part
    if name in _PLAIN:
        return call(texts.name(_PLAIN[name]), map(Element, arguments))
    written, keywords = _KEYWORDS[name]
    pairs = zip(arguments, keywords, strict=False)
    return call(texts.name(written), (Element(item, f"{key}=" if key else "") for item, key in pairs))


def _joined(texts: Texts, name: str, arguments: list[Code], part: Parts) -> Code:
    del name, part
    return call(texts.name("PathJoinSubstitution"), [Element(a_list(arguments))])


def _texts(texts: Texts, name: str, arguments: list[Code], part: Parts) -> Code:
    del name, part
    delimiter, *items = arguments
    return call(
        texts.name("StringJoinSubstitution"), [Element(a_list(items)), Element(delimiter, "delimiter=")]
    )


def _parameter(texts: Texts, name: str, arguments: list[Code], part: Parts) -> Code:
    del name, part
    pairs = zip(arguments, ("", "default="), strict=False)
    return call(texts.name(PARAMETER_SUBSTITUTION), (Element(item, lead) for item, lead in pairs))


def _choice(texts: Texts, name: str, arguments: list[Code], part: Parts) -> Code:
    """Return one of two values; the class refuses two empty ones."""
    del name
    _, _, *values = part
    if not any(values):
        return string("")
    given = arguments if part[3] else arguments[:2]
    return call(texts.name("IfElseSubstitution"), map(Element, given))


def _expression(texts: Texts, name: str, arguments: list[Code], part: Parts) -> Code:
    del name
    elements = [Element(arguments[0])]
    if len(arguments) > 1:
        modules = part[2]
        constant = len(modules) == 1 and isinstance(modules[0], str)
        names = [string(word.strip()) for word in modules[0].split(",")] if constant else [arguments[1]]
        elements.append(Element(a_list(names)))
    return call(texts.name("PythonExpression"), elements)


def _is_path(text: str) -> bool:
    return len(text) > 1 and text[0] == "/" and all(text[1:].split("/"))


_Writer: TypeAlias = Callable[[Texts, str, list[Code], Parts], Code]
_WRITERS: Final[dict[str, _Writer]] = {
    "eval": _expression,
    "if": _choice,
    "param": _parameter,
    "path-join": _joined,
    "string-join": _texts,
}
