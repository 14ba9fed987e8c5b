"""Whatever a file looks like, formatting changes its looks alone, and once.

What a file says and which comments it has is told here by other means than the formatter's own.
"""

from __future__ import annotations

import re
from typing import Any
from xml.etree import ElementTree as ET

import pytest
import yaml
from hypothesis import HealthCheck, given, reject, settings
from hypothesis import strategies as st

from orchestra.errors import Problems
from orchestra.formatting.formatted import formatted
from orchestra.formatting.refusal import NotFormatted
from tests.formatting.texts import xml_texts, yaml_texts

_OFTEN = settings(max_examples=80, deadline=None, suppress_health_check=list(HealthCheck))
_VERY_OFTEN = settings(_OFTEN, max_examples=20_000)
_WIDTHS = st.sampled_from((120, 40))


def _values(text: str) -> list[Any]:
    """Return the documents as trees of texts and styles; a key may stand twice."""
    try:
        return [_value(node) for node in yaml.compose_all(text, yaml.CBaseLoader)]
    except yaml.composer.ComposerError:
        reject()  # two anchors of one name


def _value(node: yaml.Node) -> Any:
    if isinstance(node, yaml.ScalarNode):
        return node.value, node.style, node.tag
    if isinstance(node, yaml.SequenceNode):
        return [_value(item) for item in node.value]
    assert isinstance(node, yaml.MappingNode)
    return {index: (_value(key), _value(value)) for index, (key, value) in enumerate(node.value)}


def _elements(element: ET.Element) -> Any:
    texts = [element.text or "", *(child.tail or "" for child in element)]
    mixed = texts if any(text.strip() for text in texts) else []
    return element.tag, list(element.attrib.items()), mixed, [_elements(child) for child in element]


def _parsed(text: str) -> Any:
    return _elements(ET.fromstring(text))  # noqa: S314 - the texts are made here


def _once(text: str, name: str, kind: str, width: int) -> str:
    """Return a text formatted; one with something in it that has no form is none of the cases."""
    try:
        content = formatted(text.encode(), name, lambda _text: kind, Problems(), width)
    except NotFormatted as reason:
        if "fault" in str(reason):
            raise
        content = None
    if content is None:
        reject()
    assert formatted(content, name, lambda _text: kind, Problems(), width) == content
    return content.decode()


def _check_yaml(text: str, kind: str, width: int) -> None:
    after = _once(text, "a.yaml", kind, width)
    assert _values(after) == _values(text)
    assert re.findall(r"#c\d+", after) == re.findall(r"#c\d+", text)


def _check_xml(text: str, width: int) -> None:
    after = _once(text, "a.launch.xml", "launch", width)
    assert _parsed(after) == _parsed(text)
    assert re.findall(r"c\d+c", after) == re.findall(r"c\d+c", text)


@pytest.mark.timeout(600)
@_OFTEN
@given(yaml_texts(), st.sampled_from(("launch", "parameters")), _WIDTHS)
def test_any_yaml_file_stays_what_it_is(text: str, kind: str, width: int) -> None:
    _check_yaml(text, kind, width)


@pytest.mark.timeout(600)
@_OFTEN
@given(xml_texts(), _WIDTHS)
def test_any_xml_file_stays_what_it_is(text: str, width: int) -> None:
    _check_xml(text, width)


@pytest.mark.long
@pytest.mark.timeout(1800)
@_VERY_OFTEN
@given(yaml_texts(), st.sampled_from(("launch", "parameters")), _WIDTHS)
def test_very_many_yaml_files_stay_what_they_are(text: str, kind: str, width: int) -> None:
    _check_yaml(text, kind, width)


@pytest.mark.long
@pytest.mark.timeout(1800)
@_VERY_OFTEN
@given(xml_texts(), _WIDTHS)
def test_very_many_xml_files_stay_what_they_are(text: str, width: int) -> None:
    _check_xml(text, width)
