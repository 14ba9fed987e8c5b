"""What can be written in YAML, in XML and in Python means the same in all three."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

import pytest
import yaml
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from orchestra.description.written import escaped
from orchestra.errors import Code
from tests.load.planning import planned
from tests.load.written import WRITERS, Actions
from tests.plan.strategies import NAMES, inner_actions
from tests.plan.strategies import actions as ordinary

if TYPE_CHECKING:
    from pathlib import Path

    from tests.load.planning import Planned

_ENVIRONMENT = {"PATH": "/bin", "A_1": "outside"}
_quickly = settings(
    max_examples=100,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)

# Any text that both formats can hold: XML has no control characters but tab and line breaks.
any_text = st.text(
    st.characters(exclude_categories=("Cc", "Cs"), exclude_characters="\ufffe\uffff")
    | st.sampled_from("\n\t '\"\\$()&<>[]{},;:#-"),
    max_size=20,
)
# In quotes, as YAML and Python have it, a text ends as it is meant to: in XML a quote at its end may be one too many.
_text = any_text.filter(lambda text: not text.endswith(("'", '"')))
_escaped_text = _text.map(escaped)
_names = st.sampled_from(NAMES)
_seconds = st.sampled_from([0, 1, 2.5, "3", "$(var a 4)"])
# 5e-324, without a point, is a text in YAML as ROS 2 reads it, and a number in Python.
_floats = st.floats(allow_nan=False, allow_infinity=False).filter(lambda number: "." in repr(number))
_scalars = st.one_of(
    st.integers(-(2**63), 2**63 - 1),
    st.booleans(),
    _floats,
    st.sampled_from(["x", "5", "true", "1e3", "it's", "$(var a 7)", "[1, 2]", "- 1", "0x10", "~"]),
)
_lists = st.one_of(
    st.lists(st.integers(0, 9), min_size=1, max_size=3),
    st.lists(st.sampled_from(["a", "b, c", "7", "on", "|;"]), min_size=1, max_size=3),
)


def _some(**keys: st.SearchStrategy[Any]) -> st.SearchStrategy[dict[str, Any]]:
    return st.fixed_dictionaries({}, optional=keys)


def _kept(values: st.SearchStrategy[Any]) -> st.SearchStrategy[list[dict[str, Any]]]:
    """Return names with values, each name once: a dictionary of Python in which one stands twice is told."""
    return st.lists(
        st.fixed_dictionaries({"name": _names, "value": values}),
        max_size=2,
        unique_by=lambda pair: pair["name"],
    )


_param = st.recursive(
    st.fixed_dictionaries({"name": _names, "value": _scalars | _lists})
    | st.fixed_dictionaries({"name": _names, "value": _text, "type": st.just("str")}),
    lambda inner: st.fixed_dictionaries(
        {
            "name": _names,
            "param": st.lists(inner, min_size=1, max_size=2, unique_by=lambda param: param["name"]),
        }
    ),
    max_leaves=3,
)
_typed: st.SearchStrategy[dict[str, Any]] = st.sampled_from(
    [
        {"type": "int", "value": 5},
        {"type": "float", "value": 2.5},
        {"type": "bool", "value": True},
        {"type": "str", "value": "5"},
        {"type": "yaml", "value": "$(var a [1])"},
        {"type": "int", "value": "$(var a 7)"},
        {"type": "list_of_int", "value": [1, 2]},
        {"type": "list_of_float", "value": [1.5, 2.5]},
        {"type": "list_of_bool", "value": [True, False]},
        {"type": "list_of_str", "value": ["1", "on"]},
    ]
)
_file = st.fixed_dictionaries({"from": st.just("p.yaml")}, optional={"allow_substs": st.booleans()})
_params = st.lists(
    _param | _file | st.tuples(_names, _typed).map(lambda both: {"name": both[0], **both[1]}), max_size=3
)
_rules = st.lists(
    st.fixed_dictionaries({"from": _names, "to": st.sampled_from(["t", "/u", "~/v", "$(var a w)"])}),
    max_size=2,
)
_flags = st.sampled_from([True, False, "$(var a true)"])


def _complete(ready: dict[str, Any]) -> dict[str, Any]:
    """Return a condition that awaits something, and is tried at intervals only where that can be."""
    tried = any(key in ready for key in ("tcp", "http", "file", "command"))
    kept = {key: value for key, value in ready.items() if key != "interval" or tried}
    return kept if kept.keys() - {"timeout"} else {**kept, "message": "/t"}


_pauses = st.sampled_from([0.5, 2, "$(var a 3)"])
_fact_names = st.sampled_from(["t", "/u", "~/v", "$(var a w)"])
_commands = st.sampled_from(["test -e 'a b'", ["test", "$(var a x)"], ["one word"]])
_facts: dict[str, st.SearchStrategy[Any]] = {
    "log": st.sampled_from(["up", "$(var a up)", "^a\\\\.b"]),
    "message": _fact_names,
    "topic": _fact_names,
    "node": _fact_names | st.just("/m") | st.booleans(),
    "service": _fact_names,
    "action": _fact_names,
    "parameter": _names
    | st.fixed_dictionaries(
        {"name": _names, "node": st.just("/n")}, optional={"value": _scalars | _lists | st.just(True)}
    ),
    "lifecycle": st.just("active")
    | st.fixed_dictionaries({"node": _names, "state": st.sampled_from(["inactive", "$(var a active)"])}),
    "tf": st.fixed_dictionaries({"parent": st.just("map"), "child": st.sampled_from(["o", "$(var a b)"])}),
    "tcp": st.sampled_from([8080, "h:1", "[::1]:2", "$(var a 3)"]),
    "http": st.sampled_from(["http://h:80/x", "https://$(var a h)"]),
    "file": st.sampled_from(["f", "$(var a f)/g"]),
    "command": _commands,
    "notify": _flags,
}
_ready = _some(**_facts, timeout=_seconds, interval=_pauses).map(_complete)
_of_rate = {"message": _fact_names, "min_rate": st.sampled_from([5, "$(var a 2.5)"])}
_of_command = {"interval": _pauses, "timeout": _pauses, "failures": st.sampled_from([1, "$(var a 4)"])}
_alive = st.one_of(
    st.fixed_dictionaries({"notify": _pauses, **_of_rate}, optional={"window": _pauses, "abort": _flags}),
    st.fixed_dictionaries({"command": _commands}, optional={"notify": _pauses, **_of_command}),
)
_restart = st.fixed_dictionaries(
    {"policy": st.sampled_from(["no", "on-failure", "$(var a always)"])},
    optional={
        "delay": _seconds,
        "max_delay": _seconds,
        "growth": st.sampled_from([1, 1.5, "$(var a 2)"]),
        "jitter": st.sampled_from([0, 0.5, "$(var a 1)"]),
        "budget": st.sampled_from([0, 3, "$(var a 5)"]),
    },
)
_cores = st.sampled_from([0, "0-3,6", "$(var a 1)", [0, 1], ["2-3", "$(var a 4)"]])
_sizes = st.sampled_from([4096, "512M", "$(var a 2)G", "unlimited"])
_limits = st.one_of(
    st.fixed_dictionaries({"cores": _cores}, optional={"exclusive": _flags, "memory": _sizes}),
    st.fixed_dictionaries(
        {"scheduler": st.sampled_from(["rr", "$(var a fifo)"])},
        optional={"priority": st.sampled_from([1, "$(var a 99)"])},
    ),
    _some(nice=st.sampled_from([-20, 19, "$(var a 5)"]), memory=_sizes, memory_lock=_sizes),
    _some(
        rlimits=_some(nofile=st.sampled_from([1024, "1024:4096", "$(var a 7)"]), core=_sizes, memlock=_sizes)
    ),
)
_process = {
    "env": st.lists(st.fixed_dictionaries({"name": _names, "value": _escaped_text}), max_size=2),
    "cwd": st.just("/tmp"),  # noqa: S108 - nothing is written there
    "launch-prefix": st.just("nice -n 5"),
    "shell": st.booleans(),
    "output": st.sampled_from(["screen", "own_log"]),
    "respawn": st.booleans(),
    "respawn_delay": _seconds,
    "respawn_max_retries": st.integers(-1, 3),
    "sigterm_timeout": _seconds,
    "required": st.booleans(),
    "stop": _some(signal=st.just("SIGTERM"), timeout=_seconds, kill_timeout=_seconds),
    "ready": st.fixed_dictionaries({"message": st.just("/t")}, optional={"timeout": _seconds}) | _ready,
    "alive": _alive,
    "restart": st.sampled_from(["no", "always", "$(var a on-failure)"]) | _restart,
    "limits": _limits,
    "stdin": _flags,
    "depends_on": st.lists(
        st.fixed_dictionaries(
            {"node": _names, "condition": st.just("ready")},
            optional={"required": _flags, "timeout": _seconds},
        ),
        max_size=1,
    ),
    "success_exit_codes": st.lists(st.integers(0, 9), min_size=1, max_size=3),
}


def _with_one_policy(keys: dict[str, Any]) -> dict[str, Any]:
    """Return the keys without upstream's where `restart` is among them: in Python these have values of no effect."""
    return {key: value for key, value in keys.items() if "restart" not in keys or "respawn" not in key}


_component = st.fixed_dictionaries(
    {"pkg": st.just("p"), "plugin": st.just("P"), "name": _names},
    optional={
        "namespace": st.just("in"),
        "param": st.lists(_param, max_size=2),
        "remap": st.lists(st.fixed_dictionaries({"from": _names, "to": _names}), max_size=2),
        "extra_arg": st.lists(st.fixed_dictionaries({"name": _names, "value": st.booleans()}), max_size=2),
        "unless": st.booleans(),
    },
)
_rich = st.one_of(
    st.fixed_dictionaries(
        {"exec": st.just("prog"), "param": _params},
        optional={**_process, "remap": _rules, "name": _names, "lifecycle": st.just("active")},
    ).map(lambda keys: {"node": _with_one_policy(keys)}),
    st.fixed_dictionaries(
        {"cmd": st.sampled_from(["prog 'a b' c", "prog x$(var a 'y z')"])}, optional=_process
    ).map(lambda keys: {"executable": _with_one_policy(keys)}),
    st.fixed_dictionaries({"name": _names, "value": _scalars | _lists}).map(
        lambda keys: {"set_parameter": keys}
    ),
    st.fixed_dictionaries({"name": _names, "default": st.just("p"), "choices": st.just(["p", "q, r"])}).map(
        lambda keys: {"arg": keys}
    ),
    st.fixed_dictionaries(
        {
            "keep": _kept(_escaped_text),
            "children": st.lists(ordinary, max_size=2),
        }
    ).map(lambda keys: {"group": keys}),
    st.just({"set_parameters_from_file": {"filename": "p.yaml"}}),
    st.fixed_dictionaries(
        {"file": st.just("inner.launch.yaml")},
        optional={
            "arg": _kept(_escaped_text),
            "scoped": st.booleans(),
            "label": st.just("l"),
            "for_each": st.dictionaries(
                _names, st.lists(_scalars, min_size=1, max_size=2), min_size=1, max_size=2
            ),
            "if": st.booleans(),
        },
    ).map(lambda keys: {"include": keys}),
    _escaped_text.map(lambda text: {"log": {"message": text}}),
    st.fixed_dictionaries(
        {"name": _names, "value": _escaped_text},
        optional={"prepend": st.booleans(), "separator": _escaped_text},
    ).map(lambda keys: {"append_env": keys}),
    _some(keep=_kept(_scalars)).map(lambda keys: {"reset": keys}),
    st.just({"reset_env": None}),
    st.fixed_dictionaries(
        {"exec": st.just("c"), "name": _names, "namespace": st.sampled_from(["", "n", "/m"])},
        optional={**_process, "composable_node": st.lists(_component, max_size=2)},
    ).map(lambda keys: {"node_container": _with_one_policy(keys)}),
    st.fixed_dictionaries(
        {"exec": st.just("l"), "name": _names, "namespace": st.just("")},
        optional={"autostart": st.booleans()},
    ).map(lambda keys: {"lifecycle_node": keys}),
    st.lists(_component, min_size=1, max_size=2).map(
        lambda nodes: {"load_composable_node": {"target": "/c", "composable_node": nodes}}
    ),
)


@pytest.mark.conforms("2.9 pair")
@given(st.lists(ordinary | _rich, max_size=6), inner_actions)
@_quickly
def test_a_description_gives_the_same_plan_in_every_language(
    tmp_path: Path, written: Actions, inner: Actions
) -> None:
    _compare(tmp_path, written, inner)


@pytest.mark.long
@pytest.mark.timeout(900)
@given(st.lists(ordinary | _rich, max_size=8), inner_actions)
@settings(_quickly, max_examples=5_000)
def test_a_description_gives_the_same_plan_in_every_language_however_many_are_tried(
    tmp_path: Path, written: Actions, inner: Actions
) -> None:
    _compare(tmp_path, written, inner)


def _compare(folder: Path, written: Actions, inner: Actions) -> None:
    (folder / "p.yaml").write_text("/**: {ros__parameters: {b: 1.5, d: [x, 'y']}}", "utf-8")
    plan = planned(folder, "yaml", written, _ENVIRONMENT, inner=inner)
    for language in ("xml", "py"):
        other = planned(folder, language, written, _ENVIRONMENT, inner=inner)
        assert other.content == plan.content, language
        assert _as_grave(other) == _as_grave(plan), language


def _as_grave(plan: Planned) -> set[tuple[str, str]]:
    """Return the kinds of problems; two nodes of one name are an error in YAML alone, upstream takes them.

    How many there are of a kind is not compared: several in one call of Python may be at one place. Nor are arguments
    that nobody reads: code in which the name stands as a text, of a parameter say, is taken to read it. Nor is what
    working Python files have much of: keys and remaps that do nothing, defaults that never count, parameters that stand in a list twice.
    Texts in place of truth values and the like are warnings in Python alone, where ROS 2 refuses them.
    """
    twice = Code.DUPLICATE_NODE.value
    silent = {
        Code.UNREAD_ARGUMENT.value,
        Code.IDLE_KEY.value,
        Code.SHADOWED_ARGUMENT.value,
        Code.IDLE_REMAP.value,
        Code.DUPLICATE_PARAMETER.value,
        Code.DUPLICATE_KEY.value,  # two pairs of one name are one dictionary in Python
    }
    return {
        (code, "error" if code == twice else severity)
        for code, severity in plan.problems
        if code not in silent and (code, severity) != (Code.WRONG_TYPE.value, "warning")
    }


@given(st.sampled_from(sorted(WRITERS)), any_text)
@_quickly
def test_any_string_survives_escaping_beside_and_inside_substitutions(
    tmp_path: Path, language: str, text: str
) -> None:
    single, double = (escaped(text).replace(quote, f"\\{quote}") for quote in ("'", '"'))
    messages = [escaped(text), f"$(var none '{single}')", f'$(var none "{double}")']
    if text and " " not in text:  # what is not quoted holds no space and is never empty
        plain = re.sub(r"""([\\$'"()])""", r"\\\1", text)
        messages += [f"$(var none {plain})", f"$(var none '$(env NONE {plain})')"]
    actions = [{"log": {"message": message}} for message in messages]
    assert planned(tmp_path, language, actions, _ENVIRONMENT).messages == [text] * len(messages)


@given(st.sampled_from(sorted(WRITERS)), any_text, _names)
@_quickly
def test_any_string_survives_in_a_parameter_file_with_substitutions(
    tmp_path: Path, language: str, text: str, name: str
) -> None:
    scalar = yaml.safe_dump(text, default_style='"', width=float("inf"), allow_unicode=True)
    parameters = f"/**:\n  ros__parameters:\n    {name}: {scalar}"
    (tmp_path / "p.yaml").write_text(escaped(parameters), "utf-8")
    node = {"exec": "prog", "name": "n", "param": [{"from": "p.yaml", "allow_substs": True}]}
    plan = planned(tmp_path, language, [{"node": node}], _ENVIRONMENT)
    assert [process["parameters"] for process in plan.processes] == [{name: text}]
