"""Variables of launch files that are set and never read: only those with actions are worth a syntax tree."""

from __future__ import annotations

import pytest

from orchestra.compat.idle_names import has_idle_actions, may_have_idle_actions
from tests.compat.modules import loaded

IDLE = {
    "an action": "def make():\n    node = Node()\n",
    "one of a module": "def make():\n    node = actions.Node()\n",
    "one on more lines": "def make():\n    node = (  # this\n        actions\n        .Node(1,\n 2))\n",
    "one beside what is read": "def make():\n    given = 1\n    node = Node(); other = given\n    return other\n",
    "one in a function inside": "def make():\n    text = str()\n    def inner():\n        node = Node()\n",
    "one in a method": "def make():\n    text = str()\nclass Other:\n    def inner(self):\n        node = Node()\n",
}
READ = {
    "nothing": "def make(node):\n    return Node()\n",
    "a substitution": "def make():\n    rate = LaunchConfiguration('rate')\n    node = Node()\n    return node\n",
    "what is not meant to be read": "def make():\n    _node = Node()\n",
    "what functions inside read": "def make():\n    node = Node()\n    def inner():\n        return node\n",
    "an error": "def make():\n    try:\n        Node()\n    except TypeError as error:\n        pass\n",
    "a node that is returned beside one": "def make():\n    rate = LaunchConfiguration('Nodes')\n    return Node()\n",
}


@pytest.mark.parametrize("name", [*IDLE, *READ])
def test_only_actions_that_nobody_reads_are_looked_for(name: str) -> None:
    module, source = loaded({**IDLE, **READ}[name])
    assert has_idle_actions(module, source) == (name in IDLE)
    code = compile(source, "file.launch.py", "exec")
    assert may_have_idle_actions(code, source) == (name in IDLE)
