"""Plans of descriptions written in a format, without places: what is to be the same in every format."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from orchestra.errors import Problems
from orchestra.pipeline import collect, inputs_from
from orchestra.plan.codec import encode
from tests.load.written import WRITERS, Actions
from tests.load.written_python import as_python

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

_PLACES = {"location", "provenance", "line", "column", "end_line", "end_column"}


@dataclass(frozen=True)
class Planned:
    """A plan as data; its problems apart, each by its code and severity, in no order of places."""

    content: dict[str, Any]
    problems: tuple[tuple[str, str], ...]

    @property
    def failed(self) -> bool:
        """Whether there is an error."""
        return any(severity == "error" for _, severity in self.problems)

    @property
    def processes(self) -> list[dict[str, Any]]:
        """The processes."""
        found: list[dict[str, Any]] = self.content["processes"]
        return found

    @property
    def messages(self) -> list[str]:
        """What is logged when the run starts or a timer goes off."""
        steps = [step for trigger in self.content["triggers"] for step in trigger["do"]]
        return [step["message"] for step in steps if "message" in step]


def planned(
    folder: Path, language: str, actions: Actions, environment: Mapping[str, str], **inner: Actions
) -> Planned:
    """Return the plan of a description; `inner` are files that it includes, by name as `NAME.launch.yaml`."""
    for name, content in {"a": actions, **inner}.items():
        text = (as_python if language == "py" else WRITERS[language])(content)
        for other in inner:
            text = text.replace(f"{other}.launch.yaml", f"{other}.launch.{language}")
        (folder / f"{name}.launch.{language}").write_text(text, "utf-8")
    problems = Problems()
    path = folder / f"a.launch.{language}"
    plan = collect(str(path), inputs_from([], environment=environment), problems)
    assert plan is not None
    content = _same_ending(_without_places(encode(plan)), language)
    del content["problems"]
    return Planned(content, tuple(sorted((found.code.value, found.severity.value) for found in problems)))


def installed(folder: Path) -> dict[str, str]:
    """Install the package `demo` with the executable `tool` below a folder; return the environment to find it in."""
    prefix = folder / "prefix"
    tool, marker = prefix / "lib/demo/tool", prefix / "share/ament_index/resource_index/packages/demo"
    for path in (tool, marker, prefix / "share/demo/package.xml"):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()
    tool.chmod(0o755)
    return {"PATH": "/usr/bin:/bin", "AMENT_PREFIX_PATH": str(prefix)}


def _without_places(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _without_places(item) for key, item in value.items() if key not in _PLACES}
    return [_without_places(item) for item in value] if isinstance(value, list | tuple) else value


def _same_ending(value: Any, language: str) -> Any:
    """Return a plan with the names of launch files as if they had no format."""
    if isinstance(value, dict):
        return {key: _same_ending(item, language) for key, item in value.items()}
    if isinstance(value, list):
        return [_same_ending(item, language) for item in value]
    return value.replace(f".launch.{language}", ".launch") if isinstance(value, str) else value
