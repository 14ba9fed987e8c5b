"""Parameter files that are not in UTF-8 are told at the first byte that shows it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.cli.look.looker import Looker
from orchestra.cli.targets import targets
from orchestra.pipeline import inputs_from

if TYPE_CHECKING:
    from pathlib import Path

_LAUNCH = "launch:\n- node: {pkg: demo, exec: talker, param: [{from: params.yaml}]}\n"
_PARAMETERS = '# label\n/**:\n  ros__parameters:\n    label: "Greifer über dem Tisch"\n'


@pytest.mark.parametrize("main", ["params.yaml", "main.launch.yaml"])
def test_a_parameter_file_in_latin_1_is_told_at_its_place(tmp_path: Path, main: str) -> None:
    (tmp_path / "params.yaml").write_text(_PARAMETERS, "latin-1")
    (tmp_path / "main.launch.yaml").write_text(_LAUNCH, "utf-8")
    (target,) = targets([str(tmp_path / main)])
    found, _ = Looker(inputs_from((), environment={"PATH": "/bin"})).look(target)
    told = [(item.message, item.span) for item in found.problems if "UTF-8" in item.message]
    ((message, span),) = told
    assert message.startswith("this is not UTF-8: byte 0xfc")
    assert span is not None
    assert (span.file.rpartition("/")[2], span.line, span.column) == ("params.yaml", 4, 21)
