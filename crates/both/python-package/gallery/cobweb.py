"""The map of the hopper, and an orbit as a cobweb."""

import passive_hopper as hopper

axes = hopper.cobweb(0.2, 7.0)
axes.figure.savefig("cobweb.png", dpi=80)
