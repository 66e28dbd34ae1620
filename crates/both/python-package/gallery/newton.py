"""Newton's method for z³ = 1: three basins with one boundary. Boxes alone show it to be fractal if its entropy is above ln 2; here they do not decide."""

from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from nonsmooth.labelling import UNDECIDED, basins_of, label_image

roots = np.exp(2j * np.pi * np.arange(3) / 3)


def label(x: Any, y: Any) -> Any:
    z = x + 1j * y
    for _ in range(40):
        z = z - (z**3 - 1) / (3 * z**2)
    near = np.abs(z[..., None] - roots) < 1e-6
    return np.where(near.any(-1), near.argmax(-1), UNDECIDED)


found = basins_of(label, {"x": (-2, 2), "y": (-2, 2)}, shape=(400, 400))
boxes = label_image(found.label).boxes(8)
figure, axes = plt.subplots(figsize=(4, 4), layout="constrained")
axes.imshow(found.label.T, origin="lower", extent=(-2, 2, -2, 2), cmap="Blues", vmin=-1, vmax=3)
axes.set(xlabel="Re z", ylabel="Im z", title=f"boundary entropy {boxes.boundary_entropy:.3f}; ln 2 = {np.log(2):.3f}")
figure.savefig("newton.png", dpi=160)
