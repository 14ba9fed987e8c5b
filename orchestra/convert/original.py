"""The file that is to be converted: its actions as models, whatever language it is in.

A launch file in Python is run, as for every other use. Packages that are not here have a folder that does not exist:
nothing is looked up in them, and what code makes of the folder is turned back into the call that finds it.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from contextlib import contextmanager
from importlib.util import decode_source
from pathlib import Path
from typing import TYPE_CHECKING
from warnings import catch_warnings, filterwarnings

from orchestra.compat.seam import connected
from orchestra.dataclass import dataclass
from orchestra.description.entity import Action
from orchestra.description.text import Template
from orchestra.errors import DescriptionError, Problems
from orchestra.fields import field, replace
from orchestra.load.encodings import decoded
from orchestra.load.files import load
from orchestra.resolve.command_line import inputs_from
from orchestra.resolve.commands import run_command
from orchestra.resolve.packages import InstalledPackages
from orchestra.resolve.python.connection import LoadingConnection
from orchestra.resolve.python.isolation import isolated
from orchestra.resolve.resolve import begin

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.resolve.resolution import Resolution

LANGUAGES = ("yaml", "xml", "python")
_ENDINGS = {".yaml": "yaml", ".yml": "yaml", ".xml": "xml", ".py": "python"}
_ABSENT = Path("/folder of the package that is not here")


@dataclass(frozen=True, slots=True)
class Original:
    """What a launch file says.

    `places` maps folders of packages that its code has asked for to their calls; `environment` has the variables that
    its code has changed, None for one that it has removed.
    """

    path: str
    file: str
    language: str
    text: str
    actions: tuple[Action, ...]
    deprecated: Template | None
    places: Mapping[str, tuple[str, str]] = field(default_factory=dict)
    environment: Mapping[str, str | None] = field(default_factory=dict)


def language_of(path: str) -> str | None:
    """Return the language of a file by its name and, where it ends in `.launch`, by its text; None for any other."""
    ending = Path(path).suffix.lower()
    if ending != ".launch":
        return _ENDINGS.get(ending)
    try:
        return "xml" if decoded(Path(path).read_bytes()).lstrip().startswith("<") else "yaml"
    except (OSError, UnicodeError):
        return "xml"


@contextmanager
def opened(path: str, environment: Mapping[str, str]) -> Iterator[Original]:
    """Read a launch file; objects that its code has made can be asked as long as the context lasts.

    Raises `DescriptionError` where it cannot be read without a fault.
    """
    problems = Problems()
    inputs = inputs_from([], environment=environment)
    environment = inputs.environment
    packages = InstalledPackages(environment)

    def begin_alone(found: Problems) -> Resolution:
        return begin(inputs, found, load=load, packages=packages, run_command=run_command)

    with isolated(environment, ("ros2", "launch", path)) as isolation:
        asked = replace(inputs, launching=False)
        connection = _Asked(packages, begin_alone, isolation.prepare, problems=problems, inputs=asked)
        with connected(connection), catch_warnings():
            filterwarnings(
                "ignore", message="the share folder of "
            )  # which packages that are not here have not
            description = load(str(Path(path).absolute()), problems)
            if description is None or problems.errors:
                raise DescriptionError(problems.ordered)
            yield Original(
                description.path,
                description.file,
                language_of(path) or "",
                _text(path),
                description.actions,
                description.deprecated,
                connection.places,
                _changed(environment),
            )


def _text(path: str) -> str:
    """Return the text of a file that has been read before; Python has a way of its own to tell the encoding."""
    content = Path(path).read_bytes()
    return decode_source(content) if language_of(path) == "python" else decoded(content)


def _changed(environment: Mapping[str, str]) -> dict[str, str | None]:
    """Return what code has made of the environment."""
    names = [name for name in {**environment, **os.environ} if environment.get(name) != os.environ.get(name)]
    return {name: os.environ.get(name) for name in names}


class _Asked(LoadingConnection):
    """Remembers which folders of packages code has asked for; gives one to every package."""

    @property
    def places(self) -> dict[str, tuple[str, str]]:
        """The folders with the substitution and the package that they come from."""
        found: dict[str, tuple[str, str]] = self.__dict__.setdefault("_places", {})
        return found

    def package_prefix(self, package: str) -> str | None:
        """Return the install prefix of a package."""
        prefix = super().package_prefix(package) or str(_ABSENT / package)
        self.places.setdefault(prefix, ("find-pkg-prefix", package))
        return prefix

    def package_share(self, package: str) -> str | None:
        """Return the share folder of a package."""
        share = super().package_share(package) or str(_ABSENT / package / "share" / package)
        self.places.setdefault(share, ("find-pkg-share", package))
        return share
