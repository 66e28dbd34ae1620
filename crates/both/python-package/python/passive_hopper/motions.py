"""The motion of both masses as an xarray.Dataset, and as an animation."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from nonsmooth.errors import InputError
from nonsmooth import _native
from nonsmooth._conventions import CONVENTIONS, complete, flag_attributes
from ._files import write_whole

if TYPE_CHECKING:
    import xarray


def motion(alpha: float, M: float = 0.2, hops: int = 10) -> xarray.Dataset:
    """Both masses in time, from a gradual lift-off with speed ``alpha`` over some hops, as an ``xarray.Dataset``.

    Positions are in units of m₂g/k, times in units of 1/ω, speeds in units of m₂gω/k, with ω² = k(1+M)/m₂. The upper
    mass stands at 1 when the contact force vanishes, the lower mass on the ground at 0. A landing has two samples at
    one time, before the collision and after it. The variable ``event_kind`` marks gradual lift-offs, landings, and
    sudden lift-offs, at which the stretched spring pulls the lower mass off the ground again at once.

    >>> from passive_hopper import motion
    >>> found = motion(7.0, M=0.2, hops=2)
    >>> sorted(found.data_vars)
    ['contact', 'event_kind', 'hop', 'lower_position', 'lower_velocity', 'upper_position', 'upper_velocity']
    >>> bool((found.lower_position > -1e-12).all())
    True

    ``animate(found, "hopper.gif")`` draws it.
    """
    try:
        import xarray
    except ImportError as error:
        raise ImportError(
            "motion needs xarray: pip install 'passive-hopper[xarray]'. motion_arrays gives the same as arrays."
        ) from error
    import numpy

    arrays = _native.motion_arrays(alpha, M, hops)
    codes, names = zip(*_native.motion_event_names())
    states = arrays["states"]
    length, speed, time = "m2 g/k", "m2 g omega/k", "1/omega"

    def scaled(name, scale):
        return {"long_name": f"{name}, in units of {scale}", "units": "1"}

    def column(k, name, scale):
        return ("sample", numpy.ascontiguousarray(states[:, k]), scaled(name, scale))

    found = xarray.Dataset(
        {
            "upper_position": column(0, "position of the upper mass, y1", length),
            "upper_velocity": column(1, "velocity of the upper mass", speed),
            "lower_position": column(2, "position of the lower mass, y2", length),
            "lower_velocity": column(3, "velocity of the lower mass", speed),
            "hop": (
                "sample",
                arrays["hops"],
                {"long_name": "gradual lift-offs before, without the first", "units": "1"},
            ),
            "contact": ("sample", arrays["contact"], {"long_name": "whether the lower mass is on the ground"}),
            "event_kind": (
                "event_time",
                arrays["event_kinds"],
                flag_attributes(numpy.array(codes, dtype="uint8"), names, "what happens at event_time"),
            ),
        },
        coords={
            # A landing has two samples at one time, so that the time is no dimension.
            "time": ("sample", arrays["times"], scaled("time since the first lift-off", time)),
            "event_time": ("event_time", arrays["event_times"], scaled("time of an event", time)),
        },
        attrs={
            "Conventions": CONVENTIONS,
            "title": "motion of a passive hopper",
            "source": f"passive_hopper {_native.__version__}",
            "history": f"computed by passive_hopper {_native.__version__}",
            "mass_ratio": float(M),
            "alpha": float(alpha),
            "hops": int(hops),
            "grounded": int(arrays["grounded"]),
        },
    )
    return complete(found)


def animate(
    motion: xarray.Dataset, path: str | os.PathLike[str], progress: Callable[[int, int], Any] | bool | None = None
) -> str | os.PathLike[str]:
    """Draws a motion, from :func:`motion`, or a part of one, as an animation: a file ``….gif``, or ``….apng`` (animated
    PNG). Returns the path.

    It is the drawing of the program ``hopper orbit --animate``: the hopper on the left, and a cursor on the curves of
    both masses. ``progress(done, all)`` counts the frames; ``progress=True`` shows a bar of tqdm.
    """
    ending = os.path.splitext(os.fspath(path))[1].removeprefix(".").lower()
    form = "apng" if ending == "png" else ending
    if form not in ("gif", "apng"):
        raise InputError(f"an animation is a file ….gif or ….apng, not {os.fspath(path)!r}")
    import numpy

    columns = ("upper_position", "upper_velocity", "lower_position", "lower_velocity")
    try:
        ratio = float(motion.attrs["mass_ratio"])
        times, hops, contact, *states = (numpy.asarray(motion[name]) for name in ("time", "hop", "contact", *columns))
    except (AttributeError, KeyError, TypeError) as error:
        needed = ("time", "hop", "contact", *columns)
        missing = [name for name in needed if name not in motion] if isinstance(motion, Mapping) else []
        found = (
            f"{', '.join(missing)} is missing"
            if missing
            else f"it is {type(motion).__name__}" if not isinstance(motion, Mapping) else "mass_ratio is missing"
        )
        raise InputError(
            f"animate needs the Dataset of motion(…), or a part of it: {', '.join(needed)}, and the attribute"
            f" mass_ratio; {found}"
        ) from error
    if not numpy.isfinite(numpy.asarray(hops, dtype=float)).all():
        raise InputError("animate needs whole numbers in hop, not NaN")
    if len(times) and times[-1] == times[0]:
        raise InputError(f"the motion lasts no time: it begins and ends at {times[0]}; give a longer part of it")
    content = _native.animation_bytes(
        ratio,
        times.astype(float).tolist(),
        hops.astype(int).tolist(),
        contact.astype(bool).tolist(),
        numpy.stack(states, axis=-1).astype(float).tolist(),
        form=form,
        progress=progress,
    )
    write_whole(path, content)
    return path
