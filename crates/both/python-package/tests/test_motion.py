"""The motion of both masses."""

import os

import numpy as np
import passive_hopper as hopper
import pytest

xarray = pytest.importorskip("xarray")


def test_a_motion_lands_and_lifts_off_as_the_map_says():
    found = hopper.motion(7.0, M=0.2, hops=2)
    hop = hopper.LiftOffMap(0.2).hop(7.0)
    names = found.event_kind.attrs["flag_meanings"].split()
    kinds = [names[kind] for kind in found.event_kind.values]
    one = ["sudden_lift_off"] * hop.sudden + ["landing", "gradual_lift_off"]
    assert kinds[: 1 + len(one)] == ["gradual_lift_off", *one]
    landings = found.event_time.values[1 : 2 + hop.sudden]
    assert landings == pytest.approx(np.cumsum([landing.time for landing in hop.landings]), rel=1e-12)
    lift_off = float(found.event_time[len(one)])
    at = found.isel(sample=int(np.flatnonzero(found.time.values >= lift_off)[0]))
    assert float(at.upper_position) == pytest.approx(1.0, abs=1e-9)
    speeds = found.upper_velocity.values[np.flatnonzero(np.diff(found.hop.values)) + 1]
    assert speeds[0] == pytest.approx(hop.next, rel=1e-12)
    assert float(found.lower_position.min()) > -1e-12
    assert found.time.attrs["units"] == "1" and "1/omega" in found.time.attrs["long_name"]


def test_sudden_lift_offs_are_marked():
    ratio = 0.9
    m = hopper.LiftOffMap(ratio)
    alpha = next(speed for speed in np.linspace(4.5, 12, 500) if m.hop(speed).sudden > 0)
    found = hopper.motion(alpha, M=ratio, hops=1)
    sudden = found.event_time.values[found.event_kind.values == 2]
    assert len(sudden) == m.hop(alpha).sudden
    # The lower mass is on the ground at that instant, and in the air before and after.
    rows = np.flatnonzero(found.time.values == sudden[0])
    assert np.abs(found.lower_position.values[rows]).max() < 1e-9
    assert not found.contact.values[rows].any()


def test_an_animation_is_a_file(tmp_path):
    found = hopper.motion(7.0, M=0.2, hops=1)
    frames = []
    path = hopper.animate(found, tmp_path / "hopper.gif", progress=lambda done, all: frames.append((done, all)))
    assert path.read_bytes().startswith(b"GIF89a")
    assert all(done <= all for done, all in frames)
    hopper.animate(found, str(tmp_path / "hopper.apng"))
    assert (tmp_path / "hopper.apng").read_bytes().startswith(b"\x89PNG")
    assert sorted(file.name for file in tmp_path.iterdir()) == ["hopper.apng", "hopper.gif"]


def test_an_animation_draws_the_dataset_that_it_is_given(tmp_path):
    found = hopper.motion(7.0, M=0.2, hops=2)
    drawn = lambda motion: hopper.animate(motion, tmp_path / "hopper.gif").read_bytes()
    whole = drawn(found)
    assert drawn(found.copy(deep=True)) == whole
    # A part is shorter, also one that begins in mid-air; a motion that was changed looks different.
    half = found.isel(sample=slice(None, found.sizes["sample"] // 2))
    later = found.isel(sample=slice(5, None))
    higher = found.assign(upper_position=found.upper_position * 1.5)
    pictures = [whole, drawn(half), drawn(later), drawn(higher)]
    assert len(set(pictures)) == 4
    assert len(pictures[1]) < len(whole)
    with pytest.raises(ValueError, match="before"):
        drawn(found.isel(sample=slice(None, None, -1)))
    with pytest.raises(ValueError, match="not finite"):
        drawn(found.assign(upper_position=found.upper_position * np.nan))
    with pytest.raises(ValueError, match="no samples"):
        drawn(found.isel(sample=slice(0, 0)))
    with pytest.raises(ValueError, match="lower_velocity"):
        drawn(found.drop_vars("lower_velocity"))


@pytest.mark.parametrize("bad", ["hopper.mp4", "hopper", "hopper.gif.zip"])
def test_other_files_are_refused_by_name(tmp_path, bad):
    with pytest.raises(ValueError, match=bad):
        hopper.animate(hopper.motion(7.0, hops=1), tmp_path / bad)
    assert not list(tmp_path.iterdir())


def test_what_cannot_move_is_a_value_error():
    for alpha, ratio in [(-1.0, 0.2), (float("nan"), 0.2), (7.0, 0.0), (1e300, 0.2)]:
        with pytest.raises(ValueError):
            hopper.motion(alpha, M=ratio)
    with pytest.raises(ValueError, match="frames"):
        hopper.animate(hopper.motion(20000.0, hops=1), "hopper.gif")
    with pytest.raises(ValueError, match="attribute"):
        hopper.animate(xarray.Dataset(), "hopper.gif")


def test_an_animation_is_written_through_a_link_and_into_no_pipe(tmp_path):
    found = hopper.motion(7.0, hops=1)
    target, link = tmp_path / "target.gif", tmp_path / "link.gif"
    target.write_bytes(b"old")
    link.symlink_to(target)
    hopper.animate(found, link)
    assert link.is_symlink() and target.read_bytes().startswith(b"GIF8")
    pipe = tmp_path / "pipe.gif"
    os.mkfifo(pipe)
    with pytest.raises(OSError, match="named pipe"):
        hopper.animate(found, pipe)
    folder = tmp_path / "folder.gif"
    folder.mkdir()
    with pytest.raises(IsADirectoryError, match="folder"):
        hopper.animate(found, folder)
    assert sorted(file.name for file in tmp_path.iterdir()) == ["folder.gif", "link.gif", "pipe.gif", "target.gif"]
