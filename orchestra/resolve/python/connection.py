"""What compat objects reach where no `LaunchContext` is at hand: packages, and engines with a state of their own."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Final

from orchestra.errors import Problems
from orchestra.resolve.inputs import Inputs
from orchestra.resolve.python.environ import environment_now
from orchestra.resolve.refusals import missing_package, unset_environment

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from orchestra.compat.looks import Compiled
    from orchestra.compat.seam import Engine, FrontEnd
    from orchestra.errors import Severity
    from orchestra.resolve.packages import InstalledPackages
    from orchestra.resolve.python.codes import Codes
    from orchestra.resolve.resolution import Resolution

_INPUTS: Final = Inputs({})


class LoadingConnection:
    """Serves the launch files of one resolution. `begin` makes a state of its own for a context that users build.

    What comes up in such a state and stops nobody is reported to `problems`. `prepare` gets ready for their code;
    `inputs` say what is a fault of this host alone, and how much is told. Compiled code is kept for later plans:
    `codes` are a folder, None for nowhere, and the file at the top. That waits in `postponed` for a
    call, where it is given.
    """

    def __init__(
        self,
        packages: InstalledPackages,
        begin: Callable[[Problems], Resolution],
        prepare: Callable[[Compiled | None], None] = lambda _: None,
        *,
        problems: Problems | None = None,
        inputs: Inputs = _INPUTS,
        codes: tuple[str | None, str] = (None, ""),
        postponed: list[Callable[[], None]] | None = None,
    ) -> None:
        self.debug = inputs.debug
        self._prepare = prepare
        self._packages = packages
        self._begin = begin
        self._inputs = inputs
        self._place = codes
        self._postponed = postponed
        self._problems = Problems() if problems is None else problems

    def prepare(self, code: Compiled | None = None) -> None:
        """Get ready for code of a launch file, for this one where it is known."""
        self._prepare(code)

    @cached_property
    def front_end(self) -> FrontEnd:
        """The languages of XML and YAML files, for code that adds to them."""
        self.prepare()
        # Here, because few launch files ask for it.
        from orchestra.resolve.python.frontend import LoadingFrontEnd  # noqa: PLC0415

        return LoadingFrontEnd()

    @cached_property
    def _codes(self) -> Codes:
        # Here, because only launch files in Python need it.
        from orchestra.resolve.python.codes import Codes  # noqa: PLC0415

        return Codes(*self._place)

    def code(self, path: str, source: bytes) -> Compiled:
        """Return the code of a launch file in Python with this content. Raises what `compile` does."""
        return self._codes.code(path, source)

    def close(self) -> None:
        """Keep compiled code, and let what has been added to the languages be imported anew by the next resolution."""
        if "_codes" in vars(self) and self._codes.are_to_be_kept:
            (self._codes.keep() if self._postponed is None else self._postponed.append(self._codes.keep))
        if "front_end" in vars(self):
            self.front_end.close()

    def engine(self, argv: Sequence[str]) -> Engine:
        """Return an engine with a state of its own, for a context that a user builds."""
        del argv  # the context itself keeps the words
        engine: Engine = self._begin(self._problems).engine
        return engine

    def missing_package(self, package: str) -> tuple[Severity, str, str | None]:
        """Return what is to be said where code goes no further without a package, and the name that was meant."""
        missing = missing_package(package, self._packages.names(), self._inputs.weights.package)
        return missing.severity, missing.told, missing.meant

    def unset_environment(self, name: str) -> tuple[Severity, str, str | None]:
        """Return what is to be said where code goes no further without a variable, and the name that was meant."""
        unset = unset_environment(name, environment_now(), self._inputs.weights.variable)
        return unset.severity, unset.told, unset.meant

    def missing_file(self, path: str, file: str) -> tuple[Severity, str, str | None]:
        """Return what is to be said where code of a file goes no further without another, and the path meant."""
        from orchestra.resolve.lacking import missing_file  # noqa: PLC0415 - only what is not here needs it

        missing = missing_file(path, file, environment_now(), self._inputs.weights.variable)
        return missing.severity, missing.told, missing.meant

    def missing_program(self, name: str) -> tuple[Severity, str, str | None]:
        """Return what is to be said where code goes no further without a program, and the name that was meant."""
        from orchestra.resolve.lacking import missing_program  # noqa: PLC0415 - as above

        missing = missing_program(name, environment_now(), self._inputs.weights.program)
        return missing.severity, missing.told, missing.meant

    def missing_terminal(self) -> Severity:
        """Return how much it weighs that code goes no further without a terminal: as with a variable."""
        return self._inputs.weights.variable

    def package_prefix(self, package: str) -> str | None:
        """Return the install prefix of a package, None for an unknown one."""
        return self._packages.prefix(package)

    def package_share(self, package: str) -> str | None:
        """Return the share folder of a package, None for an unknown one."""
        return self._packages.share(package)

    def package_prefixes(self) -> dict[str, str]:
        """Return the install prefixes of all packages by name."""
        packages = self._packages
        prefixes = ((name, packages.prefix(name)) for name in packages.names())
        return {name: prefix for name, prefix in prefixes if prefix is not None}
