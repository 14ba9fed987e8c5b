from __future__ import annotations

import asyncio
import os
import signal
from typing import TYPE_CHECKING, Any, List, Union  # noqa: UP035 - what launch files hand in

import pytest

from orchestra.compat.launch.launch_context import LaunchContext
from orchestra.compat.launch.launch_description import LaunchDescription
from orchestra.compat.launch.launch_description_entity import LaunchDescriptionEntity
from orchestra.compat.launch.substitutions import LaunchConfiguration, TextSubstitution
from orchestra.compat.launch.utilities import (
    AsyncSafeSignalManager,
    create_future,
    ensure_argument_type,
    is_a,
    is_a_subclass,
    isclassinstance,
    normalize_to_list_of_entities,
    normalize_to_list_of_substitutions,
    perform_substitutions,
    visit_all_entities_and_collect_futures,
)
from orchestra.compat.launch.utilities.type_utils import (
    coerce_list,
    coerce_to_type,
    extract_type,
    get_typed_value,
    is_instance_of,
    is_instance_of_valid_type,
    is_normalized_substitution,
    is_substitution,
    is_typing_list,
    is_valid_scalar_type,
    normalize_typed_substitution,
    perform_typed_substitution,
)
from tests.compat.contexts import loading

if TYPE_CHECKING:
    from collections.abc import Iterator

# ruff: noqa: UP006, UP007 - launch files spell their types so
Text = TextSubstitution


@pytest.fixture
def context() -> Iterator[LaunchContext]:
    with loading({}):
        context = LaunchContext()
        context.launch_configurations.update({"one": "1", "half": "0.5", "yes": "true", "list": "[1, 2]"})
        yield context


@pytest.mark.conforms(
    "1.9 type_utils.coerce_to_type",
    "2.6 str",
    "2.6 int",
    "2.6 float",
    "2.6 bool",
    "2.6 lists",
    "2.6 no type",
    "1.1 AllowedTypes",
)
@pytest.mark.parametrize(
    ("text", "data_type", "value"),
    [
        ("asd", str, "asd"),
        ("''1''", str, "''1''"),
        ("1", str, "1"),
        (" 1 ", int, 1),
        ("1", float, 1.0),
        ("1e3", float, 1000.0),
        ("inf", float, float("inf")),
        ("1", bool, True),
        (" 0", bool, False),
        ("on", bool, True),
        ("No", bool, False),
        ("[1, 2]", List[int], [1, 2]),
        ("[.2, .1]", List[float], [0.2, 0.1]),
        ("[a, b]", List[str], ["a", "b"]),
        ("[on, no]", List[bool], [True, False]),
        ("[]", List[int], []),
        ("asd", None, "asd"),
        ("", None, ""),
        ("'1'", None, "1"),
        ("tRuE", None, "tRuE"),
        ("off", None, False),
        ("1000", None, 1000),
        (".3", None, 0.3),
        ("[a, b]", None, ["a", "b"]),
    ],
)
def test_a_text_is_read_as_a_type(text: str, data_type: Any, value: Any) -> None:
    for read in (coerce_to_type(text, data_type), get_typed_value(text, data_type)):
        assert read == value
        assert type(read) is type(value)


@pytest.mark.conforms("1.9 type_utils.coerce_to_type", "1.1 AllowedTypes")
@pytest.mark.parametrize(
    ("text", "data_type"),
    [
        ("1.5", int),
        ("0x10", int),
        ("a", float),
        ("", int),
        ("y", bool),
        ("2", bool),
        ("", bool),
        ("1", List[int]),
        ("[1, a]", List[int]),
        ("[1, 2.0]", List[float]),
        ("[", List[str]),
        ("''1''", None),
        ("{1}", None),
        ("null", None),
        ("2001-01-01", None),
        ("[1, 2.0]", None),
        ("1", bytes),
        ("1", list),
        ("1", List),
        ("1", Union[int, str]),
    ],
)
def test_a_text_that_cannot_be_read_is_refused(text: str, data_type: Any) -> None:
    with pytest.raises(ValueError):  # noqa: PT011 - any message
        coerce_to_type(text, data_type)


@pytest.mark.parametrize(
    ("value", "data_type", "read"),
    [
        ("asd", float, "asd"),
        ("asd", int, "asd"),
        ("1", int, 1),
        ("[asd, 2.0]", List[float], ["asd", 2.0]),
        ("[asd, 2.0]", None, ["asd", 2.0]),
        (["asd", "off"], List[bool], ["asd", False]),
        (["asd", "1000"], None, ["asd", 1000]),
    ],
)
def test_texts_may_pass_unread(value: Any, data_type: Any, read: Any) -> None:
    assert get_typed_value(value, data_type, can_be_str=True) == read


@pytest.mark.conforms("1.9 type_utils")
@pytest.mark.parametrize(
    ("texts", "data_type", "values"),
    [
        (["a", "b"], None, ["a", "b"]),
        (["1", "2"], None, [1, 2]),
        (["1", "2"], str, ["1", "2"]),
        (["1.", "2"], float, [1.0, 2.0]),
        (["on", "0"], bool, [True, False]),
        ([], int, []),
    ],
)
def test_several_texts_come_to_one_type(texts: list[str], data_type: Any, values: list[Any]) -> None:
    assert coerce_list(texts, data_type) == values
    assert get_typed_value(texts, None if data_type is None else List[data_type]) == values


def test_several_texts_of_several_types_are_refused() -> None:
    for texts in (["1", "a"], ["1.0", "1"], ["a", "true"]):
        with pytest.raises(ValueError, match="several types"):
            coerce_list(texts)
    with pytest.raises(TypeError):
        get_typed_value(["1", "2"], int)
    for wrong in ("a", [1, 2]):
        with pytest.raises(TypeError):
            coerce_list(wrong)  # type: ignore[arg-type]
    with pytest.raises(TypeError):
        coerce_to_type(["a"])  # type: ignore[arg-type]


@pytest.mark.conforms("1.9 type_utils")
@pytest.mark.parametrize(
    ("value", "data_type", "can_be_str", "is_one"),
    [
        (1, int, False, True),
        (1, float, False, False),
        (True, str, False, False),
        ("1", int, True, True),
        ([1, 2], List[int], False, True),
        ([1, 2.0], List[int], False, False),
        (["1", 2], List[int], True, True),
        ((1, 2), List[int], False, False),
        (1, List[int], False, False),
        ([], None, False, True),
        ([1, "2"], None, False, False),
        ([1, "2"], None, True, True),
        ([1, "2", 1.0], None, True, False),
        ([None], None, False, False),
        ({"a": 1}, None, True, False),
        (None, None, True, False),
    ],
)
def test_knows_what_is_of_a_type(value: Any, data_type: Any, can_be_str: bool, is_one: bool) -> None:
    assert is_instance_of(value, data_type, can_be_str=can_be_str) is is_one
    if data_type is None:
        assert is_instance_of_valid_type(value, can_be_str) is is_one


@pytest.mark.conforms("1.9 type_utils", "1.1 AllowedTypes")
def test_knows_what_is_a_type() -> None:
    assert [extract_type(kind) for kind in (int, List[bool])] == [(int, False), (bool, True)]
    assert is_typing_list(List)
    assert is_typing_list(List[Union[int, float]])
    assert not any(map(is_typing_list, (list, int, Union[int, float], None)))
    assert all(map(is_valid_scalar_type, (int, float, bool, str)))
    assert not any(map(is_valid_scalar_type, (bytes, None, list, List[int])))
    for wrong in (List, bytes, List[bytes], None):
        with pytest.raises(ValueError, match="type"):
            extract_type(wrong)


@pytest.mark.conforms("1.9 type_utils")
def test_knows_what_is_a_substitution() -> None:
    assert all(map(is_substitution, (Text(text="a"), ["a", Text(text="b")], (Text(text="a"),))))
    assert not any(map(is_substitution, ([], "a", ["a"], 1, [1, Text(text="a")], iter([Text(text="a")]))))
    assert is_normalized_substitution([Text(text="a"), Text(text="b")])
    assert not any(map(is_normalized_substitution, ([], Text(text="a"), [Text(text="a"), "b"], "a")))


@pytest.mark.conforms("1.9 type_utils", "1.1 SomeValueType")
@pytest.mark.parametrize(
    ("value", "data_type", "performed"),
    [
        (1, int, 1),
        (1, float, 1.0),
        (1, None, 1),
        ("a", str, "a"),
        (LaunchConfiguration("one"), int, 1),
        (LaunchConfiguration("half"), float, 0.5),
        (LaunchConfiguration("yes"), bool, True),
        (LaunchConfiguration("list"), List[int], [1, 2]),
        (LaunchConfiguration("list"), None, [1, 2]),
        ([LaunchConfiguration("one"), "0", Text(text=".5")], float, 10.5),
        ([1, 2], List[int], [1, 2]),
        ([1, 2.5], None, [1.0, 2.5]),
        ([1, 2], List[float], [1.0, 2.0]),
        ([LaunchConfiguration("one"), 2], List[int], [1, 2]),
        ([[LaunchConfiguration("one"), "0"], [Text(text="2")]], List[int], [10, 2]),
        (["a", [LaunchConfiguration("one")]], List[str], ["a", "1"]),
        ([[LaunchConfiguration("yes")], False], List[bool], [True, False]),
        ([True, False], None, [True, False]),
        ([], List[int], []),
    ],
)
def test_values_may_be_substitutions(
    value: Any, data_type: Any, performed: Any, context: LaunchContext
) -> None:
    found = perform_typed_substitution(context, normalize_typed_substitution(value, data_type), data_type)
    assert found == performed
    assert repr(found) == repr(performed)


@pytest.mark.conforms("1.9 type_utils", "1.1 SomeValueType")
@pytest.mark.parametrize(
    ("value", "data_type", "error"),
    [
        (1, bytes, ValueError),
        (1, List[int], TypeError),
        (1.5, int, TypeError),
        ("1", int, TypeError),
        (None, int, TypeError),
        (object(), None, TypeError),
        (["a", 2], List[int], TypeError),
        (["a", 2], None, TypeError),
        ([True, 2], None, TypeError),
        ([1, 2], int, TypeError),
        ([1.5], List[int], TypeError),
        ([["a"]], List[str], TypeError),
        ([None], None, TypeError),
    ],
)
def test_values_that_cannot_come_to_the_type_are_refused(value: Any, data_type: Any, error: Any) -> None:
    with pytest.raises(error):
        normalize_typed_substitution(value, data_type)


@pytest.mark.parametrize(
    ("value", "data_type", "error"),
    [
        (object, int, TypeError),
        (1.0, int, TypeError),
        ([Text(text="1.")], int, ValueError),
        ([Text(text="1")], List[int], ValueError),
        ([[Text(text="1.")], [Text(text="1")]], None, ValueError),
        ([[Text(text="1")]], int, ValueError),
        ([1, "a"], List[int], ValueError),
    ],
)
def test_what_does_not_come_to_the_type_is_refused(
    value: Any, data_type: Any, error: Any, context: LaunchContext
) -> None:
    with pytest.raises(error):
        perform_typed_substitution(context, value, data_type)


class Waiting(LaunchDescriptionEntity):
    """An entity that leads to others."""

    def __init__(self, *inside: LaunchDescriptionEntity, future: Any = None) -> None:
        self._inside = list(inside)
        self._future = future
        self.visited: list[LaunchContext] = []

    def visit(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        self.visited.append(context)
        return self._inside or None

    def get_asyncio_future(self) -> Any:
        return self._future


@pytest.mark.conforms("1.9 visit_all_entities_and_collect_futures", "1.2 LaunchDescriptionEntity")
def test_entities_are_visited_depth_first(context: LaunchContext) -> None:
    innermost, plain, last = Waiting(future=1), Waiting(), Waiting(future=2)
    outer = Waiting(LaunchDescription([plain, innermost]), last, future=0)
    assert visit_all_entities_and_collect_futures(outer, context) == [(outer, 0), (innermost, 1), (last, 2)]
    assert [entity.visited for entity in (outer, plain, innermost, last)] == [[context]] * 4


@pytest.mark.conforms("1.9 normalize_to_list_of_entities")
def test_entities_are_flattened() -> None:
    one, two, three = Waiting(), Waiting(), Waiting()
    assert normalize_to_list_of_entities([one, [two, three]]) == [one, two, three]
    assert normalize_to_list_of_entities(one) == [one]
    for wrong in ([1], [[one, "a"]], ["ab"]):
        with pytest.raises(TypeError):
            normalize_to_list_of_entities(wrong)


@pytest.mark.conforms(
    "1.9 normalize_to_list_of_substitutions", "1.9 perform_substitutions", "1.1 SomeSubstitutionsType"
)
def test_texts_become_substitutions_and_texts_again(context: LaunchContext) -> None:
    found = normalize_to_list_of_substitutions(["a", LaunchConfiguration("one"), Text(text="b")])
    assert [type(item).__name__ for item in found] == [
        "TextSubstitution",
        "LaunchConfiguration",
        "TextSubstitution",
    ]
    assert perform_substitutions(context, found) == "a1b"
    for wrong in (1, None, [1], [["a"]]):
        with pytest.raises(TypeError):
            normalize_to_list_of_substitutions(wrong)


@pytest.mark.conforms("1.9 ensure_argument_type")
def test_arguments_are_checked_by_type() -> None:
    ensure_argument_type("a", str, "name")
    ensure_argument_type(1, (kind for kind in (str, int)), "name")
    with pytest.raises(TypeError, match=r"Node: 'name' must be str or int, found float: 1\.5"):
        ensure_argument_type(1.5, [str, int], "name", "Node")
    for types, name in ((None, "name"), (str, None)):
        with pytest.raises(TypeError, match="ensure_argument_type"):
            ensure_argument_type("a", types, name)


@pytest.mark.conforms("1.9 is_a")
def test_classes_are_told_apart() -> None:
    assert is_a(True, int)
    assert not is_a("a", int)
    assert is_a_subclass(bool, int)
    assert is_a_subclass(1, int)
    assert not is_a_subclass(str, int)
    assert isclassinstance(1)
    with pytest.raises(RuntimeError):
        is_a(1, 1)


def test_a_future_needs_no_loop() -> None:
    called: list[Any] = []
    future = create_future(None)
    future.add_done_callback(called.append)
    future.set_result(3)
    assert (future.result(), called) == (3, [future])

    async def of_a_loop() -> Any:
        own = create_future(asyncio.get_running_loop())
        own.set_result(4)
        return await own

    assert asyncio.run(of_a_loop()) == 4


@pytest.fixture
def _caught() -> Iterator[None]:
    """Keep the signals of the test from ending the process."""
    before = {number: signal.signal(number, _take) for number in (signal.SIGUSR1, signal.SIGUSR2)}
    yield
    for number, handler in before.items():
        signal.signal(number, handler)


def _take(number: int, frame: Any) -> None:
    """A handler of Python, without which nobody hears of a signal."""


@pytest.mark.conforms("1.9 AsyncSafeSignalManager")
@pytest.mark.usefixtures("_caught")
def test_signals_come_to_the_loop_while_the_manager_is_entered() -> None:
    heard: asyncio.Queue[int] = asyncio.Queue()
    inner: list[int] = []

    async def sent(number: int) -> int:
        os.kill(os.getpid(), number)
        return await asyncio.wait_for(heard.get(), timeout=30)

    with asyncio.Runner() as runner:
        listening = AsyncSafeSignalManager(runner.get_loop())
        nested = AsyncSafeSignalManager(runner.get_loop())
        for number in (signal.SIGUSR1, signal.SIGUSR2):
            assert listening.handle(number, heard.put_nowait) is None
        assert nested.handle(signal.SIGUSR1, inner.append) is None
        with listening:
            assert runner.run(sent(signal.SIGUSR1)) == signal.SIGUSR1
            with nested:
                assert runner.run(sent(signal.SIGUSR1)) == signal.SIGUSR1
            assert runner.run(sent(signal.SIGUSR2)) == signal.SIGUSR2
            assert listening.handle(signal.SIGUSR1, None) is not None
        os.kill(os.getpid(), signal.SIGUSR2)
        runner.run(asyncio.sleep(0))
        assert heard.empty()
        with listening:
            assert runner.run(sent(signal.SIGUSR2)) == signal.SIGUSR2
    assert inner == [signal.SIGUSR1]
    assert signal.set_wakeup_fd(-1) == -1
    with pytest.raises(ValueError, match="callable"):
        nested.handle(signal.SIGUSR1, 1)
