"""The table of formats: how a file of each is read, laid out, and compared with what it was."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import PurePath
from typing import Any, Final

from orchestra.dataclass import dataclass
from orchestra.errors import Problems
from orchestra.formatting.xml_layout import xml_formatted
from orchestra.formatting.xml_same import xml_sense
from orchestra.formatting.yaml_layout import yaml_formatted
from orchestra.formatting.yaml_same import yaml_sense
from orchestra.formatting.yaml_tree import LOADER
from orchestra.load import xml_file, yaml_file
from orchestra.load.reader import Reader
from orchestra.pyyaml import yaml
from orchestra.resolve.rcl.files import read_parameter_file


@dataclass(frozen=True, slots=True)
class Format:
    """`faults` reports what keeps a text from being read at all; `sense` is what the text says."""

    faults: Callable[[str, str, Problems], None]
    laid_out: Callable[[str, int], str]
    sense: Callable[[str], list[Any]]


def _launch_faults(text: str, file: str, problems: Problems) -> None:
    found = Problems()
    if yaml_file.read(text, file, Reader(found)) is None:
        problems.extend(found.errors)


def _xml_faults(text: str, file: str, problems: Problems) -> None:
    found = Problems()
    if xml_file.read(text, file, Reader(found)) is None:
        problems.extend(found.errors)


def _parameter_faults(text: str, file: str, problems: Problems) -> None:
    """Report what is no YAML; what rcl refuses beyond that is for `orchestra check` to tell."""
    try:
        for _ in yaml.parse(text, Loader=LOADER):
            pass
    except yaml.YAMLError:
        found = Problems()
        read_parameter_file(text, file, found)
        problems.extend(found.errors)


FORMATS: Final = {
    "launch.xml": Format(_xml_faults, xml_formatted, xml_sense),
    "launch.yaml": Format(_launch_faults, yaml_formatted, lambda text: yaml_sense(text, parameters=False)),
    "parameters": Format(_parameter_faults, yaml_formatted, lambda text: yaml_sense(text, parameters=True)),
}


def format_of(name: str, kind: str, text: str) -> Format:
    """Return the format of a file by its name, its kind (`launch` or `parameters`) and its text."""
    if kind == "parameters":
        return FORMATS["parameters"]
    ending = PurePath(name).suffix.lower()
    xml = ending == ".xml" or (ending not in (".yaml", ".yml") and text.lstrip().startswith("<"))
    return FORMATS["launch.xml" if xml else "launch.yaml"]
