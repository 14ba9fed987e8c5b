"""What compat objects ask of the stage that resolves: it hands an `Engine` to each `LaunchContext`.

Nothing here imports that stage, which stands above: it connects itself while launch files are loaded.
"""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, MutableMapping, Sequence
    from typing import Protocol

    from orchestra.compat.exposures import Exposures
    from orchestra.compat.looks import Compiled
    from orchestra.description.entity import Action, Entity
    from orchestra.description.source import Keyed, Written
    from orchestra.description.text import Template
    from orchestra.errors import Problem, Severity

else:  # only type checkers know what it adds, and three of them take 0.3 ms to make
    Protocol = object

EntityT = TypeVar("EntityT", bound="Entity")


class Engine(Protocol):
    """The state of one resolution, as Python launch files see it."""

    @property
    def configurations(self) -> MutableMapping[str, Any]:
        """The launch configurations of the current scope; writing sets them."""

    @property
    def environment(self) -> MutableMapping[str, str]:
        """The environment of the current scope; writing sets it for what follows."""

    @property
    def current_file(self) -> str | None:
        """The absolute path of the launch file that is being visited."""

    def evaluate(self, template: Template) -> str:
        """Return what a text comes to. Raises `SubstitutionFailure`."""

    def carry_out(self, action: Action) -> None:
        """Carry out an action in the current scope, at once."""

    def visit(self, entities: Iterable[Any]) -> None:
        """Visit Python entities depth-first, at once."""

    def loop(self) -> Any:
        """Return the event loop that runs, else one that keeps for the run what it is given."""

    def parameters(self) -> Sequence[tuple[str, Any]]:
        """Return what set_parameter put in scope, in order."""

    def load(self, path: str, language: str | None) -> Any:
        """Return the launch description of a file; `language` is `python`, `xml`, `yaml`, or None: by its name."""

    def register(self, handler: Any, *, first: bool) -> None:
        """Let an event handler wait for its event."""

    def unregister(self, handler: Any) -> None:
        """Let it wait no more. Raises `ValueError` where it does not wait."""

    def emit(self, event: Any) -> None:
        """Let an event happen, after the visit that is going on."""

    def handle_events(self) -> None:
        """Hand the events that have happened to the handlers that want them."""

    def would_handle(self, event: Any) -> bool:
        """Return whether a handler waits for such an event."""

    def push_configurations(self) -> None:
        """Remember the configurations; the present ones stay in force."""

    def pop_configurations(self) -> None:
        """Take up the configurations that were remembered last. Raises `RuntimeError` where none are."""

    def push_environment(self) -> None:
        """Remember the environment."""

    def pop_environment(self) -> None:
        """Take up the environment that was remembered last. Raises `RuntimeError` where none is."""

    def reset_environment(self) -> None:
        """Take up the environment with which the launch began."""

    def completed(self, action: Any) -> None:
        """Take note that an action of Python has been executed."""


class FrontEnd(Protocol):
    """The languages of XML and YAML files, for those who parse them in Python."""

    @property
    def exposures(self) -> Exposures:
        """What third parties have added to the language."""

    def tree(self, text: str, name: str, language: str) -> Any:
        """Return the tree of a file in `xml` or `yaml`. Raises `InvalidFrontendLaunchFileError`."""

    def entity(
        self, kind: type[EntityT], mapping: Keyed, needed: Mapping[str, Any]
    ) -> tuple[EntityT, tuple[Problem, ...]]:
        """Return the model of some keys, and what is wrong with those that it leaves out for that.

        `needed` are fields that it cannot be without.
        """

    def template(self, written: Written) -> Template:
        """Return a text with its substitutions. Raises `ValueError` where it has faults."""

    def close(self) -> None:
        """Let what has added to the language be imported anew when it is next needed."""


class Connection(Protocol):
    """The stage above, for objects that are used without a context of a resolution."""

    @property
    def front_end(self) -> FrontEnd:
        """The languages of XML and YAML files."""

    @property
    def debug(self) -> bool:
        """Whether what code of launch files raises is told with all calls on the way."""

    def prepare(self, code: Compiled | None = None) -> None:
        """Get ready for code of a launch file, for this one where it is known."""

    def code(self, path: str, source: bytes) -> Compiled:
        """Return the code of a launch file in Python with this content. Raises what `compile` does."""

    def close(self) -> None:
        """Let go of what has been made for this resolution alone, and keep what serves others."""

    def engine(self, argv: Sequence[str]) -> Engine:
        """Return an engine with a state of its own."""

    def missing_file(self, path: str, file: str) -> tuple[Severity, str, str | None]:
        """Return what is to be said where code of a file goes no further without another, and the path meant."""

    def missing_program(self, name: str) -> tuple[Severity, str, str | None]:
        """Return what is to be said where code goes no further without a program, and the name that was meant."""

    def missing_terminal(self) -> Severity:
        """Return how much it weighs that code goes no further without a terminal."""

    def package_prefixes(self) -> dict[str, str]:
        """Return the install prefixes of all packages by name."""

    def missing_package(self, package: str) -> tuple[Severity, str, str | None]:
        """Return what is to be said where code goes no further without a package, and the name that was meant."""

    def unset_environment(self, name: str) -> tuple[Severity, str, str | None]:
        """Return what is to be said where code goes no further without a variable, and the name that was meant."""

    def package_prefix(self, package: str) -> str | None:
        """Return the install prefix of a package."""

    def package_share(self, package: str) -> str | None:
        """Return the share folder of a package."""


_connections: list[Connection] = []


@contextmanager
def connected(connection: Connection) -> Iterator[None]:
    """Serve compat objects with a connection for a while."""
    _connections.append(connection)
    try:
        yield
    finally:
        _connections.remove(connection)
        connection.close()


def is_connected() -> bool:
    """Return whether launch files are being loaded."""
    return bool(_connections)


def connection() -> Connection:
    """Return the connection. Raises `RuntimeError` outside the loading of launch files."""
    if not _connections:
        raise RuntimeError("launch files are only understood while Orchestra loads one")
    return _connections[-1]


def debugging() -> bool:
    """Return whether what code of launch files raises is told with all calls on the way."""
    return bool(_connections) and _connections[-1].debug
