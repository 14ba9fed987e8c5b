"""A lifecycle node: lifecycle_node.py NAME [WORD ...]

fail=TRANSITION     this transition (configure, activate, ...) fails
error=TRANSITION    ... raises, so that the node goes through error processing
die=TRANSITION      ... ends the process with 7
hang=TRANSITION     ... never comes to an end
unheard=TRANSITION  the first request for it is lost
unanswered=TRANSITION  the first answer to it is lost
silent              no lifecycle node at all, only a process that runs
"""

import os
import signal
import sys

import rclpy
from lifecycle_msgs.msg import State as StateMessage
from lifecycle_msgs.srv import ChangeState
from rclpy.lifecycle import LifecycleNode, State, TransitionCallbackReturn
from rclpy.signals import SignalHandlerOptions

GOOD, BAD = TransitionCallbackReturn.SUCCESS, TransitionCallbackReturn.FAILURE


def write(line: str) -> None:
    os.write(1, f"{line}\n".encode())


class Node(LifecycleNode):
    def __init__(self, name: str, manners: dict[str, str]) -> None:
        self.manners = manners
        super().__init__(name)

        (service,) = (one for one in self.services if one.srv_name.endswith("/change_state"))
        self.heard, self.answer = service.callback, service.send_response
        service.callback, service.send_response = self.hear, self.reply
        self.lost: set[str] = set()
        self.silent = False

    def hear(self, request: ChangeState.Request, response: ChangeState.Response) -> ChangeState.Response:
        label = {1: "configure", 2: "cleanup", 3: "activate", 4: "deactivate"}[request.transition.id]
        manner = self.manners.get(label)
        self.silent = manner in ("unheard", "unanswered") and label not in self.lost
        self.lost.add(label)
        return response if self.silent and manner == "unheard" else self.heard(request, response)

    def reply(self, response: ChangeState.Response, header: object) -> None:
        if not self.silent:
            self.answer(response, header)

    def pass_through(self, transition: str) -> TransitionCallbackReturn:
        write(transition)
        match self.manners.get(transition):
            case "fail":
                return BAD
            case "error":
                raise RuntimeError(f"no way to {transition}")
            case "die":
                os._exit(7)
            case "hang":
                signal.pause()
        return GOOD

    def on_configure(self, state: State) -> TransitionCallbackReturn:
        assert state.state_id == StateMessage.PRIMARY_STATE_UNCONFIGURED
        return self.pass_through("configure")

    def on_activate(self, state: State) -> TransitionCallbackReturn:
        super().on_activate(state)
        return self.pass_through("activate")

    def on_deactivate(self, state: State) -> TransitionCallbackReturn:
        super().on_deactivate(state)
        return self.pass_through("deactivate")

    def on_cleanup(self, _state: State) -> TransitionCallbackReturn:
        return self.pass_through("cleanup")


def main() -> None:
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    name, *words = sys.argv[1:]
    if words == ["silent"]:
        write("up")
        signal.pause()
    rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
    node = Node(
        name, {transition: manner for manner, _, transition in (word.partition("=") for word in words)}
    )
    write("up")
    rclpy.spin(node)


main()
