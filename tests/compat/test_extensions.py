"""Orchestra's own keys as keywords of Python launch files."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from orchestra.errors import Problems
from orchestra.pipeline import collect, inputs_from
from tests.compat import plans

if TYPE_CHECKING:
    from pathlib import Path

_BEFORE = "from launch_ros.actions import *\nimport pathlib\nimport signal\n"

SAME: list[tuple[str, str, list[dict[str, Any]]]] = [
    (
        "a dependency by name",
        "Node(executable='b', name='b'), Node(executable='a', name='a', depends_on=[{'node': 'b'}])",
        [
            {"node": {"exec": "b", "name": "b"}},
            {"node": {"exec": "a", "name": "a", "depends_on": [{"node": "b"}]}},
        ],
    ),
    (
        "all that can be said of a dependency, its name and timeout substituted",
        "DeclareLaunchArgument('n', default_value='b'), Node(executable='b', name='b', ready={'message': '/t'}), "
        "ExecuteProcess(cmd=['a'], depends_on=({'node': ['/', LC('n')], 'condition': 'ready', 'timeout': 2.5},))",
        [
            {"arg": {"name": "n", "default": "b"}},
            {"node": {"exec": "b", "name": "b", "ready": {"message": "/t"}}},
            {
                "executable": {
                    "cmd": "a",
                    "depends_on": [{"node": "/$(var n)", "condition": "ready", "timeout": 2.5}],
                }
            },
        ],
    ),
    (
        "readiness by a line, texts that look like substitutions included",
        r"ExecuteProcess(cmd=['a'], ready={'log': r'up \d+ \$\(x\)', 'timeout': 3})",
        [{"executable": {"cmd": "a", "ready": {"log": r"up \\d+ \\\$\\(x\\)", "timeout": 3}}}],
    ),
    (
        "restart, stop, required and codes",
        "LifecycleNode(executable='a', name='a', namespace='', required=True, success_exit_codes=[0, '3'], "
        "restart=dict(policy='on-failure', delay=1, max_delay=4.5, min_uptime=2, budget=5), "
        "stop={'signal': signal.SIGTERM, 'timeout': 1, 'kill_timeout': '2'})",
        [
            {
                "lifecycle_node": {
                    "exec": "a",
                    "name": "a",
                    "namespace": "",
                    "required": True,
                    "success_exit_codes": [0, "3"],
                    "restart": {
                        "policy": "on-failure",
                        "delay": 1,
                        "max_delay": 4.5,
                        "min_uptime": 2,
                        "budget": 5,
                    },
                    "stop": {"signal": "SIGTERM", "timeout": 1, "kill_timeout": "2"},
                }
            }
        ],
    ),
    (
        "every condition of readiness",
        "Node(executable='a', name='a', namespace='n', ready={'message': 'm', 'topic': ['t', LC('x', default='1')], "
        "'node': True, 'service': 's', 'action': 'go', 'parameter': 'p', 'lifecycle': 'active', "
        "'tf': dict(parent='map', child=['o', LC('x', default='1')]), 'tcp': 80, 'http': 'http://h', "
        "'file': pathlib.Path('/data') / '$(f)', 'command': ['b', LC('x', default='y z')], 'notify': True, "
        "'timeout': 5, 'interval': .5}), "
        "ExecuteProcess(cmd=['b'], ready={'command': 'c \"d e\"', 'lifecycle': {'node': '/a', 'state': 'inactive'}, "
        "'parameter': {'node': '/a', 'name': 'p', 'value': '5'}}), "
        "ExecuteProcess(cmd=['b'], ready={'parameter': {'node': '/a', 'name': 'p', 'value': ('x', 'y')}}), "
        "ExecuteProcess(cmd=['b'], ready={'parameter': dict(node='/a', name='p', value=LC('x', default='5'))})",
        [
            {
                "node": {
                    "exec": "a",
                    "name": "a",
                    "namespace": "n",
                    "ready": {
                        "message": "m",
                        "topic": "t$(var x 1)",
                        "node": True,
                        "service": "s",
                        "action": "go",
                        "parameter": "p",
                        "lifecycle": "active",
                        "tf": {"parent": "map", "child": "o$(var x 1)"},
                        "tcp": 80,
                        "http": "http://h",
                        "file": r"/data/\$(f)",
                        "command": ["b", "$(var x 'y z')"],
                        "notify": True,
                        "timeout": 5,
                        "interval": 0.5,
                    },
                }
            },
            {
                "executable": {
                    "cmd": "b",
                    "ready": {
                        "command": ["c", "d e"],
                        "lifecycle": {"node": "/a", "state": "inactive"},
                        "parameter": {"node": "/a", "name": "p", "value": "5"},
                    },
                }
            },
            {
                "executable": {
                    "cmd": "b",
                    "ready": {"parameter": {"node": "/a", "name": "p", "value": ["x", "y"]}},
                }
            },
            {
                "executable": {
                    "cmd": "b",
                    "ready": {"parameter": {"node": "/a", "name": "p", "value": "$(var x 5)"}},
                }
            },
        ],
    ),
    (
        "signs of life, limits, one word for restart, what is typed, a state, a dependency that can be done without",
        "Node(executable='a', name='a', lifecycle='active', stdin=True, restart='always', "
        "alive=dict(notify=3, message='m', min_rate=5, window=4, command=['b', 'c d'], interval=1, timeout=1, "
        "failures=2, abort=True), limits={'cores': [0, '2-3'], 'exclusive': True, 'nice': -5, 'scheduler': 'rr', "
        "'priority': 5, 'memory': 2 ** 30, 'memory_lock': 'unlimited', 'rlimits': {'nofile': 4096, 'as': '2G'}}), "
        "LifecycleNode(executable='b', name='b', namespace='', lifecycle=LC('x', default='active'), "
        "restart=LC('x', default='on-failure'), limits={'cores': '4,6'}, "
        "depends_on=[{'node': '/nobody', 'required': False}, {'node': '/a', 'required': False}])",
        [
            {
                "node": {
                    "exec": "a",
                    "name": "a",
                    "lifecycle": "active",
                    "stdin": True,
                    "restart": {"policy": "always"},
                    "alive": {
                        "notify": 3,
                        "message": "m",
                        "min_rate": 5,
                        "window": 4,
                        "command": ["b", "c d"],
                        "interval": 1,
                        "timeout": 1,
                        "failures": 2,
                        "abort": True,
                    },
                    "limits": {
                        "cores": "0,2-3",
                        "exclusive": True,
                        "nice": -5,
                        "scheduler": "rr",
                        "priority": 5,
                        "memory": "1G",
                        "rlimits": {"nofile": "4096:4096", "as": "2G", "memlock": "unlimited"},
                    },
                }
            },
            {
                "lifecycle_node": {
                    "exec": "b",
                    "name": "b",
                    "namespace": "",
                    "autostart": True,
                    "restart": "on-failure",
                    "limits": {"cores": [4, 6]},
                    "depends_on": [{"node": "/a", "required": False}],
                }
            },
        ],
    ),
    (
        "a container, with a substitution for a flag",
        "ComposableNodeContainer(package='p', executable='c', name='c', namespace='', "
        "required=LC('r', default='true'))",
        [
            {
                "node_container": {
                    "pkg": "p",
                    "exec": "c",
                    "name": "c",
                    "namespace": "",
                    "required": "$(var r true)",
                }
            }
        ],
    ),
    (
        "a group once per combination of values, from a list, a generator and a text",
        "GroupAction([ExecuteProcess(cmd=['a', LC('i'), LC('j'), LC('k')])], "
        "for_each={'i': [1, 2.5], 'j': (c for c in 'xy'), 'k': 'p, q'})",
        [
            {
                "group": {
                    "for_each": {"i": [1, 2.5], "j": ["x", "y"], "k": "p, q"},
                    "children": [
                        {"executable": {"cmd": ["a", "$(var i)", "$(var j)", "$(var k)"]}},
                    ],
                }
            }
        ],
    ),
    (
        "modules and scripts",
        "Node(module=['json.', LC('m', default='tool')], name='a', arguments=['b c'], parameters=[{'x': 1}]), "
        "LifecycleNode(script='inner.py', name='b', namespace='', warm=False)",
        [
            {
                "node": {
                    "module": "json.$(var m tool)",
                    "name": "a",
                    "args": ["b c"],
                    "param": [{"name": "x", "value": 1}],
                }
            },
            {"lifecycle_node": {"script": "inner.py", "name": "b", "namespace": "", "warm": False}},
        ],
    ),
    ("a group for no value", "GroupAction([ExecuteProcess(cmd=['a'])], for_each={'i': []})", []),
    (
        "an include with everything",
        "ExecuteProcess(cmd=['z']), IncludeLaunchDescription('inner.launch.yaml', for_each={'i': ['1', '2']}, "
        "scoped=True, label='all', depends_on=[{'process': 'z', 'condition': 'exited'}]), "
        "ExecuteProcess(cmd=['y'], depends_on=[{'label': 'all'}])",
        [
            {"executable": {"cmd": "z"}},
            {
                "include": {
                    "file": "inner.launch.yaml",
                    "for_each": {"i": ["1", "2"]},
                    "scoped": True,
                    "label": "all",
                    "depends_on": [{"process": "z", "condition": "exited"}],
                }
            },
            {"executable": {"cmd": "y", "depends_on": [{"label": "all"}]}},
        ],
    ),
]


@pytest.mark.parametrize(("actions", "same"), [row[1:] for row in SAME], ids=[row[0] for row in SAME])
def test_a_keyword_says_what_the_key_does(tmp_path: Path, actions: str, same: list[dict[str, Any]]) -> None:
    (tmp_path / "inner.py").touch()
    inner = tmp_path / "inner.launch.yaml"
    inner.write_text('launch: [{executable: {cmd: "w $(var i none)"}}]', "utf-8")
    plan, other = plans.python(tmp_path, actions, _BEFORE), plans.yaml(tmp_path, same)
    assert plan.content == other.content
    assert plan.problems == other.problems


AWAITED = [
    ("a node", "b = Node(executable='b', name='b')", "b", ["/b"]),
    (
        "a process without a name of its own",
        "b = ExecuteProcess(cmd=['b'])",
        "ExecuteProcess(cmd=['b']), b",
        ["b#2"],
    ),
    ("one in a timer", "b = ExecuteProcess(cmd=['b'])", "TimerAction(period=1.0, actions=[b])", ["b"]),
    (
        "a group",
        "b = GroupAction([ExecuteProcess(cmd=['b']), GroupAction([ExecuteProcess(cmd=['c'])])])",
        "b",
        ["b", "c"],
    ),
    (
        "a repeated one",
        "b = ExecuteProcess(cmd=['b'])",
        "GroupAction([b], for_each={'i': [1, 2]})",
        ["b", "b#2"],
    ),
    ("an include", "b = IncludeLaunchDescription('inner.launch.yaml')", "b", ["v", "w"]),
    ("a function", "b = OpaqueFunction(function=lambda _: [ExecuteProcess(cmd=['b'])])", "b", ["b"]),
    (
        "one with a handler of its own",
        "b = ExecuteProcess(cmd=['b'], on_exit=LogInfo(msg='over'))",
        "b",
        ["b"],
    ),
]


@pytest.mark.parametrize(
    ("before", "actions", "found"), [row[1:] for row in AWAITED], ids=[row[0] for row in AWAITED]
)
@pytest.mark.parametrize(
    "form", ["b", "{'node': b}", "{'process': b, 'condition': 'completed'}", "{'label': b}"]
)
def test_an_action_stands_for_every_process_that_comes_out_of_it(
    tmp_path: Path, before: str, actions: str, found: list[str], form: str
) -> None:
    (tmp_path / "inner.launch.yaml").write_text(
        "launch: [{executable: {cmd: v}}, {group: [{executable: {cmd: w}}]}]", "utf-8"
    )
    waiting = f"ExecuteProcess(cmd=['a'], depends_on=[{form}])"
    plan = plans.python(tmp_path, f"{actions}, {waiting}", _BEFORE + before)
    assert plan.problems == []
    condition = "completed" if "completed" in form else "started"
    assert _waits(plan)["a"] == [(name, condition) for name in found]


def test_a_process_does_not_wait_for_itself_in_a_group_that_it_waits_for(tmp_path: Path) -> None:
    before = """
inside = [ExecuteProcess(cmd=['b'])]
b = GroupAction(inside)
inside.append(ExecuteProcess(cmd=['a'], depends_on=[b]))
"""
    plan = plans.python(tmp_path, "b", before)
    assert plan.problems == []
    assert _waits(plan) == {"b": [], "a": [("b", "started")]}


def test_two_actions_that_wait_for_each_other_are_reported(tmp_path: Path) -> None:
    before = "waits = []\na = ExecuteProcess(cmd=['a'], depends_on=waits)\nwaits.append(a)"
    plan = plans.python(tmp_path, "a", before)
    assert plan.problems == ["these wait for each other: a waits for a"]


@pytest.mark.parametrize(
    "source",
    [
        "LaunchDescriptionSource(LaunchDescription([ExecuteProcess(cmd=['b', LC('i')])]))",
        "Sourced()",
    ],
)
def test_an_include_of_an_object_takes_the_same_keys(tmp_path: Path, source: str) -> None:
    before = """
from launch import LaunchDescriptionSource
class Sourced(LaunchDescriptionSource):
    def get_launch_description(self, context):
        assert context.launch_configurations['x'] == 'y'
        return LaunchDescription([ExecuteProcess(cmd=['b', context.launch_configurations['i']])])
"""
    actions = f"""
        ExecuteProcess(cmd=['z']),
        IncludeLaunchDescription({source}, for_each={{'i': [1, 2]}}, scoped=True, label='all', depends_on=[
            {{'process': 'z'}}
        ], launch_arguments={{'x': 'y'}}.items()),
        ExecuteProcess(cmd=['a', LC('x', default='gone')], depends_on=[{{'label': 'all'}}]),
    """
    plan = plans.python(tmp_path, actions, before)
    assert plan.problems == []
    assert plan.commands == [["z"], ["b", "1"], ["b", "2"], ["a", "gone"]]
    z, both = [("z", "started")], [("b", "started"), ("b#2", "started")]
    assert _waits(plan) == {"z": [], "b": z, "b#2": z, "a": both}


def test_a_group_with_values_that_is_visited_by_hand_is_repeated(tmp_path: Path) -> None:
    before = """
def visited(context):
    GroupAction([ExecuteProcess(cmd=['a', LC('i')])], for_each={'i': [1, 2]}).visit(context)
"""
    assert plans.python(tmp_path, "OpaqueFunction(function=visited)", before).commands == [
        ["a", "1"],
        ["a", "2"],
    ]


_MIXED = "parameter 'p': a list must hold values of one type, not 1 and 'a'"
# What stands behind `a=`, the words that are marked, what is said of them, and what is suggested.
FAULTS = [
    ("depends_on={'node': 'b'}", "{'node': 'b'}", "expected a list, found a mapping", None),
    ("depends_on=Node(executable='b')", "Node(executable='b')", "expected a list, found Node", None),
    ("depends_on=['b']", "b", "expected a mapping, found 'b'", None),
    ("depends_on=[{'nod': 'b'}]", "nod", "unknown key 'nod'", "node"),
    (
        "depends_on=[dict(node='b', condition='redy')]",
        "redy",
        "expected one of started, ready, completed, exited, found 'redy'",
        "ready",
    ),
    ("depends_on=[{'node': 'b', 'timeout': -1}]", "-1", "expected a number of seconds, found '-1'", None),
    (
        "depends_on=[{'node': 'b', 'label': 'c'}]",
        "label",
        "a dependency names one of `node`, `process` and `label`",
        None,
    ),
    ("ready='/t'", "/t", "expected a mapping, found '/t'", None),
    ("ready=LC('x')", "LC('x')", "expected a mapping, found '$(var x)'", None),
    ("ready=dict(mesage='/t')", "mesage", "unknown key 'mesage'", "message"),
    ("ready={'message': None}", "message", "expected text, found nothing", None),
    ("ready={'message': 3j}", "message", "expected text, found complex", None),
    ("restart={'policy': 'ever'}", "ever", "expected one of no, on-failure, always, found 'ever'", None),
    ("ready={'command': [['b'], 3j]}", "command", "expected text, found complex", None),
    ("ready={'parameter': {'name': 'p', 'value': [1, 'a']}}", "[1, 'a']", _MIXED, None),
    ("ready={'tf': 'map'}", "map", "expected a mapping, found 'map'", None),
    ("ready={'lifecycle': {'node': 'b'}}", "{'node': 'b'}", "the key 'state' is missing", None),
    ("alive={'mesage': '/t', 'min_rate': 5}", "mesage", "unknown key 'mesage'", "message"),
    ("alive={'notify': -1}", "-1", "expected a number of seconds above 0, found '-1'", None),
    ("limits={'cores': [0, 'x']}", "x", "expected numbers of cores as 0-3,6, found 'x'", None),
    (
        "limits={'memory': 1.5}",
        "1.5",
        "expected a size as 512M or 2G, or a number of bytes, found '1.5'",
        None,
    ),
    ("limits=512", "512", "expected a mapping, found '512'", None),
    ("lifecycle='on'", "on", "expected 'active', found 'on'", None),
    ("restart='evr'", "evr", "expected one of no, on-failure, always, found 'evr'", None),
    ("stdin=3", "3", "expected true or false, found '3'", None),
    ("restart={'delay': 1}", "{'delay': 1}", "the key 'policy' is missing", None),
    ("required='maybe'", "maybe", "expected true or false, found 'maybe'", None),
    ("required=[True]", "[True]", "expected true or false, found a list", None),
    ("stop={'timeout': [1, 2]}", "[1, 2]", "expected a number of seconds, found a list", None),
    ("success_exit_codes=3", "3", "expected a list, found '3'", "[3]"),
    ("success_exit_codes=[0, 'x']", "x", "expected a whole number, found 'x'", None),
    ("depends_on=ELSEWHERE", "ELSEWHERE", "expected a list, found a mapping", None),
]


@pytest.mark.parametrize(("keyword", "marked", "message", "suggestion"), FAULTS)
def test_a_fault_is_told_as_in_yaml_at_the_words_that_are_wrong(
    tmp_path: Path, keyword: str, marked: str, message: str, suggestion: str | None
) -> None:
    head = "from launch_ros.actions import *\nELSEWHERE = {'node': 'x'}"
    # The accent is one code point and two bytes.
    path = plans.write(
        tmp_path / "a.launch.py", f"Node(executable='é', name='a',\n  exec_name='é', {keyword})", head
    )
    problems = Problems()
    plan = collect(str(path), inputs_from([], environment={"PATH": "/bin"}), problems)
    (problem,) = problems
    assert (problem.message, problem.suggestion) == (message, suggestion)
    assert problem.span is not None
    lines = path.read_text("utf-8").splitlines()
    assert lines[problem.span.line - 1][problem.span.column - 1 : problem.span.end_column - 1] == marked
    assert plan is not None
    assert [process.id for process in plan.processes] == ["/a"]


INCLUDED_FAULTS = [
    ("GroupAction([], for_each={'i': None})", "expected text, found nothing"),
    ("GroupAction([], for_each=['i'])", "expected a mapping, found a list"),
    ("GroupAction([], for_each={})", "expected at least one item, found none"),
    ("IncludeLaunchDescription('inner.launch.yaml', scoped='both')", "expected true or false, found 'both'"),
    ("IncludeLaunchDescription('inner.launch.yaml', label={})", "expected text, found a mapping"),
    (
        "ExecuteProcess(cmd=['a'], depends_on=[LogInfo(msg='b')])",
        "no process comes out of the LogInfo to wait for",
    ),
    (
        "ExecuteProcess(cmd=['a'], depends_on=[{'node': Node(executable='b')}])",
        "no process comes out of the Node to wait for",
    ),
    (
        "b, ExecuteProcess(cmd=['a'], depends_on=[{'process': b, 'condition': 'ready'}])",
        "'/b' does not say when it is ready",
    ),
    ("Node(module='json.tol')", "there is no module 'json.tol'"),
    (
        "Node(module='json.tool', executable='a')",
        "a Node starts one of 'executable', 'module' and 'script'",
    ),
    ("Node(module='json.tool', package='a')", "'package' goes with 'executable', not with 'module'"),
    (
        "ComposableNodeContainer(name='c', namespace='', module='json.tool')",
        "a ComposableNodeContainer is no program in Python: it has no 'module'",
    ),
    ("Node(executable='a', ready={'message': b})", "expected text, found Node"),
]


@pytest.mark.parametrize(("actions", "message"), INCLUDED_FAULTS)
def test_what_cannot_be_is_reported(tmp_path: Path, actions: str, message: str) -> None:
    (tmp_path / "inner.launch.yaml").write_text("launch: []", "utf-8")
    before = f"{_BEFORE}b = Node(executable='b')"
    assert plans.python(tmp_path, actions, before).problems == [message]


def test_a_fault_in_an_included_file_tells_the_way_to_it(tmp_path: Path) -> None:
    plans.write(tmp_path / "inner.launch.py", "ExecuteProcess(cmd=['a'], ready=1)")
    path = plans.write(tmp_path / "a.launch.py", "IncludeLaunchDescription('inner.launch.py')")
    problems = Problems()
    collect(str(path), inputs_from([], environment={"PATH": "/bin"}), problems)
    (problem,) = problems
    assert problem.span is not None
    assert problem.span.file.endswith("inner.launch.py")
    assert [span.file.endswith("a.launch.py") for span in problem.included_from] == [True]


def _waits(plan: plans.Planned) -> dict[str, list[tuple[str, str]]]:
    return {
        process["id"]: [(edge["process"], edge["condition"]) for edge in process["depends_on"]]
        for process in plan.content["processes"]
    }
