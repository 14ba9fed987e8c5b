"""Plans as graphs, read by the programs that draw them."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from orchestra.errors import UsageError
from orchestra.plan.conditions import Dependency
from orchestra.plan.model import Component, Plan, Provenance
from orchestra.plan.reactions import LoadAction, LogAction, StartAction, Trigger, TriggerEvent
from orchestra.plan.render import dot, mermaid, svg
from orchestra.plan.render.formats import FORMATS
from tests.plan.records import at, node, plan, process, words

_DOT = shutil.which("dot")
with_graphviz = pytest.mark.skipif(_DOT is None, reason="Graphviz is not installed")


def _component(identity: str, container: str) -> Component:
    namespace, _, name = identity.rpartition("/")
    return Component(
        id=identity,
        name=name,
        namespace=namespace,
        package="image",
        plugin="image::Camera",
        container=container,
        process=container,
        condition="started",
        parameters={},
        remappings=(),
        extra_arguments={},
        lifecycle=None,
        location=at(6),
        provenance=Provenance(),
    )


def _whole() -> Plan:
    edges = (Dependency("/sim", "ready", None, at(9)), Dependency("gone", "started", None, at(9)))
    trigger = Trigger(
        "t1",
        TriggerEvent("process_exited", "/sim"),
        (LogAction('say "so"', at(5)), StartAction("tool", at(5)), LoadAction("/r/cam", at(5))),
        2.0,
        deferred=False,
        location=at(5),
    )
    return plan(
        node("/sim", package="demo", executable="sim"),
        node("/r/a/ekf", depends_on=edges),
        node("/r/box", kind="container"),
        process("tool"),
        components=(_component("/r/cam", "/r/box"),),
        triggers=(trigger,),
    )


def test_mermaid_has_namespaces_nodes_and_edges() -> None:
    assert FORMATS["mermaid"](_whole()) == (
        "flowchart LR\n"
        '  p4["tool<br/>true"]\n'
        '  t1{{"2 s after the end of /sim<br/>log #39;say #34;so#34;#39;<br/>start tool<br/>load /r/cam"}}\n'
        '  p1("/sim<br/>demo/sim")\n'
        '  subgraph g_2f_r ["/r"]\n'
        '    p3[["/r/box<br/>true"]]\n'
        '    c1(["/r/cam<br/>image/image#58;#58;Camera"])\n'
        '    subgraph g_2f_r_2f_a ["/r/a"]\n'
        '      p2("/r/a/ekf<br/>true")\n'
        "    end\n"
        "  end\n"
        '  p1 -->|"ready"| p2\n'
        '  p3 -.->|"holds"| c1\n'
        "  p1 -.-> t1\n"
        '  t1 -.->|"start"| p4\n'
        '  t1 -.->|"load"| c1\n'
    )


def _drawn(source: str, *options: str) -> bytes:
    done = subprocess.run(
        ["dot", *options], input=source.encode(), capture_output=True, timeout=60, check=False
    )
    assert (done.returncode, done.stderr) == (0, b"")
    return done.stdout


@with_graphviz
def test_graphviz_reads_the_same_graph() -> None:
    graph = json.loads(_drawn(FORMATS["dot"](_whole()), "-Tjson"))
    objects = {entry["_gvid"]: entry for entry in graph["objects"]}
    clusters = {entry["label"] for entry in objects.values() if entry["name"].startswith("cluster")}
    edges = {
        (objects[edge["tail"]]["name"], edge.get("label", ""), objects[edge["head"]]["name"])
        for edge in graph["edges"]
    }
    assert clusters == {"/r", "/r/a"}
    assert edges == {
        *(("p1", "ready", "p2"), ("p3", "holds", "c1"), ("p1", "", "t1")),
        *(("t1", "start", "p4"), ("t1", "load", "c1")),
    }


@with_graphviz
@given(words, words)
@settings(max_examples=15, deadline=None)
def test_labels_in_an_image_say_what_they_should(one: str, other: str) -> None:
    made = plan(process(f"a{one}", f"b{other}", executable=f"b{other}"), file=f"f{one}")
    image = ET.fromstring(svg.render(made))  # noqa: S314 - Graphviz has written it
    texts = ["".join(text.itertext()) for text in image.iter("{http://www.w3.org/2000/svg}text")]
    assert [_seen(text) for text in texts] == [_seen(f"f{one}"), _seen(f"a{one}"), _seen(f"b{other}")]


def _seen(text: str) -> str:
    """Return what can be seen of a text: blanks of all kinds are one in an image."""
    shown = "".join(character if character.isprintable() else "\ufffd" for character in text)
    return "".join(shown.replace("\xa0", " ").split())


def test_without_graphviz_an_image_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    with pytest.raises(UsageError, match="Graphviz"):
        FORMATS["svg"](_whole())


_PARSE = """\
import { JSDOM } from 'jsdom';
const page = new JSDOM('');
globalThis.window = page.window; globalThis.document = page.window.document;
const { default: mermaid } = await import('mermaid');
let text = '';
for await (const part of process.stdin) text += part;
const failed = [];
for (const one of text.split('\\0')) {
  try { await mermaid.parse(one); } catch (error) { failed.push([one, String(error)]); }
}
console.log(JSON.stringify(failed));
"""


def _modules() -> Path | None:
    """Return the folder in which node.js finds Mermaid's own parser: NODE_PATH, or where npm installs for all."""
    if shutil.which("node") is None:
        return None
    places = [Path(entry) for entry in os.environ.get("NODE_PATH", "").split(":") if entry]
    if shutil.which("npm") is not None:
        told = subprocess.run(["npm", "root", "-g"], capture_output=True, text=True, timeout=60, check=False)
        places.append(Path(told.stdout.strip()))
    return next(
        (place for place in places if (place / "mermaid").is_dir() and (place / "jsdom").is_dir()), None
    )


@pytest.mark.long
def test_mermaid_itself_reads_every_flowchart(tmp_path: Path) -> None:
    modules = _modules()
    if modules is None:
        pytest.skip("needs node.js with mermaid and jsdom (npm install -g mermaid jsdom, or NODE_PATH)")
    made: list[str] = [FORMATS["mermaid"](_whole())]

    @given(words, st.text(max_size=10))
    @settings(max_examples=300, deadline=None)
    def collect(one: str, other: str) -> None:
        hostile = node(f"/end/{one}", executable=other, depends_on=(Dependency("b", "ready", None, at(1)),))
        made.append(FORMATS["mermaid"](plan(hostile, process("b", other, executable=f"style x:y {other}"))))

    collect()
    (tmp_path / "node_modules").symlink_to(modules)
    (tmp_path / "parse.mjs").write_text(_PARSE)
    done = subprocess.run(
        ["node", "parse.mjs"],
        cwd=tmp_path,
        input="\0".join(made).encode(),
        capture_output=True,
        timeout=110,
        check=False,
    )
    assert done.returncode == 0, done.stderr.decode()
    assert json.loads(done.stdout) == []


@given(words)
def test_labels_leave_no_sign_of_either_language_as_it_is(text: str) -> None:
    inside = mermaid.label((text,))[1:-1]
    assert not set(inside) & set('"`[](){}|<>%:\\\n\r')
    quoted = dot.quoted((text,))[1:-1]
    assert '"' not in quoted.replace("\\\\", "").replace('\\"', "")
