"""The topic that tells what the robots touch, whenever that changes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from geometry_msgs.msg import Point

from bringup.world import messages
from bringup.world.interfaces import Contact, Contacts
from bringup.world.physics import mujoco
from bringup.world.topics import LATCHED

if TYPE_CHECKING:
    from rclpy.node import Node

    from bringup.world.contacts import Touch
    from bringup.world.simulation import Simulation


class Collisions:
    """What touches what: `contacts` in the namespace of the node."""

    def __init__(self, node: Node, simulation: Simulation) -> None:
        self._simulation = simulation
        self._publisher = node.create_publisher(Contacts, "contacts", LATCHED)
        self._told: tuple[Touch, ...] | None = None

    @property
    def changed(self) -> bool:
        """Whether something else touches now than what was told last."""
        return self._simulation.touching() != self._told

    def publish(self) -> None:
        """Tell what touches now, if it is not what was told last."""
        touches = self._simulation.touching()
        if touches == self._told:
            return
        self._told = touches
        message = Contacts(contacts=[self._contact(touch) for touch in touches])
        messages.stamp(message.header.stamp, self._simulation.ticks)
        self._publisher.publish(message)

    def _contact(self, touch: Touch) -> Contact:
        model, data = self._simulation.model, self._simulation.data
        names = [model.physics.geom(geom).name for geom in touch.geoms]
        owners = [model.owners[geom] for geom in touch.geoms]
        robot, other = (0, 1) if owners[0] >= 0 else (1, 0)
        contact = Contact(robot=model.robots[owners[robot]].name)
        contact.other = model.robots[owners[other]].name if owners[other] >= 0 else names[other]
        for number in range(data.ncon):
            if tuple(data.contact[number].geom) == touch.geoms:
                x, y, z = data.contact[number].pos.tolist()
                contact.position = Point(x=x, y=y, z=z)
                force = np.zeros(6)
                mujoco.mj_contactForce(model.physics, data, number, force)
                contact.force += float(np.linalg.norm(force[:3]))
        return contact
