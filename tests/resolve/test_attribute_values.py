"""Texts of attributes in XML that are values of parameters."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Code
from orchestra.resolve.attribute_values import attribute_value
from tests.resolve.launching import outcome

if TYPE_CHECKING:
    from pathlib import Path


@pytest.mark.parametrize("text", ["[*]", "*", "[/tf, *]", "*.png", "@home", "%d", "`date`", "a: b: c", "*a"])
def test_what_pyyaml_cannot_read_stays_a_text(text: str) -> None:
    """As `coerce_to_type` of launch has it for the front ends."""
    assert attribute_value(text) == text


@pytest.mark.parametrize(("text", "value"), [("5", 5), ("'5'", "5"), ("[1, 2]", (1, 2)), ("robot", "robot")])
def test_what_it_can_read_is_typed(text: str, value: object) -> None:
    assert attribute_value(text) == value


@pytest.mark.parametrize("text", ["[1, 2", "[1,, 2]", "[a]]", "{a", "'x", "~", "{a: 1}", "[1, a]"])
def test_what_is_unfinished_or_no_parameter_is_told(text: str) -> None:
    with pytest.raises(ValueError, match=r"YAML|null|mapping|one type"):
        attribute_value(text)


def test_a_glob_of_rosbridge_is_a_parameter_in_xml(tmp_path: Path) -> None:
    text = """<launch><node pkg="demo" exec="talker" name="api"><param name="glob" value="[*]"/></node></launch>"""
    found = outcome(tmp_path, {"a.launch.xml": text}, launching=False)
    assert Code.PARAMETER_TYPE not in [code for code, *_ in found.faults]


def test_what_a_variable_gives_must_be_yaml(tmp_path: Path) -> None:
    """Upstream converts what comes of a substitution without keeping it a text."""
    text = """<launch><arg name="g" default="[*]"/>
    <node pkg="demo" exec="talker" name="api"><param name="glob" value="$(var g)"/></node></launch>"""
    found = outcome(tmp_path, {"a.launch.xml": text}, launching=False)
    assert Code.PARAMETER_TYPE in [code for code, *_ in found.faults]
