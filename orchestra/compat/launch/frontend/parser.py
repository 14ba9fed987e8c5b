"""`launch.frontend.Parser`: from entities to actions."""

from __future__ import annotations

import os
from contextlib import contextmanager
from importlib import import_module
from typing import TYPE_CHECKING, Any, ClassVar, Final

from orchestra.compat.launch.frontend.extensions import load_extensions, parsers_of_third_parties
from orchestra.compat.launch.frontend.invalid_frontend_launch_file_error import InvalidFrontendLaunchFileError
from orchestra.compat.launch.frontend.parse_substitution import (
    Given,
    parse_if_substitutions,
    parse_substitution,
    parse_written,
    replace_escaped_characters,
)
from orchestra.compat.launch.frontend.tags import class_of_tag
from orchestra.compat.launch.launch_description import LaunchDescription
from orchestra.compat.seam import connection

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from typing import TextIO

    from orchestra.compat.launch.action import Action
    from orchestra.compat.launch.frontend.entity import Entity
    from orchestra.compat.launch.substitution import Substitution
    from orchestra.description.source import Written

__all__ = ["InvalidFrontendLaunchFileError", "Parser"]

_LANGUAGES: Final = {"xml": "orchestra.compat.launch_xml", "yaml": "orchestra.compat.launch_yaml"}


class Parser:
    """Reads files, and makes actions of entities. The parser of a language says how its files are read.

    All methods can be called on the class, as they are upstream.
    """

    extensions_loaded: ClassVar[bool] = False
    _parsed: ClassVar[list[Entity]] = []  # the entities that are being parsed, outermost first

    @classmethod
    def load(cls, file: str | bytes | os.PathLike[str] | TextIO) -> tuple[Entity, Parser]:
        """Return the root of a file, by path or open, and the parser of its language.

        Raises `InvalidFrontendLaunchFileError`.
        """
        name, text = _read(file)
        return cls._language(name, text).load_text(text, name)

    @classmethod
    def load_text(cls, text: str, name: str) -> tuple[Entity, Parser]:
        """Return the same for a text that is read already; `name` is that of its file."""
        return cls._language(name, text).load_text(text, name)

    @classmethod
    def parse_description(cls, entity: Entity) -> LaunchDescription:
        """Return what a file describes. Raises `RuntimeError` where the root is not `launch`."""
        if entity.type_name != "launch":
            raise RuntimeError(f"the root of a launch file is 'launch', not '{entity.type_name}'")
        reason = entity.get_attr("deprecated", optional=True)
        actions = [cls.parse_action(child) for child in entity.children]
        return LaunchDescription(actions, deprecated_reason=reason)

    @classmethod
    def parse_action(cls, entity: Entity) -> Action:
        """Return an action. Raises `RuntimeError` for an unknown one, and whatever parsing it raises."""
        with cls._parsing(entity):
            kind, keywords = method_of(entity.type_name)(entity, cls)
            made: Any = kind(**keywords)
            entity.assert_entity_completely_parsed()
        if entity._span is not None:
            made._place = Given(entity._span)
        return made  # type: ignore[no-any-return]  # an action, or whatever a third party has made

    @classmethod
    def parse_substitution(cls, value: str) -> list[Substitution]:
        """Return the substitutions of a text."""
        written = cls._written(value)
        return parse_substitution(value) if written is None else parse_written(written)

    @classmethod
    def parse_if_substitutions(cls, value: Any) -> Any:
        """Return a value with its texts as substitutions, where they have any."""
        return parse_if_substitutions(value, cls.parse_substitution)

    @classmethod
    def escape_characters(cls, value: str) -> str:
        """Return a text without the backslashes that escape something."""
        return replace_escaped_characters(value)

    @classmethod
    def load_launch_extensions(cls) -> None:
        """Import the extensions that are installed."""
        load_extensions()

    @classmethod
    def load_parser_implementations(cls) -> None:
        """Find the parsers of all languages."""
        ours = {name: import_module(module).Parser for name, module in _LANGUAGES.items()}
        connection().front_end.exposures.parsers = {**parsers_of_third_parties(), **ours}

    @classmethod
    def get_parsers(cls) -> dict[str, type[Parser]]:
        """Return the parsers of all languages."""
        exposures = connection().front_end.exposures
        if not exposures.parsers:
            cls.load_parser_implementations()
        return exposures.parsers

    @classmethod
    def get_available_extensions(cls) -> list[str]:
        """Return the names of the languages."""
        return list(cls.get_parsers())

    @classmethod
    def is_extension_valid(cls, extension: str) -> bool:
        """Return whether a language is known."""
        return extension in cls.get_parsers()

    @classmethod
    def get_parser_from_extension(cls, extension: str) -> type[Parser]:
        """Return the parser of a language. Raises `RuntimeError` for an unknown one."""
        if extension not in cls.get_parsers():
            raise RuntimeError(f"there is no parser for '{extension}'")
        return cls.get_parsers()[extension]

    @classmethod
    def get_file_extensions(cls) -> set[str]:
        """Return what the names of files in the language end in."""
        return set()

    @classmethod
    def get_file_extensions_from_parsers(cls) -> set[str]:
        """Return the same for all languages."""
        return {ending for parser in cls.get_parsers().values() for ending in parser.get_file_extensions()}

    @classmethod
    def may_parse(cls, filename: str) -> bool:
        """Return whether the name of a file says that it is in the language."""
        return any(str(filename).endswith(f".{ending}") for ending in cls.get_file_extensions())

    @classmethod
    def is_filename_valid(cls, filename: str) -> bool:
        """Return whether the name of a file says that it is in a language that is known."""
        return any(parser.may_parse(filename) for parser in cls.get_parsers().values())

    @classmethod
    def get_parsers_from_filename(cls, filename: str) -> list[type[Parser]]:
        """Return the parsers, those first that the name of a file speaks for."""
        return sorted(cls.get_parsers().values(), key=lambda parser: not parser.may_parse(filename))

    @classmethod
    def _language(cls, name: str, text: str) -> type[Parser]:
        """Return the parser for a file: by its name; an element is XML, and anything else YAML."""
        found = [parser for parser in cls.get_parsers().values() if parser.may_parse(name)]
        if len(found) == 1:
            return found[0]
        return cls.get_parsers()["xml" if text.lstrip().startswith("<") else "yaml"]

    @classmethod
    @contextmanager
    def _parsing(cls, entity: Entity) -> Iterator[None]:
        cls._parsed.append(entity)
        try:
            yield
        finally:
            cls._parsed.remove(entity)

    @classmethod
    def _written(cls, text: str) -> Written | None:
        """Return where a text stands in the entity that is being parsed, None where nobody knows."""
        for entity in reversed(cls._parsed):
            found = list(entity._texts())
            for written in [item for item in found if item.text is text] or found:
                if written.text == text:
                    return written
        return None


def method_of(name: str) -> Callable[..., Any]:
    """Return what parses an action: ours, else a third party's. Raises `RuntimeError` for an unknown one."""
    kind = class_of_tag(name)
    method = kind.parse if kind is not None else exposed_action(name)
    if method is None:
        raise RuntimeError(f"there is no action '{name}'")
    return method


def exposed_action(name: str) -> Callable[..., Any] | None:
    """Return the parse method of a third party's action; where the name is unknown, extensions may bring it."""
    exposures = connection().front_end.exposures
    if name not in exposures.actions:
        load_extensions()
    return exposures.actions.get(name)


def exposed_substitution(name: str) -> Callable[..., Any] | None:
    """Return the parse method of a third party's substitution."""
    exposures = connection().front_end.exposures
    if name not in exposures.substitutions:
        load_extensions()
    return exposures.substitutions.get(name)


def _read(file: str | bytes | os.PathLike[str] | TextIO) -> tuple[str, str]:
    if isinstance(file, str | bytes | os.PathLike):
        with open(file, encoding="utf-8-sig") as stream:  # noqa: PTH123 - bytes are paths too
            return os.fsdecode(file), stream.read()
    return str(getattr(file, "name", "")), file.read()
