"""`orchestra pkg create`: the folder of a new Python package, which pip installs, and colcon builds too."""

from __future__ import annotations

import getpass
import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Final
from xml.sax.saxutils import escape, quoteattr

from orchestra.errors import RunError, UsageError

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.cli.parser import CommandParser

# REP 144, and what a module of Python may be called.
_NAME: Final = re.compile(r"[a-z]\w+", re.ASCII)
_MODULE: Final = re.compile(r"[A-Za-z]\w*", re.ASCII)
_MANIFEST: Final = """\
<?xml version="1.0"?>
<package format="{format}">
  <name>{name}</name>
  <version>0.0.0</version>
  <description>{description}</description>
  <maintainer email={email}>{maintainer}</maintainer>
  <license>{license}</license>
{depends}
  <export>
    <build_type>ament_python</build_type>
  </export>
</package>
"""
_SETUP: Final = """\
from setuptools import find_packages, setup

setup(
    name={name!r},
    version="0.0.0",
    description={description!r},
    license={license!r},
    maintainer={maintainer!r},
    maintainer_email={email!r},
    packages=find_packages(exclude=["test"]),
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/{name}"]),
        ("share/{name}", ["package.xml"]),
    ],
    install_requires=["setuptools"],
    entry_points={{"console_scripts": [{scripts}]}},
)
"""
_CONFIGURATION: Final = """\
[develop]
script_dir=$base/lib/{name}
[install]
install_scripts=$base/lib/{name}
"""
_NODE: Final = """\
import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node


class {class_name}(Node):
    def __init__(self) -> None:
        super().__init__("{node}")
        self.get_logger().info("Hello from {name}.")


def main() -> None:
    rclpy.init()
    try:
        rclpy.spin({class_name}())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass


if __name__ == "__main__":
    main()
"""


def creating(parser: CommandParser) -> None:
    """Add the options, with the names that they have in the ROS 2 tools."""
    parser.add_argument("package", metavar="PACKAGE", help="its name")
    parser.add_argument("--package-format", "--package_format", type=int, choices=(2, 3), default=3)
    parser.add_argument("--description", default="", metavar="TEXT", help="what it is for")
    parser.add_argument("--license", default="License to be declared", metavar="TEXT", help="its license")
    parser.add_argument(
        "--destination-directory", default=".", metavar="FOLDER", help="where its folder is made"
    )
    parser.add_argument(
        "--build-type",
        default="ament_python",
        choices=("ament_python", "ament_cmake", "cmake"),
        help="ament_python; the others want a ROS installation",
    )
    parser.add_argument("--dependencies", nargs="+", default=[], metavar="PACKAGE", help="what it needs")
    parser.add_argument("--maintainer-name", default="", metavar="NAME", help="(default: the user's)")
    parser.add_argument("--maintainer-email", default="", metavar="ADDRESS", help="of the maintainer")
    parser.add_argument("--node-name", metavar="NAME", help="a node to begin with")
    parser.add_argument("--library-name", metavar="NAME", help="a module to begin with")


def create(options: Namespace) -> tuple[str, object]:
    """Make the folder, and return what is told of it. Raises `UsageError` and `RunError`."""
    name = options.package
    if options.build_type != "ament_python":
        raise UsageError(f"packages of build type {options.build_type} are made where ROS is installed")
    for word, form in ((name, _NAME), (options.node_name, _MODULE), (options.library_name, _MODULE)):
        if word is not None and not form.fullmatch(word):
            raise UsageError(f"'{word}' is no name for it: letters, digits and underscores, a letter first")
    if name == "test":
        raise UsageError("a package called 'test' could not be told from its tests")
    folder = Path(options.destination_directory) / name
    if folder.exists():
        raise RunError(f"The directory already exists: {folder}")
    made = []
    for path, text in _files(options).items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(text, "utf-8")
        made.append(str(folder / path))
    text = "".join(f"creating {path}\n" for path in made)
    sys.stderr.write(f"'pip install -e {folder}' makes it known here\n")
    return text, {"package": name, "folder": str(folder), "files": made}


def _user() -> str:
    """Return the name of who asks; a number that no name is known for, as in a container, may ask too."""
    try:
        return getpass.getuser()
    except (KeyError, OSError):
        return "nobody"


def _files(options: Namespace) -> dict[str, str]:
    """Return the texts of all files by their paths in the folder."""
    name, node, library = options.package, options.node_name, options.library_name
    if node is not None and node == library:
        node = f"{node}_node"
    depends = dict.fromkeys([*(["rclpy"] if node else []), *options.dependencies])
    about = {
        "name": name,
        "description": options.description or f"The package {name}",
        "license": options.license,
        "maintainer": options.maintainer_name or _user(),
        "email": options.maintainer_email or "nobody@example.com",
    }
    escaped = {key: escape(value) for key, value in about.items()} | {"email": quoteattr(about["email"])}
    rows = "".join(f"  <depend>{escape(one)}</depend>\n" for one in depends)
    files = {
        "package.xml": _MANIFEST.format(**escaped, format=options.package_format, depends=rows),
        "setup.py": _SETUP.format(**about, scripts=repr(f"{node} = {name}.{node}:main") if node else ""),
        "setup.cfg": _CONFIGURATION.format(name=name),
        f"resource/{name}": "",
        f"{name}/__init__.py": "",
    }
    if node:
        class_name = "".join(word.capitalize() for word in node.split("_"))
        files[f"{name}/{node}.py"] = _NODE.format(class_name=class_name, node=node, name=name)
    if library:
        files[f"{name}/{library}/__init__.py"] = ""
    return files
