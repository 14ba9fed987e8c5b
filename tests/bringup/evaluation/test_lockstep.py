"""Runs in lockstep: the same every time, and sensitive to what is wrong with the robots."""

import numpy as np
import pytest

from bringup.evaluation.errors import against_truth, position_rms
from bringup.evaluation.lockstep import run
from bringup.evaluation.scenario import PARAMETERS, Choice, given, scenario
from bringup.evaluation.track import Track
from bringup.world.settings import SettingsError


def tracks(
    seconds: float = 4.0, *, parameters: dict[str, object] | None = None, **simulation: object
) -> list[Track]:
    chosen = scenario(Choice(seconds, simulation=simulation, filter=parameters or {}))
    return run(chosen, innovations=True)


@pytest.fixture(scope="module")
def usual() -> list[Track]:
    return tracks()


def test_the_same_scenario_gives_the_same_numbers_to_the_last_bit(usual: list[Track]) -> None:
    for one, other in zip(usual, tracks(), strict=True):
        for name in ("times", "truth", "wheels", "filtered", "covariance"):
            assert getattr(one, name).tobytes() == getattr(other, name).tobytes(), name


def test_robots_drive_and_their_wheels_err_more_than_their_filters(usual: list[Track]) -> None:
    assert [track.robot for track in usual] == ["robot1", "robot2"]
    for track in usual:
        assert track.times[-1] == pytest.approx(4.0)
        assert np.ptp(track.truth[:, 0]) > 0.5
        assert np.linalg.eigvalsh(track.covariance).min() > 0.0
        filtered, wheels = (
            against_truth(track.filtered, track.truth),
            against_truth(track.wheels, track.truth),
        )
        assert 0.0 < position_rms(filtered) < 0.1
        # Within seconds it shows in the heading first, which one wheel's wrong radius turns.
        assert abs(filtered[-1, 2]) < 0.5 * abs(wheels[-1, 2])
        assert set(track.nis) == {"imu0_twist", "odom0_twist"}


def test_another_seed_another_world_and_other_errors_are_other_runs(usual: list[Track]) -> None:
    for change in ({"seed": 2}, {"world": "maze"}, {"gyro_bias": 0.05}):
        other = tracks(1.0, **change)
        assert not np.allclose(other[0].filtered, usual[0].filtered[: len(other[0].filtered)], atol=1e-3), (
            change
        )


def test_any_number_of_robots_can_be_run() -> None:
    three = tracks(1.0, robots=["a", "b", "c"])
    assert [track.robot for track in three] == ["a", "b", "c"]


def test_parameters_that_nobody_takes_are_refused() -> None:
    with pytest.raises(ValueError, match="unknown"):
        tracks(1.0, parameters={"frequenzy": 50.0})
    with pytest.raises(SettingsError):
        tracks(1.0, robots=[])
    with pytest.raises(ValueError, match="wheel_slap is unknown; did you mean wheel_slip"):
        tracks(1.0, wheel_slap=0.1)
    with pytest.raises(SettingsError, match="gyro_noise"):
        tracks(1.0, gyro_noise=-1.0)
    with pytest.raises(ValueError, match="obstacle_distanse is unknown; did you mean obstacle_distance"):
        scenario(Choice(1.0, control={"obstacle_distanse": 1.0}))
    with pytest.raises(ValueError, match="velocity_controller: obstacle_distance"):
        scenario(Choice(1.0, control={"obstacle_distance": 0.2}))


def test_the_parameters_are_those_of_the_bringup() -> None:
    assert given(PARAMETERS, "ekf")["odom0"] == "wheel/odometry"
    assert scenario(Choice(1.0)).control.mode == "wander"
