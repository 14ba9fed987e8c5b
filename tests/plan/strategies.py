"""Launch files as data, for tests that want any of them."""

from __future__ import annotations

from typing import Any

from hypothesis import strategies as st

Actions = list[dict[str, Any]]

NAMES = ("a", "b", "c")

_names = st.sampled_from(NAMES)
_words = st.sampled_from(
    ["x", "y z", "7", "1.5", "true", "off", "", "ärm", "it's", 'say "so"', "a: b", "#", "- c", "[1, 2]"]
)
_texts = st.one_of(
    _words,
    _names.map(lambda name: f"$(var {name} none)"),
    _names.map(lambda name: f"<$(env {name.upper()}_1 unset)>"),
    st.tuples(_names, _names).map(
        lambda two: f"$(if $(equals $(var {two[0]} 1) 1) yes $(var {two[1]} 'no such'))"
    ),
)
_flags = st.sampled_from([True, False, "true", "0", "$(not true)"])
_values = st.one_of(
    _texts,
    st.integers(-(2**63), 2**63 - 1),
    st.booleans(),
    st.floats(-1e9, 1e9),
    st.lists(st.integers(0, 9), min_size=1, max_size=3),
)


def _action(action: str, /, **keys: st.SearchStrategy[Any]) -> st.SearchStrategy[dict[str, Any]]:
    condition: st.SearchStrategy[dict[str, Any]] = st.one_of(
        st.just({}), st.fixed_dictionaries({"if": _flags}), st.fixed_dictionaries({"unless": _flags})
    )
    return st.tuples(st.fixed_dictionaries(keys), condition).map(
        lambda both: {action: {**both[0], **both[1]}}
    )


_pairs = st.lists(st.fixed_dictionaries({"name": _names.map(str.upper), "value": _texts}), max_size=2)
_namespaces = st.sampled_from(["n", "/m", ""])
_params = st.lists(st.fixed_dictionaries({"name": _names, "value": st.integers(0, 9)}), max_size=2)
_rules = st.lists(
    st.fixed_dictionaries({"from": _names, "to": st.sampled_from(["t", "/u", "~/v"])}), max_size=2
)
_components = st.lists(
    st.fixed_dictionaries(
        {"pkg": _names, "plugin": _names.map(lambda name: f"lib::{name}")},
        optional={
            "name": _names,
            "namespace": _namespaces,
            "param": _params,
            "remap": _rules,
            "extra_arg": st.lists(st.fixed_dictionaries({"name": _names, "value": _flags}), max_size=1),
            "if": _flags,
        },
    ),
    min_size=1,
    max_size=3,
)
_plain = st.one_of(
    _action("append_env", name=_names.map(lambda name: f"{name.upper()}_1"), value=_texts, prepend=_flags),
    _action("reset_env"),
    _action("reset", keep=st.lists(st.fixed_dictionaries({"name": _names, "value": _texts}), max_size=1)),
    _action("set_ros_log_dir", new_log_dir=st.sampled_from(["a", "/b"])),
    _action("lifecycle_node", exec=st.just("prog"), name=_names, namespace=_namespaces, autostart=_flags),
    _action(
        "node_container",
        exec=st.just("prog"),
        name=_names,
        namespace=_namespaces,
        composable_node=_components,
    ),
    _action("load_composable_node", target=st.sampled_from(["/n/a", "b", "/x"]), composable_node=_components),
    _action("arg", name=_names, default=_texts),
    _action("let", name=_names, value=_texts),
    _action("log", message=_texts),
    _action("set_env", name=_names.map(lambda name: f"{name.upper()}_1"), value=_texts),
    _action("unset_env", name=_names.map(lambda name: f"{name.upper()}_1")),
    _action("push_ros_namespace", namespace=st.sampled_from(["n", "/m", "n/o", ""])),
    _action("set_parameter", name=_names, value=st.integers(0, 9)),
    _action("set_remap", **{"from": _names, "to": st.sampled_from(["t", "/u", "~/v"])}),
    _action("shutdown", reason=_texts),
    _action("executable", cmd=st.just("prog"), env=_pairs, output=st.sampled_from(["both", "log"])),
    _action(
        "node",
        exec=st.just("prog"),
        namespace=st.sampled_from(["n", "/m"]),
        args=st.lists(
            st.sampled_from(
                ["x", "ärm", "#", "-c", "[1,", "$(var a none)", "y$(env A_1 unset)", "$(not $(var b 0))"]
            ),
            max_size=3,
        ).map(" ".join),
        param=st.lists(st.fixed_dictionaries({"name": _names, "value": st.integers(0, 9)}), max_size=2),
        respawn=_flags,
    ),
)


def _around(inner: st.SearchStrategy[dict[str, Any]]) -> st.SearchStrategy[dict[str, Any]]:
    children = st.lists(inner, max_size=4)
    each = st.dictionaries(
        _names, st.lists(st.integers(0, 2), min_size=1, max_size=2), min_size=1, max_size=2
    )
    return st.one_of(
        _action("group", children=children, scoped=st.booleans(), forwarding=st.booleans()),
        _action("group", children=children, for_each=each),
        _action("timer", period=st.floats(0, 10), children=children),
        _action("ros_timer", period=st.floats(0, 10), children=children),
        _action("include", file=st.just("inner.launch.yaml"), scoped=st.booleans(), for_each=each),
    )


actions: st.SearchStrategy[dict[str, Any]] = st.recursive(_plain, _around, max_leaves=12)
inner_actions: st.SearchStrategy[Actions] = st.lists(_plain, max_size=4)
descriptions: st.SearchStrategy[Actions] = st.lists(actions, max_size=6)
