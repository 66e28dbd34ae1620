"""The map of the hopper, and an orbit as a cobweb."""

import matplotlib.pyplot as plt
import passive_hopper as hopper

hopper.cobweb(0.2, 7.0)
plt.savefig("cobweb.png", dpi=160)
