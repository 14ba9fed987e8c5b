"""A package of definitions with fields of every kind, written where a test wants it."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

DEFINITIONS = {
    "package.xml": "<package format='3'><name>own_interfaces</name><version>0.1.0</version></package>\n",
    "msg/Part.msg": "string<=10 name 'ab'\nfloat64[3] point [1, 2, 3]\nwstring wide 'wod'\nint64 BIG=-5\nstring S='hi'\n",
    "msg/Whole.msg": (
        "std_msgs/Header header\nPart[] parts\nPart one\nPart[2] two\nbool[] flags [true, false]\nbyte one_byte 5\n"
        "byte[] bytes\nchar letter 65\nwstring[<=3] wides\nstring<=4[2] words ['a', 'b,c']\nfloat32[<=2] few\n"
        "uint8[] many\nint16[2] pair\nbool[3] three\nuint64 last 18446744073709551615\nNothing[] nothings\n"
    ),
    "msg/Nothing.msg": "",
    "srv/Ask.srv": "Whole whole\nint32 number 4\n---\nbool ok\nWhole back\n",
    "action/Go.action": "Part target\n---\nstring[] notes\nfloat64 distance\n---\nfloat32 remaining\n",
}


def write(folder: Path) -> Path:
    """Write the package; return its folder."""
    for name, text in DEFINITIONS.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, "utf-8")
    return folder
