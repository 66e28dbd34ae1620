"""Basins of any labelling, and attractors of any map."""

import numpy as np
import pytest
from nonsmooth import labelling
from nonsmooth.labelling import Attractors, basins_of, label_image, region_fractions, uncertainty_exponent

UNIT = [(0, 1), (0, 1)]


def checkerboard(side=64, cell=8):
    x, y = np.indices((side, side)) // cell
    return (x + y) % 2


def test_the_codes_are_those_of_the_library():
    assert (labelling.UNDECIDED, labelling.UNDECIDED_PRECISION, labelling.UNDECIDED_MAP, labelling.OUTSIDE) == (
        65535,
        65533,
        65532,
        65530,
    )
    assert labelling.ESCAPED == 65529


def test_boxes_of_a_checkerboard():
    image = label_image(checkerboard())
    assert image.boxes(8).mixed == 0 and image.boxes(8).boundary_entropy is None
    boxes = image.boxes(16)
    assert (boxes.boxes, boxes.mixed) == (16, 16)
    assert boxes.basin_entropy == pytest.approx(np.log(2)) == boxes.boundary_entropy
    assert image.counts() == {0: 2048, 1: 2048}


def test_images_of_any_layout_are_the_same():
    labels = np.zeros((30, 20), dtype=int)
    labels[:10] = 3
    for array in (labels, labels.astype("uint16"), np.asfortranarray(labels), labels.astype(">i4"), labels[::-1][::-1]):
        image = label_image(array)
        assert image.counts() == {0: 400, 3: 200}
        assert image.fractions()[3].value == pytest.approx(1 / 3) and 1 / 3 in image.fractions()[3]
        # The axes are (x, y): the boundary is a line x = 10.
        assert image.boxes(10).mixed == 0
    assert label_image(labels.T).boxes(10).mixed == 0
    assert label_image(labels > 0).counts() == {0: 400, 1: 200}
    bounds = label_image(labels).fraction_bounds()
    assert bounds[3].lower <= 1 / 3 <= bounds[3].upper


def test_undecided_pixels_widen_intervals_and_outside_ones_do_not_count():
    labels = np.zeros((100, 100), dtype=np.uint16)
    labels[:50] = 1
    plain = label_image(labels).fractions()
    labels[:, :10] = labelling.UNDECIDED
    assert label_image(labels).fractions()[1].upper > plain[1].upper
    labels[:, :10] = labelling.OUTSIDE
    assert label_image(labels).fractions()[1].value == 0.5


def test_fractions_of_a_ball_cover_its_volume():
    found = region_fractions(lambda x, y, z: x * x + y * y + z * z < 1, [(-1, 1)] * 3, count=20_000, seed=1)
    assert np.pi / 6 in found[1] and found[1].upper - found[1].lower < 0.03
    again = region_fractions(lambda x, y, z: x * x + y * y + z * z < 1, [(-1, 1)] * 3, count=20_000, seed=1)
    assert found == again


def test_windows_are_lists_or_arrays_as_well():
    pytest.importorskip("xarray")
    label = lambda x, y: x > y  # noqa: E731
    for window in (UNIT, [list(side) for side in UNIT], np.array(UNIT)):
        assert region_fractions(label, window, count=1000, seed=1) == region_fractions(label, UNIT, count=1000, seed=1)
        assert basins_of(label, {"x": window[0], "y": window[1]}, shape=[4, 4]).label.sum() == 6


def test_a_smooth_boundary_has_the_exponent_one():
    found = uncertainty_exponent(lambda x, y: x**2 + y**2 < 0.5, UNIT, [0.1, 0.03, 0.01, 0.003], count=50_000)
    assert 1 in found.exponent and found.follows_a_power_law
    assert [epsilon for epsilon, _ in found.fractions] == [0.003, 0.01, 0.03, 0.1]


def test_basins_of_a_labelling_are_a_dataset():
    pytest.importorskip("xarray")
    calls = []
    found = basins_of(
        lambda x, y: x > y, {"a": (0, 1), "b": (0, 2)}, shape=(6, 4), progress=lambda *done: calls.append(done)
    )
    assert found.label.dims == ("a", "b") and found.label.dtype == np.uint16
    assert np.array_equal(found.label, (found.a > found.b).astype("uint16"))
    assert found.a.values == pytest.approx((np.arange(6) + 0.5) / 6)
    assert calls[-1] == (6, 6)


@pytest.mark.parametrize(
    "labels, error, part",
    [
        ([[0.5, 1.0]], TypeError, "float64"),
        ([[-1, 0]], ValueError, "-1"),
        ([[70000, 0]], ValueError, "70000"),
        ([0, 1], ValueError, "1"),
        (np.zeros((0, 3), int), ValueError, "0"),
    ],
)
def test_what_is_no_image_of_labels_is_told(labels, error, part):
    with pytest.raises(error, match=part):
        label_image(labels)


def test_wrong_calls_are_told():
    pytest.importorskip("xarray")
    with pytest.raises(ValueError, match="shape"):
        basins_of(lambda x, y: np.zeros(3, int), {"x": (0, 1), "y": (0, 1)}, shape=(5, 5))
    with pytest.raises(ValueError, match="two coordinates"):
        basins_of(lambda x: x > 0, {"x": (0, 1)})
    with pytest.raises(TypeError, match="names its coordinates"):
        basins_of(lambda x, y: x > 0, [(0, 1), (0, 1)])
    with pytest.raises(ValueError, match="1"):
        basins_of(lambda x, y: x > 0, {"x": (1, 0), "y": (0, 1)})
    with pytest.raises(ValueError, match="-1"):
        label_image(checkerboard()).boxes(-1)
    with pytest.raises(ValueError, match="-1"):
        region_fractions(lambda x: x > 0, [(0, 1)], seed=-1)
    with pytest.raises(ValueError, match="99"):
        label_image(checkerboard()).boxes(99)
    with pytest.raises(ZeroDivisionError):
        region_fractions(lambda x: 1 // 0, [(0, 1)])
    with pytest.raises(ValueError):
        uncertainty_exponent(lambda x: x > 2, [(0, 1)], [0.1, 0.01, 0.001])


def newton(z):
    x, y = z
    square = x * x + y * y
    return (0.5 * (x - x / square), 0.5 * (y + y / square)) if square else None


def test_newtons_method_for_a_square_root_has_two_attractors():
    # z² = −1 in the plane: ±i.
    found = Attractors(newton, region=[(-3.1, 3)] * 2, starts=[[1, 2], [0.5, -0.1], [-2, 0.7], [1, 0]], tests=40)
    points = found.points
    assert sorted(points) == [1, 2] and points[1][0] == pytest.approx([0, 1], abs=1e-9)
    assert found.labels([[0, -7], [0.3, 0.2]]).tolist() == [2, 1]
    # On the line between the basins the orbit is chaotic.
    assert [start for start, _ in found.unmatched] == [[1, 0]]
    assert found.labels([[0, 0]]).tolist() == [labelling.UNDECIDED_MAP]


def test_an_exception_of_a_map_passes_unchanged():
    mine = RuntimeError("mine")

    def broken(x):
        raise mine

    with pytest.raises(RuntimeError) as caught:
        Attractors(broken, region=[(0, 1)], starts=[[0.5]])
    assert caught.value is mine
    with pytest.raises(ValueError, match="2 numbers"):
        Attractors(lambda x: [1.0, 2.0], region=[(0, 1)], starts=[[0.5]])
    with pytest.raises(ValueError, match="2"):
        Attractors(lambda x: x, region=[(0, 1)], starts=[[0.5, 0.5]])
    with pytest.raises(ValueError, match="NaN"):
        Attractors(lambda x: x / 2, region=[(-1, 1)], starts=[[0.5]], escape=float("nan"))
    with pytest.raises(ValueError, match="2 coordinates where 1"):
        Attractors(lambda x: x / 2, region=[(-1, 1)], starts=[[0.5]]).labels([[0.5, 0.5]])


def test_stop_iteration_of_a_map_or_a_labelling_is_a_runtime_error():
    def broken(*arguments):
        raise StopIteration

    with pytest.raises(RuntimeError, match="StopIteration"):
        Attractors(broken, region=[(0, 1)], starts=[[0.5]])
    with pytest.raises(RuntimeError, match="StopIteration"):
        region_fractions(broken, UNIT, count=10)
    with pytest.raises(RuntimeError, match="StopIteration"):
        basins_of(broken, {"x": (0, 1), "y": (0, 1)}, shape=(4, 4))


def test_a_search_that_finds_none_says_what_would_help():
    found = Attractors(lambda x: 2 * x, region=[(-1, 1)], starts=[[0.5]], lost=10)
    assert "larger region" in found.remedy and "beyond the border 1" in repr(found)
    assert found.unmatched[0][1].startswith("left the region")
    slow = Attractors(lambda x: 0.99999 * x, region=[(-1, 1)], starts=[[0.5]], budget=500, tests=5)
    assert "budget" in slow.remedy and "drift" in slow.unmatched[0][1]
    escaped = Attractors(lambda x: 2 * x, region=[(-1, 1)], starts=[[0.5]], escape=10)
    assert escaped.remedy is None and escaped.labels([[0.5]]).tolist() == [labelling.ESCAPED]


def test_ctrl_c_ends_a_search(ctrl_c):
    starts = np.linspace(0.1, 0.9, 1000)[:, None].tolist()
    with ctrl_c():
        Attractors(lambda x: (x * 3.9 * (1 - x)), region=[(0, 1)], starts=starts, cells=10**7, budget=10**9)
