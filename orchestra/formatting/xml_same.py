"""What an XML text says, told so that two texts can be compared: how it is laid out does not count, all else does."""

from __future__ import annotations

from typing import Any
from xml.parsers import expat


def xml_sense(text: str) -> list[Any]:
    """Return what the parser finds: elements, attributes in order, texts, comments, instructions.

    Blanks between elements do not count, nor does how the lines of a comment are indented.
    """
    found: list[Any] = []
    parser = expat.ParserCreate("utf-8")
    parser.ordered_attributes = True
    parser.buffer_text = True
    parser.StartElementHandler = lambda name, attributes: found.append(("start", name, attributes))
    parser.EndElementHandler = lambda name: found.append(("end", name))
    parser.CharacterDataHandler = lambda data: found.append(("text", data))
    parser.CommentHandler = lambda data: found.append(
        ("comment", [line.strip() for line in data.split("\n")])
    )
    parser.ProcessingInstructionHandler = lambda target, data: found.append(("instruction", target, data))
    parser.StartCdataSectionHandler = lambda: found.append(("data",))
    parser.EndCdataSectionHandler = lambda: found.append(("end of data",))
    parser.XmlDeclHandler = lambda *declared: found.append(("declared", *declared))
    parser.StartDoctypeDeclHandler = lambda *declared: found.append(("document type", *declared))
    parser.Parse(text.encode("utf-8", "surrogatepass"), True)
    return [item for item in found if item[0] != "text" or item[1].strip()]
