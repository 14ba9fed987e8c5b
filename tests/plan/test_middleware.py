"""Settings of the middleware and of logging are looked at before anything starts."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Problems
from orchestra.fields import replace
from orchestra.pipeline import check, collect
from orchestra.plan.checks import security
from orchestra.resolve.command_line import inputs_from

if TYPE_CHECKING:
    from orchestra.errors import Problem

_NODE = "launch:\n  - node: {pkg: demo, exec: talker, env: [{name: %s, value: '%s'}]}\n"


@pytest.fixture
def environment(tmp_path: Path) -> dict[str, str]:
    made = tmp_path / "install"
    for folder in ("share/ament_index/resource_index/packages", "lib/demo", "share/demo"):
        (made / folder).mkdir(parents=True)
    (made / "share/ament_index/resource_index/packages/demo").touch()
    (made / "lib/demo/talker").write_text("#!/bin/sh\n", "utf-8")
    (made / "lib/demo/talker").chmod(0o755)
    return {"PATH": os.environ["PATH"], "HOME": str(tmp_path), "AMENT_PREFIX_PATH": str(made)}


def _problems(
    tmp_path: Path, environment: dict[str, str], text: str, *, launching: bool = False
) -> tuple[Problem, ...]:
    path = tmp_path / "demo.launch.yaml"
    path.write_text(text)
    inputs = inputs_from([], environment=environment)
    if not launching:
        return check(str(path), replace(inputs, launching=False))
    problems = Problems()
    collect(str(path), replace(inputs, launching=True), problems)
    return problems.ordered


@pytest.mark.parametrize(
    ("name", "value", "severity", "told", "meant"),
    [
        ("ROS_DOMAIN_ID", "233", "error", "between 0 and 232, not 233", None),
        ("ROS_DOMAIN_ID", "x", "error", "'x' is not a number", None),
        ("ROS_DOMAIN_ID", "-1", "error", "between 0 and 232", None),
        ("ROS_DOMAIN_ID", "5abc", "warning", "'5abc' is read as 5", None),
        ("ROS_DOMAIN_ID", "010", "warning", "'010' is read as 8", None),
        ("ROS_DOMAIN_ID", "0x11", "warning", "'0x11' is read as 17", None),
        ("ROS_AUTOMATIC_DISCOVERY_RANGE", "localhost", "warning", "is passed over", "LOCALHOST"),
        ("ROS_AUTOMATIC_DISCOVERY_RANGE", "everywhere", "warning", "it is one of SUBNET, LOCALHOST", None),
        ("ROS_STATIC_PEERS", "10.0.0.1,10.0.0.2", "error", "between semicolons", None),
        ("ROS_DISCOVERY_SERVER", "127.0.0.1:99999", "error", "a port is between 1 and 65535", None),
        ("ROS_DISCOVERY_SERVER", "127.0.0.1:one", "error", "a port is between 1 and 65535", None),
        ("RMW_FASTRTPS_PUBLICATION_MODE", "ASYNC", "warning", "is passed over", None),
        ("RCUTILS_COLORIZED_OUTPUT", "yes", "warning", "it is 0 or 1", None),
        (
            "RCUTILS_CONSOLE_OUTPUT_FORMAT",
            "{mesage}",
            "warning",
            "'{mesage}' stands for nothing",
            "{message}",
        ),
        ("ROS_SECURITY_ENABLE", "True", "warning", "'True' turns security off", None),
    ],
)
def test_a_setting_that_does_not_work_is_told(
    tmp_path: Path,
    environment: dict[str, str],
    name: str,
    value: str,
    severity: str,
    told: str,
    meant: str | None,
) -> None:
    (problem,) = _problems(tmp_path, environment, _NODE % (name, value))
    assert (problem.severity, problem.suggestion) == (severity, meant)
    assert told in problem.message
    assert problem.span is not None
    assert problem.span.line == 2


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("ROS_DOMAIN_ID", "0"),
        ("ROS_DOMAIN_ID", "232"),
        ("ROS_AUTOMATIC_DISCOVERY_RANGE", "SYSTEM_DEFAULT"),
        ("ROS_STATIC_PEERS", "10.0.0.1;robot.local"),
        ("ROS_DISCOVERY_SERVER", ";127.0.0.1:11811;[fe80::1]:11812;TCPv4:[127.0.0.1]:42100;host"),
        ("RMW_FASTRTPS_PUBLICATION_MODE", "ASYNCHRONOUS"),
        ("RCUTILS_LOGGING_USE_STDOUT", "1"),
        (
            "RCUTILS_CONSOLE_OUTPUT_FORMAT",
            "[{severity}] [{time}] [{name}]: {message} ({file_name}:{line_number})",
        ),
        ("ROS_SECURITY_ENABLE", "false"),
        ("RMW_IMPLEMENTATION", "rmw_fastrtps_cpp"),
        ("RMW_IMPLEMENTATION", "rmw_cyclonedds_cpp"),
        ("FASTDDS_DEFAULT_PROFILES_FILE", "/opt/not_here/fastdds.xml"),
        ("CYCLONEDDS_URI", "<CycloneDDS><Domain/></CycloneDDS>"),
    ],
)
def test_what_works_here_or_may_work_elsewhere_is_left_alone(
    tmp_path: Path, environment: dict[str, str], name: str, value: str
) -> None:
    assert _problems(tmp_path, environment, _NODE % (name, value)) == ()


@pytest.mark.parametrize(
    ("name", "value", "told"),
    [
        (
            "RMW_IMPLEMENTATION",
            "rmw_cyclonedds_cpp",
            "'rmw_cyclonedds_cpp' is not installed: there is rmw_fastrtps",
        ),
        (
            "FASTDDS_DEFAULT_PROFILES_FILE",
            "/opt/not_here/fastdds.xml",
            "there is no file /opt/not_here/fastdds.xml",
        ),
        ("CYCLONEDDS_URI", "file:///opt/not_here/cyclone.xml", "there is no file /opt/not_here/cyclone.xml"),
    ],
)
def test_what_is_not_here_keeps_a_launch_from_starting(
    tmp_path: Path, environment: dict[str, str], name: str, value: str, told: str
) -> None:
    (problem,) = _problems(tmp_path, environment, _NODE % (name, value), launching=True)
    assert problem.severity == "error"
    assert told in problem.message
    by_caller = _problems(
        tmp_path,
        {**environment, name: value},
        "launch:\n  - node: {pkg: demo, exec: talker}\n",
        launching=True,
    )
    assert [(found.code, found.span) for found in by_caller] == [(problem.code, None)]


def test_one_setting_of_a_group_is_one_problem(tmp_path: Path, environment: dict[str, str]) -> None:
    text = (
        "launch:\n  - group:\n      - set_env: {name: ROS_DOMAIN_ID, value: '300'}\n"
        "      - node: {pkg: demo, exec: talker, name: a}\n      - node: {pkg: demo, exec: talker, name: b}\n"
    )
    (problem,) = _problems(tmp_path, environment, text)
    assert problem.span is not None
    assert problem.span.line == 3


def test_what_a_description_sets_instead_of_the_caller_counts(
    tmp_path: Path, environment: dict[str, str]
) -> None:
    text = _NODE % ("RMW_IMPLEMENTATION", "rmw_fastrtps_cpp")
    caller = {**environment, "RMW_IMPLEMENTATION": "rmw_cyclonedds_cpp"}
    assert _problems(tmp_path, caller, text, launching=True) == ()


def test_a_broken_file_is_told_at_its_place(tmp_path: Path, environment: dict[str, str]) -> None:
    (tmp_path / "fastdds.xml").write_text("<dds>\n  <profiles>\n</dds>\n")
    text = _NODE % ("FASTRTPS_DEFAULT_PROFILES_FILE", tmp_path / "fastdds.xml")
    (problem,) = _problems(tmp_path, environment, text)
    assert problem.span is not None
    assert (Path(problem.span.file).name, problem.span.line, problem.span.column) == ("fastdds.xml", 3, 3)
    assert "mismatched tag" in problem.message


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ("--log-level debgu", "'debgu' is no level of logging"),
        (
            "--log-level rcl:=loud",
            "'loud' is no level of logging: it is one of debug, info, warn, error, fatal",
        ),
        ("--enclave robot", "the name of an enclave begins with '/': 'robot'"),
        ("--log-level WARN --log-level rcl:=fatal --enclave /robot", None),
    ],
)
def test_words_that_rcl_refuses_are_told(
    tmp_path: Path, environment: dict[str, str], words: str, told: str | None
) -> None:
    text = f"launch:\n  - node: {{pkg: demo, exec: talker, ros_args: '{words}'}}\n"
    assert [problem.message for problem in _problems(tmp_path, environment, text)] == ([told] if told else [])


_SECURE = "launch:\n  - node: {pkg: demo, exec: talker, ros_args: '--enclave /robot'}\n"


def test_security_without_a_middleware_that_has_it_is_refused(
    tmp_path: Path, environment: dict[str, str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(security, "_has_security", lambda _: False)
    (problem,) = _problems(tmp_path, {**environment, "ROS_SECURITY_ENABLE": "true"}, _SECURE)
    assert problem.severity == "error"
    assert "is built without" in problem.message


def test_keystore_and_enclave_are_looked_for(
    tmp_path: Path, environment: dict[str, str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(security, "_has_security", lambda _: True)
    asked = {**environment, "ROS_SECURITY_ENABLE": "true"}

    def told() -> list[str]:
        return [problem.message for problem in _problems(tmp_path, asked, _SECURE)]

    assert told() == ["security is asked for, but ROS_SECURITY_KEYSTORE is not set"]
    asked["ROS_SECURITY_KEYSTORE"] = str(tmp_path / "keys")
    assert told() == [f"security is asked for, but there is no keystore {tmp_path / 'keys'}"]
    enclave = tmp_path / "keys" / "enclaves" / "robot"
    enclave.mkdir(parents=True)
    names = ("identity_ca.cert.pem", "cert.pem", "key.pem", "permissions_ca.cert.pem", "governance.p7s")
    for name in names:
        (enclave / name).touch()
    assert told() == [f"the enclave /robot has no permissions.p7s in {enclave}"]
    (enclave / "permissions.p7s").touch()
    assert told() == []
    asked["ROS_SECURITY_STRATEGY"] = "enforce"
    assert "'enforce' means Permissive" in told()[0]


def test_a_library_tells_by_its_content_whether_it_has_security(tmp_path: Path) -> None:
    for name, content, expected in (("with.so", b"x\0SecurityManager\0", True), ("without.so", b"x", False)):
        (tmp_path / name).write_bytes(content)
        assert security._has_security(tmp_path / name) is expected
