"""Attractors by points and by features, their boundaries and stability, and what happens to them along a parameter."""

import pickle

import nonsmooth as ns
import numpy as np
import pytest

WELL = ns.System(["v", "x - x^3 - 0.3*v + force"], states="x v", parameters={"force": 0.0})
REGION = {"x": (-2.0, 2.0), "v": (-2.0, 2.0)}


def cubic(c=0.0):
    """x + 0.4 x (1 − x²) + c: attractors near ±1 for |c| < 0.8/√27."""
    return ns.map_steps(lambda t, x, p: [x[0] + 0.4 * x[0] * (1 - x[0] ** 2) + p.c], states="x", parameters={"c": c})


@pytest.fixture(scope="module")
def well():
    return ns.attractors_of(WELL, REGION, step=1.0, starts=[[1.0, 0.1], [-1.0, 0.1]], cells=50, locate=50, tests=20)


def test_three_ways_to_know_attractors_agree(well):
    known = ns.known_attractors(WELL, {1: [[1, 0]], 2: [[-1, 0]]}, step=1.0, tests=20)
    starts = np.random.default_rng(1).uniform(-1.5, 1.5, (200, 2))
    featured = ns.attractors_by_features(
        WELL, lambda points: points[:, 0].mean(), starts[:40], step=1.0, radius=0.2, beside=0.05, transient=60, stretch=10, tests=20
    )
    side = {label: points[0, 0] > 0 for label, points in featured.points.items()}
    assert np.array_equal(well.labels(starts), known.labels(starts))
    assert [side[label] for label in featured.labels(starts)] == (known.labels(starts) == 1).tolist()
    assert (well.kind, known.kind, featured.kind) == ("recurrences", "points", "features")
    assert 0 < known.distance <= 1


def test_features_tell_no_steps():
    found = ns.attractors_by_features(cubic(), lambda points: points.mean(), [[0.5]] * 4, radius=0.1, beside=0.01, transient=50, stretch=5, tests=5)
    with pytest.raises(ns.InputError, match="tell no steps"):
        found.convergences([[0.3]])
    with pytest.raises(ns.InputError, match="tell no steps"):
        ns.stability_of(found, [(-1, 1)], starts=10)


def test_an_exception_of_features_comes_out():
    def wrong(points):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        ns.attractors_by_features(cubic(), wrong, [[0.5]] * 4, radius=0.1, beside=0.01)
    with pytest.raises(TypeError, match="features returned something wrong"):
        ns.attractors_by_features(cubic(), lambda points: "x", [[0.5]] * 4, radius=0.1, beside=0.01)


def test_points_that_attract_nothing_are_refused():
    with pytest.raises(ns.InputError):
        ns.known_attractors(cubic(), {1: [[0.0]]}, tests=20)
    with pytest.raises(ns.InputError, match="points="):
        ns.known_attractors(cubic(), {})


def test_the_edge_state_of_a_double_well_is_its_saddle(well):
    track = ns.track_edge(well, [-1.0, 0.0], [1.0, 0.4])
    assert track.end == "settled"
    assert np.abs(track.boundary.middle).max() < 1e-7
    assert track.boundary.distance <= 1e-9
    assert {track.boundary.first_label, track.boundary.second_label} == {1, 2}


def test_the_smallest_fatal_shock_of_a_fixed_point_of_the_line():
    found = ns.attractors_of(cubic(), {"x": (-1.6, 1.6)}, starts=[[1.0], [-1.0]], tests=20)
    shock = ns.minimal_fatal_shock(found, [1.0], 2.0)
    # To the right the basin ends where the image is the fixed point 0: 1 + 0.4 (1 − x²) = 0.
    assert shock is not None and abs(shock.size - (3.5**0.5 - 1)) < 1e-8 and shock.label == 2 and shock.shock[0] > 0
    assert ns.minimal_fatal_shock(found, [1.0], 0.5) is None
    with pytest.raises(ns.InputError, match="two basins|basin"):
        ns.boundary_between(found, [0.5], [0.7])


def test_stability_is_the_same_with_any_number_of_threads(well):
    one, all = (ns.stability_of(well, REGION, starts=300, threads=threads) for threads in (1, None))
    assert repr(one) == repr(all)
    for own in one.values():
        assert 0.5 in own.fraction
        # The saddle is at the distance 1, and the boundary comes nearer.
        assert own.fatal is not None and own.fatal.size <= 1.0
        assert own.mean_time is not None and own.longest is not None and own.longest[0] >= own.mean_time.value


def test_tipping_has_the_probabilities_of_the_line():
    def at(c):
        return ns.attractors_of(cubic(c), {"x": (-1.7, 1.7)}, starts=[[-1.0], [1.0]], tests=20)

    # The fixed point between the basins: x(1 − x²) = −c/0.4, near −c/0.4.
    c = 0.1
    edge = min(np.roots([-0.4, 0, 0.4, c]).real, key=abs)
    rows = {(own.before, own.after): own.probability for own in ns.tipping(at(0.0), at(c), [(-1, 1)])}
    assert -edge in rows[1, 2] and rows[2, 1].value == 0
    assert rows[1, 2].value + rows[1, 1].value == pytest.approx(1)


def test_a_fold_is_bracketed_along_the_parameter_by_each_matching():
    fold = 0.8 / 27**0.5
    for match in ("flow", ("nearest", 0.5), ("overlap", 0.2)):
        along = ns.attractors_along(cubic, (0.0, 0.2), {"x": (-1.7, 1.7)}, steps=4, difference=0.1, shortest=1e-3, points=300, match=match)
        vanished = [own for own in along.changes if not own.appears]
        assert len(vanished) == 1 and vanished[0].start < fold < vanished[0].end
        assert vanished[0].end - vanished[0].start <= 2e-3
        value, lower, upper = along.fractions[vanished[0].label]
        assert (lower <= value).all() and (value <= upper).all()
        assert value[along.parameter > fold].max() == 0
        total = sum(own[0] for own in along.fractions.values())
        assert np.allclose(total, 1, atol=0.01)
    told = []
    ns.attractors_along(cubic, (0.0, 0.1), {"x": (-1.7, 1.7)}, steps=2, difference=0.9, points=20, progress=lambda *own: told.append(own))
    assert told[-1][0] == told[-1][1] == 3
    data = along.to_xarray("c")
    assert data.fraction.dims == ("c", "basin") and data.fraction.attrs["units"] == "1"


def test_the_function_of_the_parameter_may_be_wrong():
    def wrong(c):
        raise LookupError("no such parameter")

    with pytest.raises(LookupError, match="no such"):
        ns.attractors_along(wrong, (0.0, 0.2), {"x": (-1.7, 1.7)})
    with pytest.raises(TypeError, match="must return Steps"):
        ns.attractors_along(lambda c: c, (0.0, 0.2), {"x": (-1.7, 1.7)})
    with pytest.raises(ns.InputError, match="match="):
        ns.attractors_along(cubic, (0.0, 0.2), {"x": (-1.7, 1.7)}, match="nearest")
    with pytest.raises(ns.InputError, match="same components"):
        ns.attractors_along(cubic, (0.0, 0.2), {"x": (-1.7, 1.7)}, basins={"y": (0, 1)})


def test_ctrl_c_ends_a_search_along_a_parameter(ctrl_c):
    with ctrl_c():
        ns.attractors_along(lambda c: WELL.steps(1.0, parameters={"force": c}), (0.0, 0.3), REGION, points=10**6)


def test_attractors_of_formulas_go_through_pickle(well):
    starts = np.random.default_rng(2).uniform(-1.5, 1.5, (50, 2))
    again = pickle.loads(pickle.dumps(well))
    assert repr(again) == repr(well)
    assert all(np.array_equal(own, other) for own, other in zip(well.convergences(starts), again.convergences(starts)))
    known = ns.known_attractors(WELL, {1: [[1, 0]], 2: [[-1, 0]]}, step=1.0, tests=20)
    assert pickle.loads(pickle.dumps(known)).distance == known.distance
    with pytest.raises(TypeError, match="cannot pickle Attractors"):
        pickle.dumps(ns.labelling.Attractors(lambda x: x / 2, region=[(-1, 1)], starts=[[0.5]], tests=5))


def test_basins_by_a_cluster_have_the_same_bits(well):
    distributed = pytest.importorskip("distributed", reason="SKIPPED clusters: dask.distributed is not installed")
    pytest.importorskip("xarray")
    window = {"x": (-2, 2), "v": (-2, 2)}
    here = ns.basins_of(WELL, window, (24, 20), step=1.0, attractors=well)
    told = []
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            there = ns.basins_of(
                WELL, window, (24, 20), step=1.0, attractors=well, client=client, progress=lambda done, all: told.append((done, all))
            )
    assert there.identical(here)
    assert told[-1] == (24, 24) and len(told) > 8
    with pytest.raises(TypeError, match="Client"):
        ns.basins_of(WELL, window, (4, 4), step=1.0, attractors=well, client=3)
    with pytest.raises(ns.InputError, match="not those of a labelling"):
        ns.basins_of(lambda x, y: x > y, window, (4, 4), client=3)


def test_fractions_and_attractors_are_drawn(well):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    pytest.importorskip("xarray")
    along = ns.attractors_along(cubic, (0.0, 0.2), {"x": (-1.7, 1.7)}, steps=4, difference=0.3, points=50)
    axes = ns.plots.plot_fractions(along, name="c")
    assert axes.get_xlabel() == "c" and len(axes.lines) == 2 + len(along.changes)
    basins = ns.basins_of(WELL, {"x": (-2, 2), "v": (-2, 2)}, (8, 8), step=1.0, attractors=well)
    assert len(ns.plots.plot_basins(basins, attractors=well).lines) == 2
    # The window in the other order: dots stand at (v, x).
    turned = ns.basins_of(WELL, {"v": (-2, 2), "x": (-2, 2)}, (8, 8), step=1.0, attractors=well)
    for line in ns.plots.plot_basins(turned, attractors=well).lines:
        assert abs(line.get_xdata()[0]) < 0.01 and abs(abs(line.get_ydata()[0]) - 1) < 0.01


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: ns.attractors_along(cubic, (0.0, 0.2), {"x": (-1.7, 1.7)}, points=10**15), "memory|more than"),
        (lambda: ns.attractors_along(cubic, (0.0, 0.2), {"x": (-1.7, 1.7)}, starts=10**15), "memory|more than"),
        (lambda: ns.attractors_along(cubic, (0.0, 0.2), {"x": (-1.7, 1.7)}, starts=-1), "starts= is a whole number"),
        (lambda: ns.attractors_along(cubic, (0.0, 0.2), {"x": (-1.7, 1.7)}, threads=0), "threads="),
        (lambda: ns.attractors_along(cubic, (0.2, 0.0), {"x": (-1.7, 1.7)}), "not an interval"),
        (lambda: ns.stability_of(line(), {"x": (-1, 1), "y": (0, 1)}), "2 coordinates where 1"),
        (lambda: ns.stability_of(line(), [(-1, 1)], threads=-2), "threads="),
        (lambda: ns.tipping(line(), line(), [(-1, 1), (0, 1)]), "2 coordinates where 1"),
        (lambda: ns.minimal_fatal_shock(line(), [1.0, 2.0], 2.0), "2 coordinates where 1"),
        (lambda: ns.minimal_fatal_shock(line(), [1.0], 2.0, directions=-5), "directions= is a whole number"),
        (lambda: ns.minimal_fatal_shock(line(), [1.0], 2.0, along=1.5), "along= is a whole number"),
        (lambda: ns.boundary_between(line(), [1.0, 3.0], [-1.0, 3.0]), "2 coordinates where 1"),
        (lambda: ns.known_attractors(cubic(), {70000: [[1]]}), "up to 65000"),
        (lambda: line().labels([1.0, 2.0]), "one start a row"),
        (lambda: ns.basins_of(WELL, {"x": (-2, 2), "v": (-2, 2)}, (4, 4), step=1.0, starts=5, locate=50, tests=5, threads=0), "threads="),
    ],
)
def test_wrong_arguments_are_told_with_their_names_and_numbers(call, message):
    with pytest.raises((ns.InputError, TypeError, MemoryError), match=message):
        call()


def line():
    return ns.attractors_of(cubic(), {"x": (-1.6, 1.6)}, starts=[[1.0], [-1.0]], tests=20)
