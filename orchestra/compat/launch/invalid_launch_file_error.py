"""`InvalidLaunchFileError`: a file that nobody can read as a launch file."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence


class InvalidLaunchFileError(Exception):
    """What each reader says of the file is in the message; the first of them is the cause."""

    def __init__(
        self,
        extension: str = "",
        *,
        likely_errors: Sequence[Exception] | None = None,
        launch_file_path: str | None = None,
    ) -> None:
        errors = tuple(likely_errors or ())
        self._extension = extension
        self._likely_errors = errors
        kind = f"a launch file ({extension})" if extension else "a launch file"
        lines = [f"{launch_file_path or 'the file'} cannot be read as {kind}"]
        lines += [f" - {type(error).__name__}: {error}" for error in errors]
        super().__init__("\n".join(lines))
        if errors:
            self.__cause__ = errors[0]
