"""Runs the recorder's node until it is told to end."""

from __future__ import annotations

import signal
from threading import Event, Thread

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.signals import SignalHandlerOptions

from bringup.evaluation.listening import Recorder

ENDING = (signal.SIGINT, signal.SIGTERM)


def run() -> int:
    """Run until SIGINT or SIGTERM, both of which the caller must have blocked; 1 if the file cannot be written."""
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    node = rclpy.create_node("recorder")
    try:
        recorder = Recorder(node)
        _spin(node)
        recorder.close()
    except OSError as error:
        node.get_logger().fatal(f"the recording cannot be written: {error}")
        return 1
    finally:
        node.destroy_node()
        rclpy.shutdown()
    return 0


def _spin(node: rclpy.node.Node) -> None:
    told_to_end = Event()
    # Its callback does nothing: it makes the executor come back.
    wake_up = node.create_guard_condition(lambda: None)

    def wait_for_the_end() -> None:
        signal.sigwait(ENDING)
        told_to_end.set()
        wake_up.trigger()

    ending = Thread(target=wait_for_the_end, daemon=True)
    ending.start()
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    try:
        while not told_to_end.is_set():
            executor.spin_once()
        # The guard condition is the thread's until it has ended; a fault of the file ends the node without waiting.
        ending.join()
    finally:
        executor.remove_node(node)
        executor.shutdown()
