"""The hopper in motion, with the curves of both masses."""

import passive_hopper as hopper

motion = hopper.motion(7.0, M=0.2, hops=1)
hopper.animate(motion, "animated_hopper.gif")
