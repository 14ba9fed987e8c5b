"""The protocol by which participants find each other, as far as it takes to ask them what they have.

A participant of rclpy is there after 0.1 s of CPU, has to be told of by all others, and cannot tell whether it knows
all of what they have. Here it is some sockets: whoever is asked says how many endpoints it has, so that the answer is
whole when all of them have come, and nobody waits for what may still come.

Source: DDSI-RTPS 2.5, chapters 8.3 to 8.5 and 9. Only what is on this machine, with Fast DDS, is asked so
(`listening`).
"""
