"""`orchestra pkg`: the packages that are installed, and new ones."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Final

from orchestra.cli.boundary import OK
from orchestra.cli.ros.options import flag, word
from orchestra.cli.ros.pkg_create import create, creating
from orchestra.cli.ros.verbs import Verb, VerbParser
from orchestra.errors import RunError
from orchestra.nearest import nearest
from orchestra.resolve.packages import InstalledPackages

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Callable

    from orchestra.cli.parser import CommandParser


def _tag(parser: CommandParser) -> None:
    parser.add_argument("-t", "--tag", metavar="TAG", help="only what stands in this element")


_PACKAGE: Final = word("package", "its name")
_VERBS: Final = {
    "list": Verb("list the packages", ""),
    "prefix": Verb(
        "show where a package is installed", "", (_PACKAGE, flag("--share", tell="its share folder instead"))
    ),
    "executables": Verb(
        "list the executables of a package, or of all",
        "",
        (
            word("package", "its name (default: all of them)", optional=True),
            flag("--full-path", tell="where they are instead of their names"),
        ),
    ),
    "xml": Verb("show the package.xml of a package", "", (_PACKAGE, _tag)),
    "create": Verb("make the folder of a new Python package", "", (creating,)),
}


def parser() -> VerbParser:
    """Return what the command understands."""
    return VerbParser("pkg", "Show the packages that are installed.", _VERBS)


def run(options: Namespace) -> int:
    """Answer."""
    answers: dict[str, Callable[[InstalledPackages, Namespace], tuple[str, object]]] = {
        "list": _list,
        "prefix": _prefix,
        "executables": _executables,
        "xml": _xml,
        "create": lambda _packages, options: create(options),
    }
    text, data = answers[options.verb](InstalledPackages(os.environ), options)
    sys.stdout.write(json.dumps(data) + "\n" if options.format == "json" else text)
    return OK


def _list(packages: InstalledPackages, _options: Namespace) -> tuple[str, object]:
    names = packages.names()
    return "".join(f"{name}\n" for name in names), names


def _prefix(packages: InstalledPackages, options: Namespace) -> tuple[str, object]:
    found = (packages.share if options.share else packages.prefix)(options.package)
    if found is None:
        raise _unknown(packages, options.package)
    return f"{found}\n", found


def _executables(packages: InstalledPackages, options: Namespace) -> tuple[str, object]:
    if options.package is not None and packages.prefix(options.package) is None:
        raise _unknown(packages, options.package)
    wanted = packages.names() if options.package is None else (options.package,)
    rows = [(package, name) for package in wanted for name in packages.executables(package)]
    if options.full_path:
        commands = [(packages.executable(*row) or (), row) for row in rows]
        paths = [" ".join(command) for command, _ in commands]
        return "".join(f"{path}\n" for path in paths), paths
    data = [{"package": package, "executable": name} for package, name in rows]
    return "".join(f"{package} {name}\n" for package, name in rows), data


def _xml(packages: InstalledPackages, options: Namespace) -> tuple[str, object]:
    share = packages.share(options.package)
    if share is None:
        raise _unknown(packages, options.package)
    path = Path(share) / "package.xml"
    if not path.is_file():  # of a Python package that was installed where it stands, it is beside its folder
        path = Path(share).parent / "package.xml"
    if not path.is_file():
        raise RunError(f"package {options.package} has no package.xml in {share}")
    text = path.read_text("utf-8")
    from xml.etree import ElementTree as ET  # noqa: PLC0415 - heavy, and only this verb needs it

    try:
        root = ET.fromstring(text)  # noqa: S314 - a file of this installation
    except ET.ParseError as error:
        raise RunError(f"{path}: {error}") from None
    if options.tag is None:
        return ET.tostring(
            root, "unicode"
        ) + "\n", text  # as the ROS 2 tools: without what stands before the root
    found = root.findall(options.tag) or root.findall(f".//{options.tag}")
    if not found:
        raise RunError(f"{path} has no element {options.tag}")
    values = [element.text or "" for element in found]
    return "".join(f"{value}\n" for value in values), values


def _unknown(packages: InstalledPackages, name: str) -> RunError:
    near = nearest(name, packages.names())
    return RunError(f"Package not found: '{name}'" + (f"; did you mean {near}?" if near else ""))
