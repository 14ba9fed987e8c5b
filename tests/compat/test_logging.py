from __future__ import annotations

import logging
import re
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.compat.launch import logging as launch_logging
from orchestra.compat.launch.launch_context import LaunchContext
from orchestra.compat.launch.logging import handlers, launch_config
from orchestra.compat.launch.substitutions import LaunchLogDir, PathJoinSubstitution
from tests.compat.contexts import loading

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path


@pytest.fixture(autouse=True)
def _fresh(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    for name in ("OVERRIDE_LAUNCH_SCREEN_FORMAT", "OVERRIDE_LAUNCH_LOG_FORMAT"):
        monkeypatch.delenv(name, raising=False)
    launch_logging.reset()
    yield
    launch_logging.reset()


@pytest.mark.conforms("1.11 get_logger", "D57")
def test_messages_go_to_standard_error(capsys: pytest.CaptureFixture[str]) -> None:
    logger = launch_logging.get_logger("some.name")
    assert launch_logging.get_logger("some.name") is logger
    logger.info("a %s {b}", 1)
    logger.debug("not seen")
    launch_logging.get_logger().warning("from the root")
    shown = capsys.readouterr()
    assert shown.err.splitlines() == ["[INFO] [some.name]: a 1 {b}", "[WARNING] [root]: from the root"]
    assert shown.out == ""


@pytest.mark.conforms("1.11 launch_config")
def test_the_level_is_that_of_all_loggers(capsys: pytest.CaptureFixture[str]) -> None:
    launch_config.level = logging.DEBUG
    launch_logging.get_logger("a").debug("seen")
    launch_config.level = logging.ERROR
    launch_logging.get_logger("a").warning("not seen")
    assert launch_config.level == logging.ERROR
    assert capsys.readouterr().err.splitlines() == ["[DEBUG] [a]: seen"]


@pytest.mark.conforms("1.11 launch_config")
@pytest.mark.parametrize(
    ("form", "style", "line"),
    [
        ("default", None, r"\[INFO\] \[a\]: said"),
        ("default_with_timestamp", None, r"\d+\.\d{7} \[INFO\] \[a\]: said"),
        ("{name}|{msg}", None, r"a\|said"),
        ("%(levelname)s %(message)s", "%", "INFO said"),
    ],
)
def test_messages_look_as_set(form: str, style: Any, line: str, capsys: pytest.CaptureFixture[str]) -> None:
    launch_logging.get_logger("a").info("before")
    launch_config.set_screen_format(form, screen_style=style)
    launch_logging.get_logger("a").info("said")
    assert re.fullmatch(line, capsys.readouterr().err.splitlines()[1])


@pytest.mark.conforms(
    "4.10 OVERRIDE_LAUNCH_SCREEN_FORMAT", "4.10 OVERRIDE_LAUNCH_LOG_FORMAT", "1.11 get_logger"
)
def test_the_environment_has_the_last_word(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    monkeypatch.setenv("OVERRIDE_LAUNCH_SCREEN_FORMAT", r"<{message}>\t{name}")
    monkeypatch.setenv("OVERRIDE_LAUNCH_LOG_FORMAT", "{name}:{message}")
    launch_logging.reset()
    launch_config.log_dir = str(tmp_path)
    launch_config.set_screen_format("default", screen_style="%")
    launch_logging.get_logger("a").info("said")
    assert capsys.readouterr().err == "<said>\ta\n"
    assert (tmp_path / "launch.log").read_text() == "a:said\n"


def test_a_named_format_has_a_style_of_its_own() -> None:
    with pytest.raises(ValueError, match="style"):
        launch_config.set_screen_format("default", screen_style="%")
    with pytest.raises(ValueError, match="style"):
        launch_config.set_log_format("default", log_style="%")


@pytest.mark.conforms("1.11 launch_config", "1.4 LaunchLogDir")
def test_the_folder_is_that_of_the_run_unless_another_is_set(tmp_path: Path) -> None:
    assert launch_config.get_log_file_path("a.log") == "${run}/logs/a.log"
    with pytest.raises(ValueError, match="no folder"):
        launch_config.log_dir = "no/such/folder"
    launch_config.log_dir = tmp_path
    assert launch_config.get_log_file_path() == str(tmp_path / "launch.log")
    with loading({}):
        context = LaunchContext()
        path = PathJoinSubstitution([LaunchLogDir(), "x"])
        assert path.perform(context) == str(tmp_path / "x")
        launch_config.log_dir = None
        assert path.perform(context) == "${run}/logs/x"
        assert LaunchLogDir().perform(context) == "${run}/logs"


@pytest.mark.conforms("D57")
def test_nothing_is_written_outside_the_run_unasked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    launch_logging.get_logger("a").error("said")
    launch_logging.get_output_loggers("node", "full")[0].error("said")
    launch_config.log_dir = str(tmp_path)
    assert not list(tmp_path.iterdir())
    launch_logging.reset()
    assert launch_config.given_log_dir is None


@pytest.mark.conforms("1.11 get_output_loggers")
@pytest.mark.parametrize(
    ("config", "screen", "files"),
    [
        ("screen", ["out", "err"], {}),
        ("log", ["err"], {"launch.log": ["out", "err"]}),
        ("both", ["out", "err"], {"launch.log": ["out", "err"]}),
        ("own_log", [], {"node-stdout.log": ["out"], "node-stderr.log": ["err"], "node.log": ["out", "err"]}),
        (
            "full",
            ["out", "err"],
            {
                "launch.log": ["out", "err"],
                "node-stdout.log": ["out"],
                "node-stderr.log": ["err"],
                "node.log": ["out", "err"],
            },
        ),
        ({"both": "own_log"}, [], {"node.log": ["out", "err"]}),
        ({"stdout": {"screen", "log"}, "stderr": ["own_log"]}, ["out"], {"launch.log": ["out"], "node-stderr.log": ["err"]}),
        ({}, [], {}),
    ],
)  # fmt: skip
def test_output_goes_where_it_is_said(
    config: Any,
    screen: list[str],
    files: dict[str, list[str]],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    launch_config.log_dir = str(tmp_path)
    stdout, stderr = launch_logging.get_output_loggers("node", config)
    stdout.info("out")
    stderr.info("err")
    assert (stdout.name, stderr.name) == ("node-stdout", "node-stderr")
    assert capsys.readouterr().err.splitlines() == screen
    found = {
        path.name: [line.split()[-1] for line in path.read_text().splitlines()] for path in tmp_path.iterdir()
    }
    assert found == files


@pytest.mark.parametrize("config", ["loud", {"out": "log"}, {"stdout": "loud"}, {"stdout": {"loud"}}, 1])
def test_other_words_for_output_are_refused(config: Any) -> None:
    with pytest.raises(ValueError, match=r"none of|no output"):
        launch_logging.get_output_loggers("node", config)


@pytest.mark.conforms("1.11 launch_config", "1.11 handlers")
def test_files_may_be_written_by_the_users_own_handlers(tmp_path: Path) -> None:
    said: list[str] = []

    class Own(handlers.Handler):
        def emit(self, record: logging.LogRecord) -> None:
            said.append(self.format(record))

    def make(path: str, encoding: str) -> Any:
        said.append(f"{path} {encoding}")
        return Own()

    launch_config.log_dir = str(tmp_path)
    launch_config.log_handler_factory = make
    logger = launch_logging.get_logger("a")
    launch_config.get_log_file_handler().setFormatterFor(logger, logging.Formatter("!{message}", style="{"))
    logger.info("one")
    launch_config.get_log_file_handler().unsetFormatterFor(logger)
    launch_config.set_log_format("{message}")
    logger.info("two")
    assert said == [f"{tmp_path / 'launch.log'} utf-8", "!one", "two"]


@pytest.mark.conforms("1.11 handlers")
def test_handlers_are_those_of_python() -> None:
    assert issubclass(handlers.RotatingFileHandler, logging.handlers.RotatingFileHandler)
    assert handlers.NullHandler is handlers.NullHandler
    with pytest.raises(AttributeError, match="LogRecord"):
        handlers.LogRecord  # noqa: B018


@pytest.mark.conforms("1.11 log_launch_config")
def test_the_settings_are_told(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    launch_config.log_dir = str(tmp_path)
    launch_logging.log_launch_config(logger=launch_logging.get_logger("launch"))
    assert capsys.readouterr().err.splitlines() == [
        f"[INFO] [launch]: Log files are in {tmp_path}",
        "[INFO] [launch]: Messages are written from the level INFO on",
    ]


@pytest.mark.conforms("1.11 propagation", "1.11 reset")
def test_the_loggers_of_python_are_left_alone() -> None:
    before = (logging.root.level, list(logging.root.handlers), set(logging.root.manager.loggerDict))
    launch_config.level = logging.DEBUG
    launch_logging.get_logger().setLevel(logging.CRITICAL)
    launch_logging.get_logger("of.launch").addHandler(logging.NullHandler())
    assert (logging.root.level, list(logging.root.handlers), set(logging.root.manager.loggerDict)) == before
    assert logging.getLoggerClass() is logging.Logger
    launch_logging.reset()
    assert launch_logging.get_logger("of.launch").handlers == launch_logging.get_logger("other").handlers
    assert launch_config.level == logging.INFO


@pytest.mark.conforms("1.11 launch_config")
@pytest.mark.parametrize(
    ("variables", "folder"),
    [
        ({}, "/home/her/.ros/log"),
        ({"ROS_HOME": "/ros"}, "/ros/log"),
        ({"ROS_HOME": "/ros", "ROS_LOG_DIR": "~/logs//own/"}, "/home/her/logs/own"),
        ({"ROS_HOME": "", "ROS_LOG_DIR": ""}, "/home/her/.ros/log"),
    ],
)
def test_launch_files_get_the_folder_of_all_logs(
    monkeypatch: pytest.MonkeyPatch, variables: dict[str, str], folder: str
) -> None:
    for name in ("ROS_HOME", "ROS_LOG_DIR"):
        monkeypatch.delenv(name, raising=False)
    for name, value in {"HOME": "/home/her", **variables}.items():
        monkeypatch.setenv(name, value)
    assert launch_logging._get_logging_directory() == folder
    launch_config._log_dir = f"{folder}/mine"
    assert launch_config.log_dir == launch_config.given_log_dir == f"{folder}/mine"
