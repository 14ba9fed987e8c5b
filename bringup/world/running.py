"""The simulation on the ROS graph, in step with real time.

It runs its own loop instead of an executor's: ticks have deadlines, and messages are taken when a tick begins.
Parameters and services are served by an executor in a thread of its own (`bringup.world.orders` says why).
"""

from __future__ import annotations

import gc
import threading
import time
from contextlib import closing, contextmanager
from typing import TYPE_CHECKING, Protocol

from rclpy.executors import SingleThreadedExecutor
from rclpy.logging import get_logger
from rclpy.node import Node
from rclpy.task import Future

from bringup.beginning import REFUSED_VALUES, begun
from bringup.ending import leave
from bringup.world import pace
from bringup.world.course import Course
from bringup.world.layout import LayoutError
from bringup.world.orders import Orders
from bringup.world.parameters import Parameters
from bringup.world.recording import RecordingError
from bringup.world.rendering import NoRenderingError
from bringup.world.script import ScriptError
from bringup.world.services import Services
from bringup.world.settings import SettingsError
from bringup.world.sights import Sights
from bringup.world.telling import Telling
from bringup.world.window import NoWindowError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bringup.world.stop import Stop

REFUSALS = (
    *REFUSED_VALUES,
    LayoutError,
    NoRenderingError,
    NoWindowError,
    RecordingError,
    ScriptError,
    SettingsError,
)
# Real seconds: the longest sleep, so that orders and signals are heeded soon, between two pictures in the window, and
# between two messages of the clock while it stands still.
PATIENCE = 0.04
SHOW_PERIOD = 0.04
CLOCK_PERIOD = 0.2
# While a command is waited for in lockstep, or a filter.
LOCKSTEP_PATIENCE = 0.001
# For one that says nothing.
LONGEST_WAIT = 3.0


class Ending(Protocol):
    """The wish to end."""

    requested: bool


class Run:
    """One run of the simulation, from its node to its end."""

    def __init__(self, node: Node, stop: Ending) -> None:
        self._stop = stop
        self._orders = Orders()
        parameters = Parameters(node)
        self.course = Course(node, parameters.settings)
        self._sights = Sights(node, self.course)
        self._telling = Telling(node, self.course)
        parameters.follow(lambda settings: self._orders.leave(lambda: self.course.apply(settings)))
        self._services = Services(node, self.course, self._orders)
        self._next_show = self._next_clock = 0.0
        self._last_heard: list[float | None] = []
        self._waiting_since = 0.0

    @property
    def over(self) -> bool:
        """Whether the run has come to its end."""
        return self._stop.requested or self.course.finished or self._sights.closed

    def go(self) -> None:
        """Keep the world in step with real time until the run is over."""
        course, now = self.course, time.monotonic()
        began = now
        metronome = pace.Metronome(now, course.settings.speed)
        while not self.over:
            self._orders.carry_out()
            rest = self._turn(metronome, now)
            if rest > 0.0:
                time.sleep(rest)
            now = time.monotonic()
            self._telling.update(now, metronome)
        self._telling.end(now - began)
        self._sights.end()

    def close(self) -> None:
        """Let nobody wait for an answer any more, and close what is open."""
        self._orders.close()
        self._sights.close()

    def _turn(self, metronome: pace.Metronome, now: float) -> float:
        """One tick, if one is due; real seconds to sleep then."""
        course = self.course
        reached, speed = course.simulation.time, course.settings.speed
        if now >= self._next_show:
            self._next_show = now + SHOW_PERIOD
            self._sights.show()
        if not course.moving:
            self._stand(metronome, now)
            return PATIENCE
        due = 0.0 if course.stepping else metronome.wait(now, reached, speed)
        if due > 0.0:
            return min(due, PATIENCE)
        if self._must_wait(now) or not course.tick(self._in_a_row()):
            self._stand(metronome, now)
            return LOCKSTEP_PATIENCE
        self._sights.tick()
        metronome.ticked(now)
        return 0.0

    def _in_a_row(self) -> int:
        """How many ticks may follow one another before they are published."""
        alone = self.course.unthrottled and not self._sights.watching
        return self.course.settings.unthrottled_ticks if alone else 1

    def _must_wait(self, now: float) -> bool:
        """Whether a filter is so far behind that it would lose what the world says; one that is silent is given up."""
        lagging = self.course.lagging()
        heard = [robot.estimated for robot in lagging]
        if heard != self._last_heard:
            self._last_heard, self._waiting_since = heard, now
        if now - self._waiting_since < LONGEST_WAIT:
            return bool(lagging)
        for robot in lagging:
            self._telling.given_up(robot.robot.name, LONGEST_WAIT)
            robot.give_up()
        return False

    def _stand(self, metronome: pace.Metronome, now: float) -> None:
        """Let time stand still, and say so now and then to those who have come meanwhile."""
        metronome.hold(now, self.course.simulation.time)
        if now >= self._next_clock:
            self._next_clock = now + CLOCK_PERIOD
            self.course.tell_time()


@contextmanager
def served(node: Node) -> Iterator[None]:
    """Serve the parameters and services of a node in a thread of their own, until the end."""
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    over: Future[None] = Future()
    thread = threading.Thread(target=executor.spin_until_future_complete, args=(over,), name="services")
    thread.start()
    try:
        yield
    finally:
        # An executor that is shut down while it waits fails now and then: what it waits on is destroyed.
        over.set_result(None)
        thread.join()
        executor.shutdown()


def serve(args: list[str] | None, stop: Stop) -> int:
    """Make the node and run it; 0 after a whole or a stopped run, 1 and a line of log if it cannot be as asked."""
    return begun("simulation", lambda: _serve(stop), args)


def _serve(stop: Stop) -> int:
    try:
        node = Node(
            "simulation",
            allow_undeclared_parameters=True,
            automatically_declare_parameters_from_overrides=True,
        )
    except ValueError as error:
        text = f"a parameter has no type, such as an empty list; leave it out ({error})"
        get_logger("simulation").fatal(text)
        return 1
    try:
        run = Run(node, stop)
        # What stands now stands to the end: going through it for garbage took a twentieth of the time.
        gc.collect()
        gc.freeze()
        with served(node), closing(run):
            run.go()
    except REFUSALS as error:
        node.get_logger().fatal(str(error))
        return 1
    finally:
        gc.unfreeze()
        # Without this the other participants would see the node for 20 s more.
        leave(node)
    return 0
