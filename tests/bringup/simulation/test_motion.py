"""The robots in the physics: they go where a differential drive goes, the same way each time."""

import math
from dataclasses import replace

import numpy as np
import pytest

from bringup.world.contacts import SAME_TOUCH, ContactCount
from bringup.world.drive import STILL, Twist
from bringup.world.geometry import Pose, relative, wrap
from bringup.world.layout import Layout, Start, lay_out
from bringup.world.model import load, pose, twist, wheel_angles, wheel_speeds
from bringup.world.simulation import TICK, Simulation, in_force


def empty(*starts: Pose) -> Layout:
    """Four walls and nothing else."""
    layout = lay_out("arena", 1, ["robot1"])
    robots = tuple(Start(f"robot{number}", start) for number, start in enumerate(starts, start=1))
    return replace(layout, obstacles=(), starts=robots)


def drive(simulation: Simulation, seconds: float, *commands: Twist) -> None:
    for _ in range(round(seconds * 100)):
        simulation.tick(commands)


def test_straight_ahead_is_straight_and_as_far_as_the_ramp_says() -> None:
    simulation = Simulation(load(empty(Pose(-3.0, 1.0, 0.3))))
    drive(simulation, 5.0, Twist(0.6, 0.0))
    drive(simulation, 1.0, STILL)
    way = relative(Pose(-3.0, 1.0, 0.3), pose(simulation.data, simulation.model.robots[0]))
    # It speeds up at 1.5 m/s^2 and brakes at 4.
    assert way.x == pytest.approx(0.6 * 5.0 - 0.6**2 / 2 * (1 / 1.5 - 1 / 4.0), abs=0.02)
    assert way.y == pytest.approx(0.0, abs=0.01)
    assert way.yaw == pytest.approx(0.0, abs=0.01)


@pytest.mark.parametrize("turn", [1.0, -1.0])
def test_a_turn_on_the_spot_stays_on_the_spot(turn: float) -> None:
    simulation = Simulation(load(empty(Pose(0.0, 0.0, 0.0))))
    drive(simulation, math.pi, Twist(0.0, turn))
    drive(simulation, 1.0, STILL)
    here = pose(simulation.data, simulation.model.robots[0])
    assert math.hypot(here.x, here.y) < 0.01
    assert (
        abs(wrap(here.yaw - math.copysign(round(math.pi, 2), turn))) < 0.06
    )  # the motors lag by one per cent


def test_an_arc_has_the_radius_of_its_command() -> None:
    simulation = Simulation(load(empty(Pose(0.0, -1.0, 0.0))))
    drive(simulation, 1.0, Twist(0.5, 0.5))
    robot = simulation.model.robots[0]
    for _ in range(8):
        drive(simulation, 0.5, Twist(0.5, 0.5))
        here = pose(simulation.data, robot)
        motion, sideways = twist(simulation.data, robot, here.yaw)
        assert motion.linear / motion.angular == pytest.approx(1.0, abs=0.03)
        assert sideways == pytest.approx(0.0, abs=0.02)


def test_wheels_roll_without_slip_on_a_straight_way() -> None:
    simulation = Simulation(load(empty(Pose(-2.0, 0.0, 0.0))))
    drive(simulation, 4.0, Twist(0.5, 0.0))
    robot = simulation.model.robots[0]
    left, right = wheel_angles(simulation.data, robot)
    way = pose(simulation.data, robot).x + 2.0
    # What is left is the creep of tyres that speed up.
    assert 0.1 * left == pytest.approx(way, rel=0.002)
    assert right == pytest.approx(left, rel=1e-3)


def test_a_robot_that_is_put_somewhere_rests_there() -> None:
    simulation = Simulation(load(empty(Pose(-3.0, 0.0, 0.7))))
    robot, level = simulation.model.robots[0], (0, 0, 0, 0.01, 0, 9.81)
    simulation.tick([STILL])
    assert simulation.data.sensordata[robot.imu] == pytest.approx(level, abs=0.02)
    drive(simulation, 1.0, Twist(0.5, 0.5))
    simulation.teleport(0, Pose(2.0, 1.0, -2.0))
    assert pose(simulation.data, robot) == pytest.approx((2.0, 1.0, -2.0), abs=1e-9)
    simulation.tick([STILL])
    assert simulation.data.sensordata[robot.imu] == pytest.approx(level, abs=0.02)


def test_an_even_way_does_not_shake_the_robot() -> None:
    simulation = Simulation(load(empty(Pose(-3.0, 0.0, 0.0))))
    drive(simulation, 2.0, Twist(0.8, 0.3))
    felt = []
    for _ in range(100):
        simulation.tick([Twist(0.8, 0.3)])
        felt.append(simulation.data.sensordata.copy())
    assert np.std(felt, axis=0).max() < 1e-3


def test_wheels_in_the_air_turn_as_their_motors_are_told() -> None:
    """Steps that were too long for the motors would swing them ever faster."""
    simulation = Simulation(load(empty(Pose(0.0, 0.0, 0.0))))
    simulation.data.qpos[2] = 5.0
    drive(simulation, 0.6, Twist(0.6, 0.0))
    for _ in range(20):
        simulation.tick([Twist(0.6, 0.0)])
        assert simulation.data.qpos[2] > 0.5
        assert wheel_speeds(simulation.data, simulation.model.robots[0]) == pytest.approx((6.0, 6.0), abs=0.1)


def test_a_hard_stop_keeps_the_laser_level() -> None:
    simulation = Simulation(load(empty(Pose(0.0, 0.0, 0.0))))
    drive(simulation, 2.0, Twist(0.8, 0.0))
    steepest = 0.0
    for _ in range(100):
        simulation.tick([STILL])
        _, x, y, _ = simulation.data.qpos[3:7]
        steepest = max(steepest, 2 * math.hypot(x, y))
    assert steepest < math.radians(0.1)


def wandering(ticks: int) -> tuple[bytes, bytes]:
    simulation = Simulation(load(lay_out("arena", 3, ["robot1", "robot2"])))
    chance = np.random.default_rng(5)
    for tick in range(ticks):
        if tick % 10 == 0:
            commands = [Twist(*chance.uniform((-0.3, -1.5), (0.8, 1.5))) for _ in range(2)]
        simulation.tick(commands)
    return simulation.data.qpos.tobytes(), simulation.data.qvel.tobytes()


def test_the_same_commands_give_the_same_bits() -> None:
    assert wandering(1500) == wandering(1500)


def test_a_wall_stops_the_robot_and_is_one_contact() -> None:
    simulation = Simulation(load(empty(Pose(4.0, 0.0, 0.0))))
    drive(simulation, 4.0, Twist(0.5, 0.0))
    assert pose(simulation.data, simulation.model.robots[0]).x == pytest.approx(4.75, abs=0.02)
    assert simulation.contacts[0].episodes == 1
    drive(simulation, 2.0, Twist(-0.5, 0.0))
    drive(simulation, 4.0, Twist(0.5, 0.0))
    assert simulation.contacts[0].episodes == 2


def test_robots_meet_and_both_have_a_contact() -> None:
    simulation = Simulation(load(empty(Pose(-1.0, 0.0, 0.0), Pose(1.0, 0.0, math.pi), Pose(0.0, 4.0, 0.0))))
    drive(simulation, 3.0, Twist(0.5, 0.0), Twist(0.5, 0.0), Twist(0.3, 0.0))
    near, far, _ = (pose(simulation.data, robot) for robot in simulation.model.robots)
    assert far.x - near.x == pytest.approx(0.5, abs=0.02)
    assert [count.episodes for count in simulation.contacts] == [1, 1, 0]


def test_a_touch_that_comes_back_at_once_is_the_same_touch() -> None:
    count = ContactCount()
    for time, touching in [
        (1.0, True),
        (1.1, False),
        (1.0 + SAME_TOUCH / 2, True),
        (1.2, True),
        (2.0, False),
    ]:
        count.update(time, touching=touching)
    assert count.episodes == 1
    count.update(3.0, touching=True)
    assert count.episodes == 2


def test_a_command_is_in_force_until_its_time_is_over() -> None:
    command = Twist(0.4, 0.1)
    assert in_force(command, 0.0, 0.2) == in_force(command, 19 * TICK, 0.2) == command
    assert in_force(command, 20 * TICK, 0.2) == STILL
    # Ages are sums of ticks, which need not be what they look like.
    assert in_force(command, 7 * TICK, 0.07) == STILL
