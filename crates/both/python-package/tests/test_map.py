"""The map for scalars and arrays."""

import copy
import pickle

import numpy as np
import passive_hopper as hopper
import pytest


@pytest.fixture
def lift_off_map():
    return hopper.LiftOffMap(0.2)


def test_scalars_are_floats_and_arrays_keep_their_shape(lift_off_map):
    assert isinstance(lift_off_map(7.0), float)
    assert isinstance(lift_off_map(np.float64(7.0)), float)
    assert isinstance(lift_off_map(7), float)
    for speeds in ([5.0, 7.0], (5.0, 7.0), np.array([5, 7]), np.array([5.0, 7.0], dtype=np.float32)):
        images = lift_off_map(speeds)
        assert images.dtype == np.float64 and images.shape == (2,)
        assert images[1] == lift_off_map(7.0)
    square = np.linspace(4.5, 20, 12).reshape(3, 4)
    assert np.array_equal(lift_off_map(square).ravel(), lift_off_map(square.ravel()))
    # Strides that are not those of C.
    assert np.array_equal(lift_off_map(square.T), lift_off_map(square).T)
    assert np.array_equal(lift_off_map(square[:, ::-2]), lift_off_map(square)[:, ::-2])
    assert lift_off_map(np.empty((0, 3))).shape == (0, 3)


def test_arrays_of_every_layout_and_length_are_the_same(lift_off_map):
    # Longer than the pieces in which arrays are read.
    speeds = np.linspace(4.5, 20, 150_001)
    images, status = lift_off_map.images(speeds, status=True)
    assert np.array_equal(lift_off_map(speeds), images, equal_nan=True)
    assert np.array_equal(
        np.concatenate([lift_off_map(part) for part in np.array_split(speeds, 7)]), images, equal_nan=True
    )
    assert np.array_equal(status == 0, ~np.isnan(images))
    locked = speeds.copy()
    locked.flags.writeable = False
    for array in (locked, speeds.astype(">f8"), np.repeat(speeds, 2)[::2], memoryview(speeds)):
        assert np.array_equal(lift_off_map(array), images, equal_nan=True)
    assert np.array_equal(lift_off_map(speeds[::-1]), images[::-1], equal_nan=True)
    assert lift_off_map(np.array(7.0)) == lift_off_map(7.0)
    assert np.array_equal(speeds, np.linspace(4.5, 20, 150_001))


def test_arrays_and_scalars_have_the_same_bits(lift_off_map):
    speeds = np.linspace(0.1, 20, 3000)
    one_by_one = np.array([lift_off_map(float(speed)) for speed in speeds])
    assert np.array_equal(lift_off_map(speeds), one_by_one, equal_nan=True)


def test_the_bits_are_those_of_the_library(lift_off_map):
    # crates/hopper/passive-hopper/tests/bits.rs has the same hash of the same images.
    images = lift_off_map(4.5 + np.arange(100_000) * 2.0**-13)
    digest = 0xCBF29CE484222325
    for word in np.nan_to_num(images).view(np.uint64).tolist():
        digest = (digest ^ word) * 0x100000001B3 % 2**64
    assert digest == 0x242D58AF4F602311


def test_nan_is_grounded_and_stays(lift_off_map):
    heavy = hopper.LiftOffMap(0.8)
    grounded = heavy.fates(np.linspace(4.5, 20, 1000))
    assert np.isnan(heavy(np.nan))
    images, status = heavy.images([np.nan, 3.0, 7.0], status=True)
    assert status.dtype == np.uint8
    assert np.array_equal(np.isnan(images), status != 0)
    assert status[0] == 3
    assert hopper.label_name(int(grounded.max())) == "grounded"
    # What the map gives, the fates take.
    speeds = np.linspace(4.5, 20, 1000)
    after = heavy.fates(heavy(speeds))
    assert np.array_equal(
        after[np.isnan(heavy(speeds))] == grounded.max(), np.full(np.isnan(heavy(speeds)).sum(), True)
    )
    assert heavy.fates([np.nan, 7.0])[1] == heavy.fates([7.0])[0]
    assert (heavy.fate(np.nan).name, heavy.fate(np.nan).hops) == ("grounded", 0)
    assert heavy.slopes(np.nan) is None
    assert hopper.LiftOffMap(0.2) == lift_off_map != heavy
    assert len({hopper.LiftOffMap(0.2), lift_off_map, heavy}) == 2


@pytest.mark.parametrize("bad", [-1.0, 0.0, np.inf, 1e300, [5.0, -2.0]])
def test_wrong_speeds_are_value_errors_with_the_number(lift_off_map, bad):
    number = str(np.ravel(bad)[-1]).removesuffix(".0")
    with pytest.raises(ValueError) as caught:
        lift_off_map(bad)
    assert number.split("e")[0] in str(caught.value)


NO_NUMBERS = [
    "seven", "7.0", b"7", ["7.0"], None, [None, 7.0], 1 + 2j, [1 + 2j], np.complex64(7), np.array([7 + 0j]), {"a": 7.0}, object(), float,
    np.datetime64("2020"), np.array(["2020"], dtype="datetime64[Y]"), np.timedelta64(7, "s"), iter([7.0]),
]  # fmt: skip


@pytest.mark.parametrize("bad", NO_NUMBERS, ids=repr)
def test_what_is_no_number_is_a_type_error(lift_off_map, bad):
    for call in (lift_off_map, lift_off_map.images, lift_off_map.fates):
        with pytest.raises(TypeError, match="number"):
            call(bad)


def test_lists_without_a_shape_are_told(lift_off_map):
    with pytest.raises(ValueError, match="inhomogeneous"):
        lift_off_map([[1.0], [2.0, 3.0]])


def test_other_numbers_of_python_and_numpy_are_taken(lift_off_map):
    from decimal import Decimal
    from fractions import Fraction

    for seven in (7, np.int8(7), np.float32(7), np.longdouble(7), Fraction(7), Decimal(7), np.array(7, dtype=object)):
        assert isinstance(lift_off_map(seven), float) and lift_off_map(seven) == lift_off_map(7.0)
    assert lift_off_map([Fraction(7), 7]).tolist() == lift_off_map([7.0, 7.0]).tolist()
    with pytest.raises(OverflowError):
        lift_off_map(10**400)


@pytest.mark.parametrize("bad", [0.0, -1.0, np.nan, np.inf])
def test_wrong_mass_ratios_are_value_errors(bad):
    with pytest.raises(ValueError, match="mass ratio"):
        hopper.LiftOffMap(bad)


def test_hops_and_orbits(lift_off_map):
    hop = lift_off_map.hop(7.0)
    assert hop.next == lift_off_map(7.0)
    assert hop.sudden + 1 == len(hop.landings)
    assert hop.loss == pytest.approx(hop.speed - hop.next, rel=1e-12)
    assert "next=" in repr(hop) and "time=" in repr(hop.landings[0])
    orbit = lift_off_map.orbit(7.0, 5)
    assert orbit[0] == 7.0 and len(orbit) == 6
    assert np.array_equal(lift_off_map(orbit[:-1]), orbit[1:])
    assert len(lift_off_map.orbit(7.0, 0)) == 1
    with pytest.raises(ValueError, match="not -1"):
        lift_off_map.orbit(7.0, -1)
    slope, _ = lift_off_map.slopes(7.0)
    step = 1e-6
    assert (lift_off_map(7.0 + step) - lift_off_map(7.0 - step)) / (2 * step) == pytest.approx(slope, rel=1e-4)


def test_hops_fates_and_slopes_of_arrays_are_records(lift_off_map):
    speeds = np.array([[4.55, 7.0, np.nan], [5.5, 1.0, 9.0]])
    hops, fates, slopes = lift_off_map.hop(speeds), lift_off_map.fate(speeds), lift_off_map.slopes(speeds)
    assert hops.shape == fates.shape == slopes.shape == speeds.shape
    for at, speed in np.ndenumerate(speeds):
        if np.isnan(speed):
            assert np.isnan(hops.next[at]) and fates.hops[at] == 0 and np.isnan(slopes.by_speed[at])
            continue
        hop, fate, slope = lift_off_map.hop(speed), lift_off_map.fate(speed), lift_off_map.slopes(speed)
        assert (fates.label[at], fates.hops[at]) == (fate.label, fate.hops)
        assert (hops.sudden[at], hops.flight_time[at]) == (hop.sudden, hop.flight_time)
        known = np.nan if hop.next is None else hop.next
        assert np.array_equal(hops.next[at], known, equal_nan=True)
        assert np.array_equal([slopes.by_speed[at], slopes.by_mass_ratio[at]], slope or (np.nan, np.nan), equal_nan=True)
    # What is one number is no array, whatever its type.
    for seven in (7, np.float32(7), np.array(7.0)):
        assert lift_off_map.hop(seven) == lift_off_map.hop(7.0) and lift_off_map.fate(seven) == lift_off_map.fate(7.0)


def test_results_go_into_a_given_array_and_masks_are_refused(lift_off_map):
    speeds = np.linspace(4.5, 20, 20_000).reshape(100, 200)
    out = np.zeros_like(speeds)
    assert lift_off_map.images(speeds, out=out) is out
    assert np.array_equal(out, lift_off_map(speeds), equal_nan=True)
    assert lift_off_map.images(speeds, out=speeds) is speeds and np.array_equal(speeds, out, equal_nan=True)
    for bad in (np.zeros(3), np.zeros((100, 200), dtype=np.float32), np.zeros((200, 100)).T, [0.0]):
        with pytest.raises(ValueError, match="out= is an array of float64 with the shape"):
            lift_off_map.images(out, out=bad)
    out.flags.writeable = False
    with pytest.raises(ValueError, match="written"):
        lift_off_map.images(speeds, out=out)
    with pytest.raises(TypeError, match="alpha.mask"):
        lift_off_map.images([5.0, 7.0], where=[True, False])
    assert lift_off_map(np.float32([5, 7])).dtype == np.float64


def test_mass_ratios_are_broadcast(lift_off_map):
    ratios, speeds = np.array([0.2, 0.4, 0.2]), np.array([[5.5], [7.0]])
    found = hopper.images(speeds, ratios)
    assert found.shape == (2, 3) and (found[:, 0] == found[:, 2]).all()
    assert found[1, 0] == lift_off_map(7.0) and found[0, 1] == hopper.LiftOffMap(0.4)(5.5)
    assert isinstance(hopper.images(7.0, 0.2), float) and np.isnan(hopper.images(np.nan, 0.2))
    with pytest.raises(ValueError, match="mass ratio"):
        hopper.images(7.0, [0.2, -1.0])
    with pytest.raises(ValueError, match="broadcast"):
        hopper.images([1.0, 2.0, 3.0], [0.2, 0.4])


def test_a_map_is_copied_and_sent_to_other_processes(lift_off_map):
    for other in (copy.copy(lift_off_map), copy.deepcopy(lift_off_map), pickle.loads(pickle.dumps(lift_off_map))):
        assert other.mass_ratio == lift_off_map.mass_ratio and other(7.0) == lift_off_map(7.0)


@pytest.mark.parametrize(
    "call",
    [
        lambda m: m.fate(4.4),
        lambda m: m.fates(np.linspace(4.3, 4.4, 30_000)),
        lambda m: hopper.LiftOffMap(0.2).orbit(4.55, 10**9),
    ],
)
def test_ctrl_c_ends_long_orbits(call, ctrl_c):
    # A light upper mass loses so little in a hop that orbits take their whole budget of hops.
    m = hopper.LiftOffMap(1e9)
    with ctrl_c():
        call(m)


def test_contact_hops_are_the_same_at_one_over_m():
    light, heavy = hopper.LiftOffMap(0.25), hopper.LiftOffMap(4.0)
    speeds = [speed for speed in np.linspace(4.5, 20, 1000) if light.hop(speed).sudden == heavy.hop(speed).sudden == 0]
    assert len(speeds) > 100
    assert np.allclose(light(speeds), heavy(speeds), rtol=1e-12, equal_nan=True)


def test_numpy_is_loaded_with_the_package():
    # Loaded later, within a call, a failure would be a panic.
    import subprocess
    import sys

    code = "import sys; from nonsmooth import _native; assert 'numpy' in sys.modules"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
    broken = "import sys; sys.modules['numpy'] = None\ntry:\n    import passive_hopper\nexcept ImportError: sys.exit(7)"
    assert subprocess.run([sys.executable, "-c", broken], check=False).returncode == 7


def test_masked_speeds_are_refused():
    m = hopper.LiftOffMap(0.2)
    masked = np.ma.array([5.0, 6.0], mask=[False, True])
    for call in (m, m.images, m.fates):
        with pytest.raises(TypeError, match="masked"):
            call(masked)
    assert m(np.ma.array([5.0, 6.0])).tolist() == m([5.0, 6.0]).tolist()
