"""A double well with a force: the basins with their attractors and the edge state between them, and their shares until one well is gone."""

import matplotlib.pyplot as plt
import nonsmooth as ns

well = ns.System(["v", "x - x^3 - 0.3*v + force"], states="x v", parameters={"force": 0.1})
region = {"x": (-2.0, 2.0), "v": (-2.0, 2.0)}
found = ns.attractors_of(well, region, step=1.0, starts=20, locate=50, tests=50)
basins = ns.basins_of(well, region, (200, 200), step=1.0, attractors=found)
edge = ns.track_edge(found, *(points[0] for points in found.points.values()))
along = ns.attractors_along(
    lambda force: well.steps(1.0, parameters={"force": force}), (0.0, 0.45), region, difference=0.05, shortest=1e-3, locate=50, tests=50
)
figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
ns.plots.plot_basins(basins, left, attractors=found)
left.plot(*edge.boundary.middle, "x", color="black")
ns.plots.plot_fractions(along, right, name="force")
figure.savefig("double_well.png", dpi=100)
