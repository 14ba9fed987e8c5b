"""Publishers and subscriptions without event handlers of their own.

By default rclpy waits for two events more per publisher and subscription, to warn of a peer that does not fit. The
peer warns of the same thing, and each of them costs at every wake-up: all together a third of the waiting.
"""

from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks

PUBLISHER = PublisherEventCallbacks(use_default_callbacks=False)
SUBSCRIPTION = SubscriptionEventCallbacks(use_default_callbacks=False)
