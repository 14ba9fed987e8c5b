"""The launch language for Python code that parses it: `orchestra.compat.seam.FrontEnd`, by the loaders' own readers."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

from orchestra.compat.exposures import Exposures
from orchestra.compat.launch.frontend.invalid_frontend_launch_file_error import InvalidFrontendLaunchFileError
from orchestra.description.source import Keyed
from orchestra.errors import Problems
from orchestra.load.grammar import parse_template
from orchestra.load.offsets import source
from orchestra.load.placed import placed
from orchestra.load.reader import Reader
from orchestra.load.xml_parser import NotXmlError, parse
from orchestra.location import displayed

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.compat.launch_xml.element import PlacedElement
    from orchestra.compat.seam import EntityT
    from orchestra.description.source import Written
    from orchestra.description.text import Template
    from orchestra.errors import Problem


class InvalidSubstitutionError(ValueError):
    """A text that is not written as substitutions are; `problems` say why."""

    def __init__(self, problems: tuple[Problem, ...]) -> None:
        super().__init__(problems[0].message)
        self.problems = problems


class FaultyFileError(InvalidFrontendLaunchFileError):
    """A file that is not written in its language; `problems` say why."""

    def __init__(self, language: str, problems: tuple[Problem, ...]) -> None:
        super().__init__(language, likely_errors=[ValueError(problem.message) for problem in problems])
        self.problems = problems


class LoadingFrontEnd:
    """Serves the launch files of one resolution."""

    def __init__(self) -> None:
        self.exposures = Exposures()

    def tree(self, text: str, name: str, language: str) -> Any:
        """Return the tree of a file. Raises `InvalidFrontendLaunchFileError`; its `problems` say why."""
        problems = Problems()
        read = _xml if language == "xml" else _yaml
        tree = read(text, displayed(name) if name else "<string>", Reader(problems))
        if problems.errors:
            raise FaultyFileError(language, problems.errors)
        return tree

    def entity(
        self, kind: type[EntityT], mapping: Keyed, needed: Mapping[str, Any]
    ) -> tuple[EntityT, tuple[Problem, ...]]:
        """Return the model of some keys, and what is wrong with those that it leaves out for that."""
        problems = Problems()
        whole = Keyed(mapping.span, mapping.head)
        for name, value in (*mapping.items(), *needed.items()):
            whole.put(name, value, mapping.keys_at.get(name, mapping.head))
        return kind.model_validate(whole, context=Reader(problems)), problems.errors

    def template(self, written: Written) -> Template:
        """Return a text with its substitutions. Raises `InvalidSubstitutionError`."""
        problems = Problems()
        template = parse_template(written.text, written.spans, problems, quoted=written.quoted)
        if problems.errors:
            raise InvalidSubstitutionError(problems.errors)
        return template

    def close(self) -> None:
        """Let what has added to the language be imported anew by the next resolution."""
        packages = self.exposures.packages()
        for name in [name for name in sys.modules if name.partition(".")[0] in packages]:
            del sys.modules[name]


def _xml(text: str, file: str, reader: Reader) -> PlacedElement | None:
    whole = source(file, text)
    try:
        return placed(parse(whole), whole)
    except NotXmlError as error:
        fault = error.fault
        reader.error(fault.code, fault.message, fault.span, suggestion=fault.suggestion, notes=fault.notes)
        return None


def _yaml(text: str, file: str, reader: Reader) -> Any:
    from orchestra.load import yaml_file  # noqa: PLC0415 - it takes PyYAML

    return yaml_file.read(text, file, reader)
