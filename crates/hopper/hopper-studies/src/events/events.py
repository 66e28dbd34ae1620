"""Events of six scenes by SciPy and by heyoka: times of the events, state at the end, time of a run.

python events.py results.json

Each scene is a function that builds its model and returns a function that runs it. The function that runs it returns
the times of the events and the first component of the state at the end. The lines between `begin` and `end` are the
lines of the model. A run ends at the limit on time or after MOST events.
"""

import json
import math
import sys
import time

import heyoka
import scipy
from scipy.integrate import solve_ivp

MOST = 1000
TOLERANCES = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-12}


# begin scipy ball
def scipy_ball():
    def impact(t, x):
        return x[0]

    impact.terminal, impact.direction = True, -1

    def run():
        t, x, times = 0.0, [1.0, 0.0], []
        while len(times) < MOST:
            arc = solve_ivp(lambda t, x: (x[1], -9.81), (t, 5.0), x, events=impact, **TOLERANCES)
            t, x = arc.t[-1], arc.y[:, -1]
            if arc.status != 1:
                break
            times.append(t)
            x = [0.0, -0.8 * x[1]]
        return times, x[0]

    return run


# end
# begin scipy pendulum
def scipy_pendulum():
    def section(t, x):
        return x[0]

    def run():
        arc = solve_ivp(lambda t, x: (x[1], -math.sin(x[0])), (0.0, 400.0), [2.0, 0.0], events=section, **TOLERANCES)
        return list(arc.t_events[0]), arc.y[0, -1]

    return run


# end
# begin scipy turning points
def scipy_turning_points():
    def section(t, x):
        return x[0] - 1.9999

    def run():
        arc = solve_ivp(lambda t, x: (x[1], -math.sin(x[0])), (0.0, 400.0), [2.0, 0.0], events=section, **TOLERANCES)
        return list(arc.t_events[0]), arc.y[0, -1]

    return run


# end
# begin scipy van der Pol
def scipy_van_der_pol():
    def section(t, x):
        return x[0]

    def run():
        arc = solve_ivp(
            lambda t, x: (x[1], 5.0 * (1.0 - x[0] ** 2) * x[1] - x[0]),
            (0.0, 300.0),
            [2.0, 0.0],
            events=section,
            **TOLERANCES,
        )
        return list(arc.t_events[0]), arc.y[0, -1]

    return run


# end
# begin scipy relay with hysteresis
def scipy_hysteresis():
    def above(t, x):
        return x[0] - 0.01

    def below(t, x):
        return x[0] + 0.01

    above.terminal, above.direction = True, 1
    below.terminal, below.direction = True, -1

    def run():
        t, x, relay, times = 0.0, [1.0], -1.0, []
        while len(times) < MOST:
            arc = solve_ivp(
                lambda t, x: (relay + 0.3,), (t, 5.0), x, events=below if relay < 0.0 else above, **TOLERANCES
            )
            t, x = arc.t[-1], arc.y[:, -1]
            if arc.status != 1:
                break
            times.append(t)
            relay = -relay
        return times, x[0]

    return run


# end
# begin scipy relay
def scipy_relay():
    def switch(t, x):
        return x[0]

    def run():
        t, x, relay, times = 0.0, [1.0], -1.0, []
        while len(times) < MOST:
            switch.terminal, switch.direction = True, relay
            arc = solve_ivp(lambda t, x: (relay + 0.3,), (t, 5.0), x, events=switch, **TOLERANCES)
            t, x = arc.t[-1], arc.y[:, -1]
            if arc.status != 1:
                break
            times.append(t)
            relay = -relay
        return times, x[0]

    return run


# end
# begin heyoka ball
def heyoka_ball():
    x, v = heyoka.make_vars("x", "v")
    times = []

    def impact(integrator, _):
        times.append(integrator.time)
        integrator.state[1] *= -0.8
        return len(times) < MOST

    event = heyoka.t_event(x, direction=heyoka.event_direction.negative, callback=impact)
    ball = heyoka.taylor_adaptive([(x, v), (v, heyoka.expression(-9.81))], [1.0, 0.0], t_events=[event])

    def run():
        times.clear()
        ball.time, ball.state[:] = 0.0, [1.0, 0.0]
        ball.reset_cooldowns()
        ball.propagate_until(5.0)
        return times, ball.state[0]

    return run


# end
# begin heyoka pendulum
def heyoka_pendulum():
    x, v = heyoka.make_vars("x", "v")
    times = []
    section = heyoka.nt_event(x, lambda integrator, t, _: times.append(t))
    pendulum = heyoka.taylor_adaptive([(x, v), (v, -heyoka.sin(x))], [2.0, 0.0], nt_events=[section])

    def run():
        times.clear()
        pendulum.time, pendulum.state[:] = 0.0, [2.0, 0.0]
        pendulum.propagate_until(400.0)
        return times, pendulum.state[0]

    return run


# end
# begin heyoka turning points
def heyoka_turning_points():
    x, v = heyoka.make_vars("x", "v")
    times = []
    section = heyoka.nt_event(x - 1.9999, lambda integrator, t, _: times.append(t))
    pendulum = heyoka.taylor_adaptive([(x, v), (v, -heyoka.sin(x))], [2.0, 0.0], nt_events=[section])

    def run():
        times.clear()
        pendulum.time, pendulum.state[:] = 0.0, [2.0, 0.0]
        pendulum.propagate_until(400.0)
        return times, pendulum.state[0]

    return run


# end
# begin heyoka van der Pol
def heyoka_van_der_pol():
    x, v = heyoka.make_vars("x", "v")
    times = []
    section = heyoka.nt_event(x, lambda integrator, t, _: times.append(t))
    oscillator = heyoka.taylor_adaptive([(x, v), (v, 5.0 * (1.0 - x**2) * v - x)], [2.0, 0.0], nt_events=[section])

    def run():
        times.clear()
        oscillator.time, oscillator.state[:] = 0.0, [2.0, 0.0]
        oscillator.propagate_until(300.0)
        return times, oscillator.state[0]

    return run


# end
# begin heyoka relay with hysteresis
def heyoka_hysteresis():
    x = heyoka.make_vars("x")
    times = []

    def switch(relay):
        def callback(integrator, _):
            times.append(integrator.time)
            integrator.pars[0] = relay
            return len(times) < MOST

        return callback

    rising, falling = heyoka.event_direction.positive, heyoka.event_direction.negative
    events = [
        heyoka.t_event(x - 0.01, direction=rising, callback=switch(-1.0)),
        heyoka.t_event(x + 0.01, direction=falling, callback=switch(1.0)),
    ]
    relay = heyoka.taylor_adaptive([(x, heyoka.par[0] + 0.3)], [1.0], t_events=events)

    def run():
        times.clear()
        relay.time, relay.state[:], relay.pars[:] = 0.0, [1.0], [-1.0]
        relay.reset_cooldowns()
        relay.propagate_until(5.0)
        return times, relay.state[0]

    return run


# end
# begin heyoka relay
def heyoka_relay():
    x = heyoka.make_vars("x")
    times = []

    def switch(integrator, _):
        times.append(integrator.time)
        integrator.pars[0] = -integrator.pars[0]
        return len(times) < MOST

    event = heyoka.t_event(x, callback=switch)
    relay = heyoka.taylor_adaptive([(x, heyoka.par[0] + 0.3)], [1.0], t_events=[event])

    def run():
        times.clear()
        relay.time, relay.state[:], relay.pars[:] = 0.0, [1.0], [-1.0]
        relay.reset_cooldowns()
        relay.propagate_until(5.0)
        return times, relay.state[0]

    return run


# end


def measure(scene, name, build):
    """The run's events, and the smallest time of some runs: other processes only make a run longer."""
    run = build()
    times, end = run()
    times, end = [float(t) for t in times], float(end)
    smallest = math.inf
    begin = time.perf_counter()
    while time.perf_counter() - begin < 1.0:
        start = time.perf_counter()
        run()
        smallest = min(smallest, time.perf_counter() - start)
    return {"scene": scene, "name": name, "seconds": smallest, "times": times, "end": end}


def main():
    scipy_name = f"SciPy {scipy.__version__}"
    heyoka_name = f"heyoka {heyoka.__version__}"
    results = [
        measure("ball", scipy_name, scipy_ball),
        measure("pendulum", scipy_name, scipy_pendulum),
        measure("turning points", scipy_name, scipy_turning_points),
        measure("van der Pol", scipy_name, scipy_van_der_pol),
        measure("relay with hysteresis", scipy_name, scipy_hysteresis),
        measure("relay", scipy_name, scipy_relay),
        measure("ball", heyoka_name, heyoka_ball),
        measure("pendulum", heyoka_name, heyoka_pendulum),
        measure("turning points", heyoka_name, heyoka_turning_points),
        measure("van der Pol", heyoka_name, heyoka_van_der_pol),
        measure("relay with hysteresis", heyoka_name, heyoka_hysteresis),
        measure("relay", heyoka_name, heyoka_relay),
    ]
    with open(sys.argv[1], "w") as file:
        json.dump(results, file)


main()
