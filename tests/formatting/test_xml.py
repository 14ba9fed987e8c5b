"""XML files in their one form."""

from __future__ import annotations

import pytest

from orchestra.errors import Problems
from orchestra.formatting.formatted import WIDTH, formatted
from orchestra.formatting.xml_layout import xml_formatted

_CASES = {
    "elements": (
        "<launch><group><log message='a'></log></group>\n</launch>",
        '<launch>\n  <group>\n    <log message="a"/>\n  </group>\n</launch>\n',
    ),
    "what stands before the root": (
        '<?xml version="1.0"?><!-- x -->\n\n<?xml-model href="y"?>\n<!DOCTYPE launch>\n<launch/>\n',
        '<?xml version="1.0"?>  <!-- x -->\n\n<?xml-model href="y"?>\n<!DOCTYPE launch>\n<launch/>\n',
    ),
    "blanks in a tag": (
        '<launch>\n  <log   message = "a"\n     level="info"  />\n</launch  >\n',
        '<launch>\n  <log message="a" level="info"/>\n</launch>\n',
    ),
    "empty lines": (
        "<launch>\n\n\n  <reset/>\n\n\n\n  <reset/>\n\n</launch>\n\n",
        "<launch>\n  <reset/>\n\n  <reset/>\n</launch>\n",
    ),
    "entities, quotes and line breaks in values": (
        '<launch>\n  <log message=\'&quot;a&quot; &lt;&#65; "b"\'/>\n  <log message="a\n b"/>\n</launch>\n',
        '<launch>\n  <log message=\'&quot;a&quot; &lt;&#65; "b"\'/>\n  <log\n      message="a\n b"/>\n</launch>\n',
    ),
    "text": (
        '<launch>\n<arg name="a">  some\n text <b/> </arg>\n<param  name="x"><![CDATA[ <a> ]]></param></launch>\n',
        '<launch>\n  <arg name="a">  some\n text <b/> </arg>\n  <param name="x"><![CDATA[ <a> ]]></param>\n</launch>\n',
    ),
    "kept blanks": (
        '<launch>\n<arg xml:space="preserve"> <b/>   </arg></launch>\n',
        '<launch>\n  <arg xml:space="preserve"> <b/>   </arg>\n</launch>\n',
    ),
    "comments": (
        "<launch> <!-- a -->\n<!-- b\n     c\n  d -->\n<reset/>   <!-- e -->\n  <reset/><!-- f --><reset/>\n"
        "<!-- g --></launch> <!-- h -->\n",
        "<launch>  <!-- a -->\n  <!-- b\n       c\n    d -->\n  <reset/>   <!-- e -->\n  <reset/>\n  <!-- f -->\n"
        "  <reset/>\n  <!-- g -->\n</launch>  <!-- h -->\n",
    ),
    "comments in one column": (
        '<launch>\n <arg name="a"/>      <!-- a -->\n <arg name="bcd"/>    <!-- b -->\n</launch>\n',
        '<launch>\n  <arg name="a"/>      <!-- a -->\n  <arg name="bcd"/>    <!-- b -->\n</launch>\n',
    ),
}


@pytest.mark.parametrize(("written", "wanted"), _CASES.values(), ids=_CASES)
def test_a_text_has_one_form(written: str, wanted: str) -> None:
    assert xml_formatted(written, WIDTH) == wanted
    assert xml_formatted(wanted, WIDTH) == wanted


def test_attributes_that_do_not_fit_stand_on_lines_of_their_own() -> None:
    written = '<launch>\n  <node pkg="demo" exec="talker" name="talker">\n    <remap from="a" to="b"/>\n  </node>\n</launch>\n'
    assert xml_formatted(written, 60) == written
    assert xml_formatted(written, 40) == (
        '<launch>\n  <node\n      pkg="demo"\n      exec="talker"\n      name="talker">\n'
        '    <remap from="a" to="b"/>\n  </node>\n</launch>\n'
    )


@pytest.mark.parametrize(
    "text", ["<launch><node></launch>", "<launch", "<robot/>", "<launch>&a;</launch>", ""]
)
def test_what_is_no_launch_file_is_reported(text: str) -> None:
    problems = Problems()
    assert formatted(text.encode(), "a.launch.xml", lambda _text: "launch", problems) is None
    assert len(problems.errors) == 1
