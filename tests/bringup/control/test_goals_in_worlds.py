"""Robots go to goals in the bringup's own worlds, with its wheels, lidar, IMU and filters, as fast as it goes."""

import math
import random
from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import pytest

from bringup.control.controller import State
from bringup.control.journey import Goal, Journey
from bringup.control.outcome import Outcome
from bringup.evaluation.crew import Member
from bringup.evaluation.lockstep import laid_out
from bringup.evaluation.scenario import Choice, scenario
from bringup.world.geometry import Pose, relative
from bringup.world.layout import WORLDS, Layout, room
from bringup.world.model import TICKS_PER_SECOND, load
from bringup.world.simulation import Simulation

# Room about the middle of a goal, and from one goal to another (m): a robot has a radius of 0.25.
ROOM, APART = 0.45, 1.0
LONGEST = 600.0


@dataclass
class Traveller:
    """A robot with the goals that it is sent to one after the other, and what came of them."""

    member: Member
    goals: Iterator[Goal]
    ends: list[tuple[Outcome, float, str]] = field(default_factory=list)
    on_the_way: bool = True

    @property
    def state(self) -> State:
        return self.member._state

    def go_on(self, now: float) -> None:
        """Note how a goal has ended, and set out to the next one."""
        journey = self.state.journey
        if journey is not None and journey.result is None:
            return
        if journey is not None and journey.result is not None and self.on_the_way:
            assert self.state.odometry is not None
            left = self.state.odometry.pose.distance(journey.goal.x, journey.goal.y)
            self.ends.append((journey.result.outcome, left, journey.result.text))
        goal = next(self.goals, None)
        self.on_the_way = goal is not None
        if goal is not None:
            self.member._state = replace(self.state, journey=Journey(goal, now))


def places(layout: Layout, chance: random.Random, count: int) -> list[Pose]:
    """Places with room for a robot, none so near to another one that a robot there would keep it from one."""
    found: list[Pose] = []
    while len(found) < count:
        x, y = (chance.uniform(-layout.half, layout.half) for _ in range(2))
        if room(layout, x, y) >= ROOM and all(math.hypot(x - each.x, y - each.y) >= APART for each in found):
            found.append(Pose(x, y, chance.uniform(-3.0, 3.0)))
    return found


def goals_from(start: Pose, among: list[Pose]) -> Iterator[Goal]:
    """The places as the robot's own odometry frame has them; every second one with a heading."""
    for number, place in enumerate(among):
        goal = relative(start, place)
        yield Goal(goal.x, goal.y, goal.yaw, yaw_tolerance=0.15 * (number % 2))


def travel(world: str, seed: int, robots: int, goals: int) -> tuple[list[Traveller], list[int]]:
    """What came of so many goals of each robot, and how often each robot touched anything."""
    names = tuple(f"robot{number + 1}" for number in range(robots))
    choice = Choice(LONGEST, filter={"use_sim_time": True}, control={"mode": "go_to_goal"})
    made = scenario(choice, world=world, seed=seed, robots=names)
    simulation = Simulation(load(laid_out(made)), [each.limits for each in made.world.each])
    chance = random.Random(f"{world} {seed}")  # noqa: S311 - places, no secrets
    found = places(laid_out(made), chance, robots * goals)
    crew = []
    for number in range(robots):
        member = Member(simulation, number, made)
        crew.append(Traveller(member, goals_from(member.robot.start, found[number::robots])))
    while any(each.on_the_way for each in crew):
        assert simulation.time < LONGEST, [each.ends for each in crew]
        simulation.tick([each.member.command() for each in crew])
        for each in crew:
            each.member.tick()
            if simulation.ticks % (TICKS_PER_SECOND // 10) == 0:
                each.go_on(simulation.time)
    return crew, [count.episodes for count in simulation.contacts]


def check(crew: list[Traveller], touches: list[int], goals: int) -> None:
    assert touches == [0] * len(crew)
    for each in crew:
        assert len(each.ends) == goals
        for outcome, left, text in each.ends:
            assert outcome in (Outcome.REACHED, Outcome.UNREACHABLE), text
            assert (outcome is Outcome.UNREACHABLE) or left <= 0.1


def test_a_goal_behind_walls_is_reached() -> None:
    crew, touches = travel("maze", seed=2, robots=1, goals=1)
    check(crew, touches, goals=1)
    assert [end[0] for end in crew[0].ends] == [Outcome.REACHED]


@pytest.mark.long
@pytest.mark.timeout(1800)
@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("world", WORLDS)
def test_every_goal_of_two_robots_is_reached_and_nothing_is_touched(world: str, seed: int) -> None:
    """The goals are all free; only a robot that stands in the way may keep the other one from some.

    In the corridor there is no other way, and no room to pass a robot that has come to rest in its middle.
    """
    crew, touches = travel(world, seed, robots=2, goals=4)
    check(crew, touches, goals=4)
    reached = [end[0] is Outcome.REACHED for each in crew for end in each.ends]
    assert sum(reached) >= (len(reached) // 2 if world == "corridor" else len(reached) - 1)
