"""The settings of a project."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from orchestra.dataclass import dataclass
from orchestra.errors import Code, Severity
from orchestra.fields import field
from orchestra.nearest import nearest
from orchestra.settings.globs import covers

OFF: Final = "off"
LEVELS: Final = (OFF, *(severity.value for severity in reversed(Severity)))

# Errors that nothing lowers: behind them something that was described is missing in the plan, or the plan itself.
LASTING: Final = frozenset(
    {
        *(
            Code.UNREADABLE_FILE,
            Code.SYNTAX,
            Code.DUPLICATE_KEY,
            Code.WRONG_TYPE,
            Code.MISSING_KEY,
            Code.UNKNOWN_ACTION,
        ),
        *(Code.UNKNOWN_SUBSTITUTION, Code.SUBSTITUTION_SYNTAX, Code.BAD_VALUE, Code.CONFLICTING_KEYS),
        *(Code.UNKNOWN_FORMAT, Code.UNDEFINED_VARIABLE, Code.UNSET_ENVIRONMENT, Code.MISSING_ARGUMENT),
        *(
            Code.NOT_A_CHOICE,
            Code.MISSING_PACKAGE,
            Code.BAD_CONDITION,
            Code.INCLUDE_CYCLE,
            Code.MISSING_FILE,
            Code.MISSING_EXECUTABLE,
        ),
        *(Code.BAD_EXPRESSION, Code.COMMAND_FAILED, Code.BAD_NAME, Code.NO_CURRENT_FILE, Code.USER_CODE),
        *(Code.NO_DESCRIPTION, Code.PARAMETER_SYNTAX, Code.PARAMETER_TYPE, Code.DEPENDENCY_CYCLE),
        *(Code.UNKNOWN_DEPENDENCY, Code.UNFIT_MACHINE),
    }
)


def code_meant(word: str) -> str | None:
    """Return the code that a word probably means which is none; None where that cannot be told."""
    codes = [code.value for code in Code]
    return word.upper() if word.upper() in codes else nearest(word.upper(), codes)


@dataclass(frozen=True, slots=True)
class Override:
    """Severities for files that one of the patterns means."""

    files: tuple[str, ...]
    severity: Mapping[str, str]


@dataclass(frozen=True, slots=True)
class Settings:
    """What stands in one settings file; patterns are relative to `folder`, where it is.

    `severity` has `off`, `note`, `warning` or `error` for codes. `strict` takes what are still warnings for errors.
    `exclude` names files that are left alone in folders.
    """

    folder: str = ""
    severity: Mapping[str, str] = field(default_factory=dict)
    overrides: tuple[Override, ...] = ()
    strict: bool = False
    exclude: tuple[str, ...] = ()

    def level(self, code: Code, path: str) -> str | None:
        """Return what is set for a code in a file, the last override that has it first; None where nothing is."""
        for override in reversed(self.overrides):
            if code in override.severity and any(self._means(text, path) for text in override.files):
                return override.severity[code]
        return self.severity.get(code)

    def excludes(self, path: str) -> bool:
        """Tell whether a file or folder is left alone."""
        return any(self._means(text, path) for text in self.exclude)

    def _means(self, text: str, path: str) -> bool:
        inside = f"{self.folder}/"
        return path.startswith(inside) and covers(text, path.removeprefix(inside))
