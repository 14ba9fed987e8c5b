from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Code, Severity

if TYPE_CHECKING:
    from pathlib import Path

    from tests.resolve.texts.conftest import Place


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("$(var a '$(env NOPE)')", "A"),
        ("$(env E1 '$(var missing)')", "envval"),
        ("$(if true x '$(var missing)')", "x"),
        ("$(if 0 '$(var missing)' y)", "y"),
        ("$(if off '$(var missing)')", ""),
    ],
)
def test_what_is_not_needed_is_not_evaluated(text: str, value: str, place: Place) -> None:
    assert place.value(text) == value
    assert not len(place.problems)


@pytest.mark.parametrize(
    ("text", "code", "at", "suggestion"),
    [
        ("x $(var wrold)", Code.UNDEFINED_VARIABLE, "wrold", "world"),
        ("$(var 'wrold')", Code.UNDEFINED_VARIABLE, "wrold", "world"),
        ("$(env AMENT_PREFIX)", Code.UNSET_ENVIRONMENT, "AMENT_PREFIX", "AMENT_PREFIX_PATH"),
        ("$(param use_simtime)", Code.UNDEFINED_VARIABLE, "use_simtime", "use_sim_time"),
        ("$(dirname)/x", Code.NO_CURRENT_FILE, "$(dirname)", None),
        ("$(filename)", Code.NO_CURRENT_FILE, "$(filename)", None),
        (
            "$(find-pkg-share robot_descripton)/urdf",
            Code.MISSING_PACKAGE,
            "robot_descripton",
            "robot_description",
        ),
        (
            "$(find-pkg-prefix robot-description)",
            Code.MISSING_PACKAGE,
            "robot-description",
            "robot_description",
        ),
        ("$(exec-in-pkg show_robot other)", Code.MISSING_PACKAGE, "other", None),
        ("$(exec-in-pkg showrobot robot_description)", Code.MISSING_EXECUTABLE, "showrobot", "show_robot"),
        ("$(find-exec nosuchprogram)", Code.MISSING_EXECUTABLE, "nosuchprogram", None),
        ("$(eval '1 +')", Code.BAD_EXPRESSION, "$(eval '1 +')", None),
        ("$(not maybe)", Code.BAD_VALUE, "maybe", None),
        ("$(and true $(var a))", Code.BAD_VALUE, "$(var a)", None),
        ("$(if '' a b)", Code.BAD_VALUE, "", None),
        ("$(command '')", Code.COMMAND_FAILED, "", None),
        ('$(command "it\'s")', Code.COMMAND_FAILED, "it's", None),
        ("$(command true ingore)", Code.BAD_VALUE, "ingore", "ignore"),
    ],
)
def test_a_fault_is_told_where_it_is_written(
    text: str, code: Code, at: str, suggestion: str | None, place: Place
) -> None:
    place.set("world", "maze")
    place.context = replace(place.context, parameters={"use_sim_time": "true"})
    problem = place.refusal(text)
    assert (problem.code, place.stretch(problem.span), problem.suggestion) == (code, at, suggestion)


def test_what_was_meant_is_a_note_where_the_text_is_itself_substituted(place: Place) -> None:
    place.set("world", "maze")
    place.set("typed", "wrold")
    problem = place.refusal("$(var $(var typed))")
    assert (problem.suggestion, problem.notes) == (None, ("did you mean 'world'?",))


def test_the_current_file_and_its_folder(place: Place) -> None:
    place.context = replace(place.context, file="/opt/robot/launch/main.launch.xml")
    assert place.value("$(dirname)/../params") == "/opt/robot/launch/../params"
    assert place.value("$(filename)") == "/opt/robot/launch/main.launch.xml"


def test_packages_are_found_by_share_folder_and_prefix(place: Place, package: Path) -> None:
    assert (
        place.value("$(find-pkg-share robot_description)/urdf") == f"{package}/share/robot_description/urdf"
    )
    assert place.value("$(find-pkg-prefix robot_description)") == str(package)
    assert (
        place.value("$(exec-in-pkg show_robot robot_description)")
        == f"{package}/lib/robot_description/show_robot"
    )


def test_an_executable_without_a_path_of_its_own_is_refused(
    place: Place, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    nodes = tmp_path / "python_robot/nodes"
    nodes.mkdir(parents=True)
    for file in (nodes.parent / "__init__.py", nodes / "__init__.py", nodes / "driver.py"):
        file.touch()
    monkeypatch.syspath_prepend(str(tmp_path))
    problem = place.refusal("$(exec-in-pkg driver python_robot)")
    assert problem.code is Code.MISSING_EXECUTABLE
    assert "python_robot.nodes.driver" in problem.notes[0]


def test_programs_are_looked_for_on_the_path_of_the_description(place: Place, tmp_path: Path) -> None:
    program = tmp_path / "bin/simulate_robot"
    program.parent.mkdir()
    program.write_text("#!/bin/sh\n")
    program.chmod(0o755)
    place.scope.environment["PATH"] = f"/nowhere:{program.parent}"
    assert place.value("$(find-exec simulate_robot)") == str(program)
    assert place.refusal("$(find-exec simulate-robot)").suggestion == "simulate_robot"


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("'sqrt(16) + math.floor(2.5)'", "6.0"),
        ("\"'a' if True else 'b'\"", "a"),
        ("'[x * y for x in (1, 2) for y in (n for n in (3,))]'", "[3, 6]"),
        ("'os.path.join(\"a\", json.dumps(1))' 'os.path, json'", "a/1"),
        ("'e' 'math'", str(math.e)),
        ("'None'", "None"),
        ("'\n 1\n'", "1"),
    ],
)
def test_eval_is_python_with_math(expression: str, value: str, place: Place) -> None:
    assert place.value(f"$(eval {expression})") == value


@pytest.mark.parametrize(
    ("expression", "told"),
    [
        ("'1 / 0'", "ZeroDivisionError: division by zero"),
        ("'[' ", "SyntaxError"),
        ("'1' nosuchmodule", "No module named 'nosuchmodule'"),
        ("'exit(3)'", "SystemExit: 3"),
        ("'(_ for _ in ()).throw(GeneratorExit)'", "GeneratorExit"),
        (r"'(lambda f: f\(f\))(lambda f: f(f))'", "RecursionError"),
        ("'\"x\" * (1 << 60)'", "MemoryError"),
        ("'10 ** 10000'", "ValueError"),
        ("'type(\"T\", (), dict(__str__=lambda s: 1 / 0))()'", "ZeroDivisionError"),
        (
            "'(_ for _ in ()).throw(type(\"E\", (Exception,), dict(__str__=lambda s: 1 / 0)))'",
            "E: it cannot even say why",
        ),
    ],
)
def test_whatever_an_expression_raises_is_a_problem_at_its_call(
    expression: str, told: str, place: Place
) -> None:
    problem = place.refusal(f"x $(eval {expression})")
    assert problem.code is Code.BAD_EXPRESSION
    assert told in problem.message
    # What fails while the result becomes a text is told where it stands.
    part = "1 / 0" if told == "ZeroDivisionError" else f"$(eval {expression})"
    assert place.stretch(problem.span) == part


def test_a_failing_expression_is_shown_as_it_was_evaluated(place: Place) -> None:
    problem = place.refusal("$(eval '$(var a) == 1')")
    assert problem.notes == ("the expression is 'A == 1' here", "text needs quotes of its own: 'A'")


def test_a_name_near_to_one_that_is_there_is_a_note(place: Place) -> None:
    assert "did you mean 'True'?" in place.refusal("$(eval '$(var b)')").notes


def test_what_python_doubts_in_an_expression_is_a_warning(place: Place) -> None:
    assert place.value("$(eval '1 is 1')") == "True"
    (problem,) = place.problems
    assert (problem.code, problem.severity) == (Code.BAD_EXPRESSION, Severity.WARNING)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("$(any)", "false"),
        ("$(all)", "true"),
        ("$(any no $(var b) 0)", "true"),
        ("$(any false off)", "false"),
        ("$(all 1 yes on)", "true"),
        ("$(all true false true)", "false"),
        ("$(or false $(var b))", "true"),
        ("$(and $(not false) $(var b))", "true"),
        ("$(not-equals 1 1.0)", "false"),
        ("$(not-equals yes true)", "true"),
        ("$(equals nan nan)", "false"),
        ("$(equals inf Infinity)", "true"),
        ("$(equals '1' TRUE)", "true"),
    ],
)
def test_logic_and_equality(text: str, value: str, place: Place) -> None:
    assert place.value(text) == value


def test_every_argument_that_is_not_a_boolean_is_told(place: Place) -> None:
    assert place.value("$(all maybe true perhaps)") is None
    assert [place.stretch(problem.span) for problem in place.problems] == ["maybe", "perhaps"]


def test_an_anonymous_name_is_stable_and_a_name(place: Place) -> None:
    place.context = replace(place.context, file="/here/main.yaml")
    name = place.value("$(anon listener-1.2:x)")
    assert name is not None
    assert name.startswith("listener_1_2_x_")
    assert name.replace("_", "").isalnum()
    assert place.value("$(anon listener-1.2:x)") == name
    elsewhere = replace(place.context, file="/there/main.yaml", anonymous={})
    other_file = replace(place.context, file="/here/other.yaml", anonymous={})
    place.context = elsewhere
    assert place.value("$(anon listener-1.2:x)") == name
    place.context = other_file
    assert place.value("$(anon listener-1.2:x)") != name


def test_one_name_is_anonymous_in_one_way_across_files(place: Place) -> None:
    place.context = replace(place.context, file="/here/main.yaml")
    name = place.value("$(anon x)")
    place.context = replace(place.context, file="/here/included.yaml")
    assert place.value("$(anon x)") == name
    assert place.value("$(anon y)") != name


def test_parameters_in_scope(place: Place) -> None:
    place.context = replace(place.context, parameters={"use_sim_time": "true"})
    assert place.value("$(param use_sim_time) $(param other '$(var a)')") == "true A"


def test_the_log_folder_is_symbolic(place: Place) -> None:
    assert place.value("$(log_dir)") == place.value("$(launch_log_dir)") == "${run}/logs"


class TestFileContent:
    def test_a_path_is_relative_to_the_launch_file_then_to_the_working_folder(
        self, place: Place, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        for folder, names in {"launch": ["both"], "work": ["both", "one"]}.items():
            (tmp_path / folder).mkdir()
            for name in names:
                (tmp_path / folder / name).write_text(f"{folder} é\n", encoding="utf-8")
        monkeypatch.chdir(tmp_path / "work")
        place.context = replace(place.context, file=str(tmp_path / "launch/main.yaml"))
        assert place.value("$(file-content both)") == "launch é\n"
        assert place.value("$(file-content one)") == "work é\n"
        assert place.value(f"$(file-content '{tmp_path}/work/one')") == "work é\n"

    def test_a_missing_file_suggests_the_one_beside(self, place: Place, tmp_path: Path) -> None:
        (tmp_path / "robot.urdf").touch()
        problem = place.refusal(f"$(file-content '{tmp_path}/robt.urdf')")
        assert (problem.code, problem.suggestion) == (Code.MISSING_FILE, f"{tmp_path}/robot.urdf")

    def test_what_cannot_be_read_is_told(self, place: Place, tmp_path: Path) -> None:
        (tmp_path / "binary").write_bytes(b"\xff\xfe")
        for path in (tmp_path, tmp_path / "binary", "/dev/zero", "a" * 5000):
            assert place.value(f"$(file-content '{path}')") is None
        assert [problem.code for problem in place.problems] == [Code.UNREADABLE_FILE] * 4


class TestYamlValue:
    @pytest.fixture(autouse=True)
    def _files(self, place: Place, tmp_path: Path) -> None:
        text = "robots:\n  robot1: {x: 1.50, mode: }\n  robot2:\nseeds: [1, 'two']\ndeep: [[1]]\nflag: yes\n"
        (tmp_path / "fleet.yaml").write_text(text)
        (tmp_path / "list.yaml").write_text("[a, b]")
        (tmp_path / "empty.yaml").write_text("# nothing\n")
        (tmp_path / "broken.yaml").write_text("a: 1\nb: [1\n")
        (tmp_path / "twice.yaml").write_text("a: 1\na: 2\n")
        place.context = replace(place.context, file=str(tmp_path / "main.yaml"))

    @pytest.mark.parametrize(
        ("text", "value"),
        [
            ("$(yaml-value fleet.yaml robots)", "robot1, robot2"),
            ("$(yaml-value fleet.yaml robots.robot1.x)", "1.50"),
            ("$(yaml-value fleet.yaml robots.robot1.mode)", ""),
            ("$(yaml-value fleet.yaml seeds)", "1, two"),
            ("$(yaml-value fleet.yaml flag)", "yes"),
            ("$(yaml-value fleet.yaml robots.robot2.x '$(var a)')", "A"),
            ("$(yaml-value fleet.yaml robots '$(var missing)')", "robot1, robot2"),
            ("$(yaml-value list.yaml a none)", "none"),
            ("$(yaml-value empty.yaml a none)", "none"),
        ],
    )
    def test_gives_what_stands_under_the_key(self, text: str, value: str, place: Place) -> None:
        assert place.value(text) == value
        assert not len(place.problems)

    @pytest.mark.parametrize(
        ("text", "code", "suggestion"),
        [
            ("$(yaml-value fleet.yaml robts)", Code.UNDEFINED_VARIABLE, "robots"),
            ("$(yaml-value fleet.yaml robots.robt1.x)", Code.UNDEFINED_VARIABLE, "robots.robot1.x"),
            ("$(yaml-value fleet.yaml flag.x)", Code.UNDEFINED_VARIABLE, None),
            ("$(yaml-value empty.yaml a)", Code.UNDEFINED_VARIABLE, None),
            ("$(yaml-value fleet.yaml deep)", Code.BAD_VALUE, None),
        ],
    )
    def test_a_key_that_is_not_there_is_told(
        self, text: str, code: Code, suggestion: str | None, place: Place
    ) -> None:
        problem = place.refusal(text)
        assert (problem.code, problem.suggestion) == (code, suggestion)

    def test_a_file_that_is_not_there_suggests_the_one_beside(self, place: Place) -> None:
        problem = place.refusal("$(yaml-value flet.yaml robots)")
        assert (problem.code, problem.suggestion) == (Code.MISSING_FILE, "fleet.yaml")

    @pytest.mark.parametrize(("name", "line"), [("broken.yaml", 2), ("twice.yaml", 2)])
    def test_what_is_wrong_in_the_file_is_told_there(
        self, name: str, line: int, place: Place, tmp_path: Path
    ) -> None:
        place.value(f"$(yaml-value {name} a)")
        place.value(f"$(yaml-value {name} b x)")
        (problem,) = place.problems
        assert problem.span is not None
        assert (problem.span.file, problem.span.line) == (str(tmp_path / name), line)


class TestCommand:
    def test_one_final_line_break_goes_away(self, place: Place) -> None:
        assert place.value("<$(command \"printf 'a\\\\n\\\\n'\")>") == "<a\n>"

    def test_it_sees_the_environment_of_the_description_and_no_shell(self, place: Place) -> None:
        assert place.value("$(command \"sh -c 'echo $E1 $(var a)'\") $(command 'echo $E1')") == "envval A $E1"

    @pytest.mark.parametrize(
        ("on_stderr", "value", "severities"),
        [
            ("", None, [Severity.ERROR]),
            ("fail", None, [Severity.ERROR]),
            ("ignore", "out", []),
            ("warn", "out", [Severity.WARNING]),
            ("capture", "out\nerr", []),
        ],
    )
    def test_what_standard_error_does(
        self, on_stderr: str, value: str | None, severities: list[Severity], place: Place
    ) -> None:
        assert place.value(f"$(command \"sh -c 'echo out; echo err >&2'\" {on_stderr})") == value
        assert [problem.severity for problem in place.problems] == severities
        assert all("it says: err" in problem.notes for problem in place.problems)

    def test_a_program_that_is_not_there_is_told_at_its_name(self, place: Place) -> None:
        problem = place.refusal("$(command 'nosuchprogram -x' ignore)")
        assert problem.code is Code.MISSING_EXECUTABLE
        assert place.stretch(problem.span) == "nosuchprogram"

    @pytest.mark.parametrize(
        ("command", "told"),
        [
            ("sh -c 'exit 3'", "command 'sh' ended with status 3"),
            ("sh -c 'kill -9 $$'", "command 'sh' was ended by signal 9"),
        ],
    )
    def test_a_failure_is_told_at_the_call(self, command: str, told: str, place: Place) -> None:
        problem = place.refusal(f'x $(command "{command}" ignore)')
        assert (problem.code, problem.message) == (Code.COMMAND_FAILED, told)
        assert place.stretch(problem.span) == f'$(command "{command}" ignore)'
