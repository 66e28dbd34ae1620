"""The hopper in motion, with the curves of both masses: this start hops for ever."""

import passive_hopper as hopper

motion = hopper.motion(4.55, M=0.2, hops=2)
hopper.animate(motion, "animated_hopper.gif")
