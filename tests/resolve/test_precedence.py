"""Of all that is written for a parameter, a node has what rcl makes of upstream's command line."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from orchestra.plan.parameter_file import contents
from tests.resolve.launching import outcome

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

_PATTERNS = ("/**", "/ns/n", "/ns/*", "/**/n", "/*/n", "/other", "/ns/other")
_NAMES = st.sampled_from(["a", "b.c"])
_VALUES = st.sampled_from([1, 2, 3.5, True, "text", "5", [1, 2], ["x", "y"], [0.5]])


@dataclass(frozen=True, slots=True)
class _Single:
    name: str
    value: Any


@dataclass(frozen=True, slots=True)
class _File:
    sections: tuple[tuple[str, str, Any], ...]

    @property
    def text(self) -> str:
        """One document with a key per section: the patterns of a file differ."""
        return "".join(
            f"{pattern}:\n  ros__parameters:\n    {name}: {json.dumps(value)}\n"
            for pattern, name, value in self.sections
        )


_SINGLES = st.builds(_Single, _NAMES, _VALUES)
_FILES = st.builds(
    _File,
    st.lists(
        st.tuples(st.sampled_from(_PATTERNS), _NAMES, _VALUES),
        min_size=1,
        max_size=3,
        unique_by=lambda section: section[0],
    ).map(tuple),
)
_SOURCES = st.lists(_SINGLES | _FILES, max_size=3)
# For all nodes a text stands bare on upstream's command line: `5` is a number there, and lists are broken.
_EVERYWHERE = st.lists(
    _SINGLES.filter(lambda single: not isinstance(single.value, list) and single.value != "5") | _FILES,
    max_size=3,
)


def _description(everywhere: list[_Single | _File], own: list[_Single | _File], namespace: str | None) -> str:
    actions: list[dict[str, Any]] = []
    for index, source in enumerate(everywhere):
        if isinstance(source, _File):
            actions.append({"set_parameters_from_file": {"filename": f"all{index}.yaml"}})
        else:
            actions.append({"set_parameter": {"name": source.name, "value": source.value}})
    params = [
        {"from": f"own{index}.yaml"}
        if isinstance(source, _File)
        else {"name": source.name, "value": source.value}
        for index, source in enumerate(own)
    ]
    place = {"namespace": namespace} if namespace else {}
    actions.append({"node": {"exec": "sleep", "name": "n", **place, "param": params}})
    return json.dumps({"launch": actions})


def _upstream(
    everywhere: list[_Single | _File], own: list[_Single | _File], namespace: str | None
) -> list[Any]:
    """Return the ROS arguments that launch_ros writes; an item that is a list is the text of a file."""
    words: list[Any] = []
    for source in everywhere:
        if isinstance(source, _File):
            words += ["--params-file", [source.text]]
        else:
            words += ["-p", f"{source.name}:={source.value}"]
    for source in own:
        pattern = "/ns/n" if namespace else "/**"
        file = source if isinstance(source, _File) else _File(((pattern, source.name, source.value),))
        words += ["--params-file", [file.text]]
    return words


@pytest.mark.conforms("4.5 precedence of parameters", "4.6.5 order of patterns", "D19", "4.6.3 files")
@settings(
    max_examples=150,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
@given(everywhere=_EVERYWHERE, own=_SOURCES, namespace=st.sampled_from(["ns", None]))
def test_a_node_has_what_it_would_have_upstream(
    tmp_path: Path,
    ask_rcl: Callable[..., Any],
    everywhere: list[_Single | _File],
    own: list[_Single | _File],
    namespace: str | None,
) -> None:
    files = {"main.yaml": _description(everywhere, own, namespace)}
    for kind, sources in (("all", everywhere), ("own", own)):
        for index, source in enumerate(sources):
            if isinstance(source, _File):
                files[f"{kind}{index}.yaml"] = source.text
    found = outcome(tmp_path, files)
    assert not found.problems.errors
    (process,) = found.plan.processes
    place = {"namespace": f"/{namespace or ''}", "name": "n"}
    theirs = ask_rcl("node", arguments=["--ros-args", *_upstream(everywhere, own, namespace)], **place)
    assert json.loads(json.dumps(process.parameters)) == theirs["parameters"]
    ours = [word for text in contents(process).values() for word in ("--params-file", [text])]
    written = ask_rcl("node", arguments=["--ros-args", *ours], **place)
    assert written["parameters"] == theirs["parameters"]
