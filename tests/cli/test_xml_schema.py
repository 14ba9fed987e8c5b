"""The XML Schema says what the loader says of the structure of launch files in XML."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest
import xmlschema

from orchestra.cli.schemas.table import FILES, OTHERS
from orchestra.errors import Code, Problems
from orchestra.load.files import load
from tests.mistakes.corpus import cases

_ROOT = Path(__file__).parents[2]
_STRUCTURE = {Code.UNKNOWN_KEY, Code.UNKNOWN_ACTION}


@cache
def _schema() -> xmlschema.XMLSchema:
    return xmlschema.XMLSchema(str(_ROOT / "schemas" / FILES["launch-xml"]))


def _faults(text: str) -> list[str]:
    return [str(error.reason) for error in _schema().iter_errors(text)]


_GOOD = [
    '<node pkg="a" exec="b"><param name="x" value="1,2" value-sep=","/><param from="x.yaml"/></node>',
    '<group if="$(var x)"><push-ros-namespace namespace="a"/><group><push_ros_namespace namespace="b"/></group></group>',
    '<executable cmd="a" launch-prefix="gdb"><env name="a" value="b"/><ready log="x"/></executable>',
    '<include file="a.launch.xml"><let name="a" value="b"/><arg name="c" value="d"/></include>',
    '<arg name="a"><choice value="b"/><choice value="c"/></arg>',
    '<group><for_each robot="[a, b]"/><log message="$(var robot)"/></group>',
    '<node exec="a" output="screen"/><node exec="b"><output stdout="log"/></node>',
    '<node exec="a" restart="always"/><node exec="b"><restart policy="always" delay="1"/></node>',
    '<set_parameter name="a"><param name="b" value="1"/></set_parameter>',
    "<reset/><shutdown/>",
]


@pytest.mark.parametrize("content", _GOOD)
def test_what_the_loader_takes_is_valid(tmp_path: Path, content: str) -> None:
    text, problems = f'<launch version="1.0" xmlns:x="urn:x" x:editor="yes">{content}</launch>', Problems()
    file = tmp_path / "a.launch.xml"
    file.write_text(text)
    load(str(file), problems)
    assert not problems.errors
    assert _faults(text) == []


_BAD = [
    '<node pkg="a" exce="b"/>',
    '<nod pkg="a" exec="b"/>',
    '<executable name="a"/>',
    '<node exec="b"><parm name="x" value="1"/></node>',
    '<group><node exec="b" nmae="c"/></group>',
    '<node exec="b"><log message="a"/></node>',
    "<let name='a'/>",
]


@pytest.mark.parametrize("content", _BAD)
def test_what_the_loader_refuses_is_invalid(tmp_path: Path, content: str) -> None:
    text, problems = f"<launch>{content}</launch>", Problems()
    file = tmp_path / "a.launch.xml"
    file.write_text(text)
    load(str(file), problems)
    assert problems.errors
    assert _faults(text)


def test_keys_and_actions_that_are_unknown_in_the_table_of_mistakes_are_invalid(tmp_path: Path) -> None:
    refused = 0
    for case in cases(_ROOT / "tests" / "mistakes" / "xml.txt", "case.launch.xml"):
        problems, file = Problems(), tmp_path / "case.launch.xml"
        file.write_text(case.files[case.main], "utf-8")
        if load(str(file), problems) is None:
            continue  # no XML
        if any(problem.code in _STRUCTURE for problem in problems.errors):
            assert _faults(case.files[case.main]), case.title
            refused += 1
    assert refused > 10


def test_every_attribute_and_element_is_explained() -> None:
    text = OTHERS["launch-xml"]()
    assert "<xs:documentation></xs:documentation>" not in text
    assert text.count("<xs:documentation>") == text.count("<xs:element ") + text.count("<xs:attribute ")
