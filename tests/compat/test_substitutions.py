from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.compat.launch import substitutions as names
from orchestra.compat.launch.launch_context import LaunchContext
from orchestra.compat.launch.substitution import Substitution
from orchestra.compat.launch.substitutions import (
    AllSubstitution,
    AndSubstitution,
    AnonName,
    AnySubstitution,
    Command,
    EnvironmentVariable,
    EqualsSubstitution,
    FileContent,
    FindExecutable,
    ForEachVar,
    ForLoopIndex,
    IfElseSubstitution,
    LaunchConfiguration,
    LaunchLogDir,
    LocalSubstitution,
    NotEqualsSubstitution,
    NotSubstitution,
    OrSubstitution,
    PathJoinSubstitution,
    PathSubstitution,
    PythonExpression,
    StringJoinSubstitution,
    SubstitutionFailure,
    TextSubstitution,
    ThisLaunchFile,
    ThisLaunchFileDir,
    YamlValue,
)
from orchestra.compat.launch.utilities import perform_substitutions
from orchestra.compat.text import normalized, template
from orchestra.description.text import Call, Opaque, Words
from orchestra.errors import Problems
from orchestra.load.grammar import parse_template
from orchestra.location import point
from tests.compat.contexts import loading

if TYPE_CHECKING:
    from collections.abc import Iterator

LC = LaunchConfiguration
_SPAN = point("here")
_ENVIRONMENT = {"PATH": "/usr/bin:/bin", "HOME": "/home/robot", "EMPTY": ""}


@pytest.fixture(autouse=True, scope="module")
def _loading() -> Iterator[None]:
    with loading(_ENVIRONMENT):
        yield


@pytest.fixture
def context() -> LaunchContext:
    context = LaunchContext()
    context.launch_configurations.update({"a": "A", "yes": "true", "no": "false", "n": "3"})
    return context


class Shouted(Substitution):
    """What a user derives."""

    def __init__(self, inner: Any) -> None:
        self._inner = normalized(inner)

    def perform(self, context: LaunchContext) -> str:
        return perform_substitutions(context, self._inner).upper()


@pytest.mark.conforms("1.4 describe")
@pytest.mark.parametrize(
    ("substitution", "described", "written"),
    [
        (TextSubstitution(text="a $b"), "'a $b'", r"a \$b"),
        (LC("a"), "LaunchConfig('a')", "$(var a)"),
        (LC("a", default=True), "LaunchConfig('a')", "$(var a True)"),
        (LC("a", default=["x", 1]), "LaunchConfig('a')", "$(var a x1)"),
        (LC(["a", LC("b")]), "LaunchConfig('a' + LaunchConfig('b'))", "$(var a$(var b))"),
        (EnvironmentVariable("HOME"), "EnvVar('HOME')", "$(env HOME)"),
        (EnvironmentVariable("HOME", default_value=""), "EnvVar('HOME')", "$(env HOME '')"),
        (PathJoinSubstitution([LC("a"), "b"]), "PathJoin('LaunchConfig('a') + 'b'')", "$(path-join $(var a) b)"),
        (PythonExpression("1 + 1"), "PythonExpr('1 + 1', ['math'])", "$(eval '1 + 1')"),
        (PythonExpression("1", ["sys", "os.path"]), "PythonExpr('1', ['sys', 'os.path'])", "$(eval 1 sys,os.path)"),
        (PythonExpression("1", []), "PythonExpr('1', [])", "$(eval 1 '')"),
        (LocalSubstitution("event.reason"), "LocalVar('event.reason')", "LocalVar('event.reason')"),
        (LocalSubstitution("event.x", "the x"), "LocalVar('the x')", "LocalVar('the x')"),
        (FindExecutable(name="sh"), "FindExec('sh')", "$(find-exec sh)"),
        (Command(["xacro ", LC("a")]), "Command('xacro ' + LaunchConfig('a'))", "$(command 'xacro $(var a)')"),
        (Command("ls", on_stderr="warn"), "Command('ls')", "$(command ls warn)"),
        (FileContent(Path("a") / "b"), "FileContent('a/b')", "$(file-content a/b)"),
        (YamlValue("a.yaml", ["b.", LC("c")]), "YamlValue('a.yaml', 'b.' + LaunchConfig('c'))", "$(yaml-value a.yaml b.$(var c))"),
        (YamlValue(Path("a"), "b", default=""), "YamlValue('a', 'b')", "$(yaml-value a b '')"),
        (ThisLaunchFile(), "ThisLaunchFile()", "$(filename)"),
        (ThisLaunchFileDir(), "ThisLaunchFileDir()", "$(dirname)"),
        (LaunchLogDir(), "LaunchLogDir()", "$(launch_log_dir)"),
        (AnonName("a"), "AnonName('a')", "$(anon a)"),
        (NotSubstitution(LC("a")), "NotSubstitution(LaunchConfig('a'))", "$(not $(var a))"),
        (AndSubstitution("1", "0"), "AndSubstitution('1', '0')", "$(and 1 0)"),
        (OrSubstitution("1", "0"), "OrSubstitution('1', '0')", "$(or 1 0)"),
        (AnySubstitution(["tr", "ue"], "0"), "AnySubstitution('tr' + 'ue', '0')", "$(any true 0)"),
        (AllSubstitution(), "AllSubstitution()", "$(all)"),
        (EqualsSubstitution(LC("a"), None), "EqualsSubstitution(LaunchConfig('a'), '')", "$(equals $(var a) '')"),
        (NotEqualsSubstitution(1.5, True), "NotEqualsSubstitution('1.5', 'true')", "$(not-equals 1.5 true)"),
        (IfElseSubstitution("1", "a b"), "IfElseSubstitution('1', 'a b', '')", "$(if 1 'a b' '')"),
        (StringJoinSubstitution(["a", ["b", LC("c")]], "."), "StringJoin(['a', 'b' + LaunchConfig('c')], delimiter='.')", "$(string-join . a b$(var c))"),
        (PathSubstitution(Path("a")), "Path('a')", "a"),
        (PathSubstitution(LC("a")) / "b", "PathJoin('Path(LaunchConfig('a')), 'b'')", "$(path-join $(var a) b)"),
        (ForEachVar("a"), "ForEachVar(name='a', default_value=)", "ForEachVar(name='a', default_value=)"),
    ],
)  # fmt: skip
def test_describes_itself_and_says_how_it_is_written(
    substitution: Substitution, described: str, written: str
) -> None:
    assert substitution.describe() == described
    assert template(substitution, _SPAN).raw == written


@pytest.mark.conforms(
    "1.4 TextSubstitution",
    "1.4 LaunchConfiguration",
    "1.4 EnvironmentVariable",
    "1.4 PathJoinSubstitution",
    "1.4 PythonExpression",
    "1.4 Command",
    "1.4 NotSubstitution",
    "1.4 AndSubstitution",
    "1.4 AnySubstitution",
    "1.4 IfElseSubstitution",
    "1.4 LaunchLogDir",
    "1.2 Substitution",
    "1.12.1 later names",
    "D43",
)
@pytest.mark.parametrize(
    ("substitution", "text"),
    [
        (TextSubstitution(text="$(var a)"), "$(var a)"),
        (LC("a"), "A"),
        (LC("none", default=True), "True"),
        (LC("none", default=["x", 1, LC("a")]), "x1A"),
        (LC("none", default=""), ""),
        (EnvironmentVariable("HOME"), "/home/robot"),
        (EnvironmentVariable("EMPTY", default_value="x"), ""),
        (EnvironmentVariable("NONE", default_value=[LC("a"), "b"]), "Ab"),
        (PathJoinSubstitution(["a", "b"]), "a/b"),
        (PathJoinSubstitution(["a", "/b", "c"]), "/b/c"),
        (PathJoinSubstitution(["a", ["b_", LC("a"), ".yaml"]]), "a/b_A.yaml"),
        (PathJoinSubstitution([LC("a")]), "A"),
        (PathSubstitution(Path("a")) / "b" / (TextSubstitution(text="c"), ".x"), "a/b/c.x"),
        ("a" / LC("a"), "a/A"),
        (PathSubstitution("a"), "a"),
        (PythonExpression(["'", LC("a"), "' == 'A'"]), "True"),
        (PythonExpression("ceil(math.pi)"), "4"),
        (PythonExpression("os.path.join('a', 'b')", ["os.path"]), "a/b"),
        (PythonExpression([LC("n"), " + 1"], []), "4"),
        (PythonExpression("[x for x in range(2) if x == math.floor(1.5)]"), "[1]"),
        (Command("echo a 'b c'"), "a b c"),
        (Command("sh -c 'echo a; echo b >&2'", on_stderr="ignore"), "a"),
        (Command("sh -c 'echo a >&2'", on_stderr=["cap", "ture"]), "a"),
        (NotSubstitution(LC("yes")), "false"),
        (NotSubstitution("off"), "true"),
        (AndSubstitution(LC("yes"), "1"), "true"),
        (AndSubstitution("1", LC("no")), "false"),
        (OrSubstitution(LC("no"), "1"), "true"),
        (OrSubstitution("0", "false"), "false"),
        (AnySubstitution(), "false"),
        (AnySubstitution("0", LC("yes"), "0"), "true"),
        (AllSubstitution(), "true"),
        (AllSubstitution("1", LC("no")), "false"),
        (IfElseSubstitution(LC("yes"), "a", LC("none")), "a"),
        (IfElseSubstitution(LC("no"), LC("none"), ["b", LC("a")]), "bA"),
        (IfElseSubstitution("off", "a"), ""),
        (StringJoinSubstitution(["a", ["b", LC("a")]]), "abA"),
        (StringJoinSubstitution(["a", LC("a"), "b"], delimiter=["-", LC("n")]), "a-3A-3b"),
        (StringJoinSubstitution([]), ""),
        (Shouted(["x", LC("n"), LC("none", default="y")]), "X3Y"),
        (PathJoinSubstitution([Shouted("x"), Shouted(LC("a"))]), "X/A"),
        (LaunchLogDir(), "${run}/logs"),
    ],
)
def test_performs(substitution: Substitution, text: str, context: LaunchContext) -> None:
    assert substitution.perform(context) == text
    assert context.perform_substitution(substitution) == text
    assert context._engine.evaluate(template(["<", substitution, ">"], _SPAN)) == f"<{text}>"


@pytest.mark.conforms("1.4 EqualsSubstitution")
@pytest.mark.parametrize(
    ("left", "right", "equal"),
    [
        (None, None, True),
        (None, "", True),
        (None, "x", False),
        (True, "TRUE", True),
        (True, 1, True),
        (False, "0", True),
        (True, "10", False),
        (10, 10.0 + 1e-10, True),
        (10, -10, False),
        ("nan", float("nan"), False),
        ("inf", float("inf"), True),
        ("wow", "wow", True),
        ("wow", True, False),
        (["w", TextSubstitution(text="ow")], "wow", True),
        (PathJoinSubstitution(["a", "b"]), "a/b", True),
        (LC("n"), 3, True),
        ([1, 2], "[1, 2]", True),
    ],
)
def test_compares(left: Any, right: Any, equal: bool, context: LaunchContext) -> None:
    for sides in ((left, right), (right, left)):
        assert EqualsSubstitution(*sides).perform(context) == str(equal).lower()
        assert NotEqualsSubstitution(*sides).perform(context) == str(not equal).lower()


@pytest.mark.conforms(
    "1.4 LaunchConfiguration",
    "1.4 EnvironmentVariable",
    "1.4 FindExecutable",
    "1.4 FileContent",
    "1.4 Command",
    "1.4 NotSubstitution",
    "1.4 AndSubstitution",
    "1.4 AnySubstitution",
    "1.4 IfElseSubstitution",
    "1.4 ThisLaunchFile",
    "1.4 ThisLaunchFileDir",
)
@pytest.mark.parametrize(
    "substitution",
    [
        LC("none"),
        LC(["no", LC("none")], default="x"),
        EnvironmentVariable("NONE"),
        FindExecutable(name="no-such-program"),
        FileContent("no-such-file"),
        Command("no-such-program"),
        Command("false"),
        Command("sh -c 'echo a >&2'"),
        Command("true", on_stderr="shout"),
        NotSubstitution("maybe"),
        AndSubstitution("1", ""),
        OrSubstitution("2", "1"),
        AnySubstitution("1", "maybe"),
        AllSubstitution("0", "maybe"),
        IfElseSubstitution("maybe", "a"),
        ThisLaunchFile(),
        ThisLaunchFileDir(),
    ],
    ids=lambda value: value.describe(),
)
def test_says_that_it_cannot_be_performed(substitution: Substitution, context: LaunchContext) -> None:
    with pytest.raises(SubstitutionFailure):
        substitution.perform(context)


@pytest.mark.conforms("1.4 PythonExpression")
@pytest.mark.parametrize(
    ("expression", "modules", "error"),
    [
        ("ceil(1.5)", [], NameError),
        ("sys.path", "math", NameError),
        ("1 / 0", "math", ZeroDivisionError),
        ("1 +", "math", SyntaxError),
        ("1", ["no_such_module"], ImportError),
    ],
)
def test_an_expression_raises_what_it_raises(
    expression: str, modules: Any, error: type[Exception], context: LaunchContext
) -> None:
    with pytest.raises(error):
        PythonExpression(expression, modules).perform(context)


@pytest.mark.conforms("1.4 LocalSubstitution", "1.2 LaunchContext.locals", "1.2 LaunchContext.extend_locals")
def test_locals_are_what_the_context_knows(context: LaunchContext, tmp_path: Path) -> None:
    with pytest.raises(AttributeError, match="reason"):
        LocalSubstitution("reason").perform(context)
    context.extend_locals({"reason": tmp_path, "ForEachVar__robot": 2})
    assert LocalSubstitution("reason").perform(context) is tmp_path
    assert LocalSubstitution("reason.name.upper()").perform(context) == tmp_path.name.upper()
    assert ForEachVar("robot").perform(context) == "2"
    assert ForLoopIndex(TextSubstitution(text="robot")).perform(context) == "2"
    assert ForEachVar("other", default_value=LC("a")).perform(context) == "A"
    with pytest.raises(RuntimeError, match="other"):
        ForEachVar("other").perform(context)


@pytest.mark.conforms("1.4 ThisLaunchFile", "1.4 ThisLaunchFileDir")
def test_a_launch_file_may_be_put_among_the_locals(context: LaunchContext) -> None:
    context.extend_locals({"current_launch_file_directory": "d", "current_launch_file_path": "d/f"})
    assert ThisLaunchFileDir().perform(context) == "d"
    assert ThisLaunchFile().perform(context) == "d/f"


@pytest.mark.conforms("1.4 AnonName")
def test_the_same_name_is_made_unique_once(context: LaunchContext) -> None:
    first = AnonName(["fo", "o"]).perform(context)
    assert first.startswith("foo_")
    assert AnonName("foo").perform(context) == first
    assert AnonName("bar").perform(context) != first


@pytest.mark.conforms("1.4 TextSubstitution", "D55")
@pytest.mark.parametrize(
    "make",
    [
        lambda: TextSubstitution(text=1),
        lambda: LC(1),
        lambda: LC("a", default=[["nested"]]),
        lambda: EnvironmentVariable("a", default_value=1),
        lambda: PathJoinSubstitution(["a", 1]),
        lambda: PathJoinSubstitution([]),
        lambda: PathJoinSubstitution(1),
        lambda: PythonExpression(None),
        lambda: PythonExpression("1", 1),
        lambda: LocalSubstitution(LC("a")),
        lambda: FindExecutable("sh"),
        lambda: Command(["ls", None]),
        lambda: NotSubstitution(True),
        lambda: AndSubstitution("1"),
        lambda: AnySubstitution(True),
        lambda: IfElseSubstitution(True, "a"),
        lambda: StringJoinSubstitution([1]),
        lambda: PathSubstitution(1),
        lambda: AnonName(b"a"),
    ],
)
def test_other_types_are_refused(make: Any) -> None:
    with pytest.raises(TypeError):
        make()


@pytest.mark.conforms("1.4 IfElseSubstitution")
def test_one_value_of_two_is_needed() -> None:
    with pytest.raises(RuntimeError, match="if_value"):
        IfElseSubstitution("true")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("$(var a b)", "$(var a b)"),
        ("$(env a '')", "$(env a '')"),
        ("$(eval 1 'math, sys')", "$(eval 1 'math, sys')"),
        ("$(eval 1 '')", "$(eval 1 '')"),
        ("$(command ls fail)", "$(command ls)"),
        ("$(path-join a$(var b) c)", "$(path-join a$(var b) c)"),
        ("$(string-join , a$(var b) c)", "$(string-join , a$(var b) c)"),
        ("$(any)", "$(any)"),
        ("$(all 1 0 $(var a))", "$(all 1 0 $(var a))"),
        ("$(if 1 a)", "$(if 1 a '')"),
        ("$(dirname)", "$(dirname)"),
    ],
)
def test_is_built_from_the_arguments_of_a_call(text: str, expected: str) -> None:
    """The way in which front ends make substitutions, and third parties call `parse`."""
    (call,) = parse_template(text, lambda _first, _last: _SPAN, Problems()).parts
    assert isinstance(call, Call)
    kind = next(kind for kind in map(names.__getattr__, names.__all__) if _name_of(kind) == call.name)
    built, keywords = kind.parse([[_from(part) for part in argument.parts] for argument in call.arguments])
    assert built is kind
    assert template(kind(**keywords), _SPAN).raw == expected


def _name_of(kind: Any) -> str | None:
    return vars(kind).get("_name")


def _from(part: Any) -> Substitution:
    if isinstance(part, Words):
        return TextSubstitution(text=part.text)
    assert isinstance(part, Call)
    return LaunchConfiguration([_from(item) for item in part.arguments[0].parts])


@pytest.mark.parametrize(
    "kind", [LC, EnvironmentVariable, NotSubstitution, PythonExpression, IfElseSubstitution]
)
def test_a_call_with_too_many_arguments_is_refused(kind: Any) -> None:
    with pytest.raises(TypeError, match="arguments"):
        kind.parse([[TextSubstitution(text=text)] for text in "abcd"])


def test_knows_where_it_was_made() -> None:
    made = LaunchConfiguration(
        "a",
    )
    (part,) = template(made, _SPAN).parts
    assert isinstance(part, Call)
    assert Path(part.span.file).name == Path(__file__).name
    assert (part.span.line, part.span.end_line) == (_line("made = LaunchConfiguration("), part.span.line + 2)


def _line(text: str) -> int:
    lines = Path(__file__).read_text("utf-8").splitlines()
    return next(number for number, line in enumerate(lines, 1) if line.strip() == text)


class Upper(LaunchConfiguration):
    def perform(self, context: LaunchContext) -> str:
        return super().perform(context).upper()


class Beneath(PathSubstitution):
    def perform(self, context: LaunchContext) -> str:
        return "beneath/" + super().perform(context)


class Named(LaunchConfiguration):
    """Says nothing of how it is performed."""

    def describe(self) -> str:
        return "named"


def test_what_users_perform_is_theirs_alone(context: LaunchContext) -> None:
    for own, text in ((Upper("yes"), "TRUE"), (Beneath("a"), "beneath/a"), (Shouted("x"), "X")):
        (part,) = template(own, _SPAN).parts
        assert isinstance(part, Opaque)
        assert part.target is own
        assert context._engine.evaluate(template(own, _SPAN)) == text
    (part,) = template(Upper("yes"), _SPAN).parts
    assert isinstance(part, Opaque)
    assert [inside.raw for inside in part.inside] == ["yes"]
    assert isinstance(template(Named("a"), _SPAN).parts[0], Call)


class Prefixed(LaunchConfiguration):
    """Has another name than the one that it is given."""

    @property
    def variable_name(self) -> list[Substitution]:
        return normalized(["prefixed_", *super().variable_name])


def test_the_name_that_a_users_class_says_counts(context: LaunchContext) -> None:
    own = Prefixed("a")
    assert template(own, _SPAN).raw == "$(var prefixed_a)"
    context.launch_configurations["prefixed_a"] = "b"
    assert own.perform(context) == "b"
    assert own.describe() == "LaunchConfig('prefixed_' + 'a')"


def test_everything_is_exported_and_nothing_heavy_imported() -> None:
    code = (
        "import sys; from orchestra.compat.launch import substitutions as s;"
        "[getattr(s, name) for name in s.__all__];"
        "print(*(name for name in ('pydantic', 'yaml', 'asyncio') if name in sys.modules))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split() == []
    assert len(names.__all__) == 27
