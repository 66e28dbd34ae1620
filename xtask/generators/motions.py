"""Motions of well-known systems, and their states at the end (crates/hopper/hopper-studies).

A scene is data: the names of the state's components, their rates as texts, the start, the time of the end, and for some
a guard, with what its event does to the state. The answer is the state at the end, or the time of the last event.

The coefficients of Taylor series follow from the texts, one after the other; the order is 40 with 45 digits. The
pendulum's period and the energy of Kepler's orbits test them.
"""

from itertools import combinations

from mpmath import cos, ellipk, mp, mpf, nstr, sin

# Digits of the computation and of its results, and the order of the series.
WORKING, PRINTED, ORDER = 45, 25, 40
# The last two terms of a series are no larger than this part of the largest component.
SMALL = mpf(10) ** -42
# Parts of a step on which the sign of a guard is looked at: the scenes' guards have no two zeros closer.
LOOKS = 16


class Part:
    """A function of time, by its Taylor coefficients. `rule(k)` gives the coefficient k from earlier ones."""

    def __init__(self, rule):
        self.rule, self.known = rule, []

    def __getitem__(self, k):
        while len(self.known) <= k:
            self.known.append(self.rule(len(self.known)))
        return self.known[k]

    def __add__(self, other):
        other = part(other)
        return Part(lambda k: self[k] + other[k])

    def __sub__(self, other):
        other = part(other)
        return Part(lambda k: self[k] - other[k])

    def __mul__(self, other):
        other = part(other)
        return Part(lambda k: sum(self[j] * other[k - j] for j in range(k + 1)))

    def __neg__(self):
        return Part(lambda k: -self[k])

    def __pow__(self, exponent):
        if exponent == 2:
            return self * self

        def rule(k):
            if k == 0:
                return self[0] ** exponent
            return sum((exponent * j - (k - j)) * self[j] * power[k - j] for j in range(1, k + 1)) / (k * self[0])

        power = Part(rule)
        return power

    def __radd__(self, other):
        return part(other) + self

    def __rsub__(self, other):
        return part(other) - self

    def __rmul__(self, other):
        return part(other) * self


def part(value):
    """A number that stays; of a text its exact decimal."""
    if isinstance(value, Part):
        return value
    number = mpf(value)
    return Part(lambda k: number if k == 0 else mpf(0))


def angle(value, function, other, sign):
    """sin or cos of a part, by the series of the other one."""

    def rule(k):
        if k == 0:
            return function(value[0])
        return sign * sum(j * value[j] * rest[k - j] for j in range(1, k + 1)) / k

    def of_rest(k):
        if k == 0:
            return other(value[0])
        return -sign * sum(j * value[j] * found[k - j] for j in range(1, k + 1)) / k

    found, rest = Part(rule), Part(of_rest)
    return found


def functions():
    return {"sin": lambda x: angle(x, sin, cos, 1), "cos": lambda x: angle(x, cos, sin, -1)}


def exact(text):
    """Python code of a text in which every decimal is exact."""
    words, out, at = text, "", 0
    while at < len(words):
        end = at
        while end < len(words) and (words[end].isdigit() or words[end] == "."):
            end += 1
        starts_name = at > 0 and (words[at - 1].isalnum() or words[at - 1] == "_")
        if end > at and not starts_name and "." in words[at:end]:
            out += f"number('{words[at:end]}')"
        else:
            end = max(end, at + 1)
            out += words[at:end]
        at = end
    return out


def texts(scene, time, state, wanted):
    """The parts of some texts, and of the state."""
    names = {"t": Part(lambda k: [time, mpf(1)][k] if k < 2 else mpf(0)), "number": mpf, **functions()}
    states = [Part(lambda k, at=at: state[at] if k == 0 else rates[at][k - 1] / k) for at in range(len(state))]
    names.update(zip(scene["states"], states))
    rates = [part(eval(exact(text), {}, names)) for text in scene["field"]]
    return states, [part(eval(exact(text), {}, names)) for text in wanted]


def value(series, h):
    total = mpf(0)
    for k in reversed(range(ORDER + 1)):
        total = total * h + series[k]
    return total


def reset(scene, time, state):
    names = {"t": time, "number": mpf, **dict(zip(scene["states"], state))}
    return [mpf(eval(exact(text), {}, names)) for text in scene["reset"]]


def zero(guard, left, right):
    """The zero of a guard between two times of a step with different signs, by bisection."""
    below = value(guard, left) < 0
    for _ in range(mp.prec):
        middle = (left + right) / 2
        if (value(guard, middle) < 0) == below:
            left = middle
        else:
            right = middle
    return right


def follow(scene):
    """The state at the end and the times of the events."""
    time, until = mpf(0), mpf(scene["end"])
    state, times = [mpf(x) for x in scene["start"]], []
    while time < until:
        guards = [scene["guard"]] if "guard" in scene else []
        states, guards = texts(scene, time, state, guards)
        sizes = [max(abs(s[k]) for s in states) for k in (ORDER - 1, ORDER)]
        largest = max(abs(x) for x in state)
        h = min((SMALL * largest / s) ** (mpf(1) / k) for s, k in zip(sizes, (ORDER - 1, ORDER)))
        h = min(h, until - time)
        for guard in guards:
            looks = [h * j / LOOKS for j in range(LOOKS + 1)]
            signs = [value(guard, look) > 0 for look in looks]
            found = [j for j in range(LOOKS) if signs[j] != signs[j + 1] and (scene["either"] or signs[j + 1])]
            # The zero at the start of an arc has been left.
            found = [j for j in found if not (j == 0 and times and times[-1] == time)]
            if found:
                h = zero(guard, looks[found[0]], looks[found[0] + 1])
                times.append(time + h)
        time = until if time + h >= until else time + h
        state = [value(s, h) for s in states]
        if times and times[-1] == time and not scene["either"]:
            state = reset(scene, time, state)
    return state, times


def planets():
    """Sun and outer planets: Hairer, Lubich, Wanner, Geometric Numerical Integration (2006), I.2.4. AU, days."""
    masses = "1.00000597682 0.000954786104043 0.000285583733151 0.0000437273164546 0.0000517759138449 0.0000000076923076923"
    places = """0 0 0  -3.5023653 -3.8169847 -1.5507963  9.0755314 -3.0458353 -1.6483708
        8.3101420 -16.2901086 -7.2521278  11.4707666 -25.7294829 -10.8169456  -15.5387357 -25.2225594 -3.1902382"""
    speeds = """0 0 0  0.00565429 -0.00412490 -0.00190589  0.00168318 0.00483525 0.00192462
        0.00354178 0.00137102 0.00055029  0.00288930 0.00114527 0.00039677  0.00276725 -0.00170702 -0.00136504"""
    masses, bodies, axes = masses.split(), range(6), "xyz"
    pulls = {(body, axis): [] for body in bodies for axis in axes}
    for i, j in combinations(bodies, 2):
        squares = " + ".join(f"({a}{j} - {a}{i})**2" for a in axes)
        for a in axes:
            pulls[i, a].append(f"+ {masses[j]}*(({a}{j} - {a}{i})*({squares})**(-1.5))")
            pulls[j, a].append(f"- {masses[i]}*(({a}{j} - {a}{i})*({squares})**(-1.5))")
    rates = [f"v{a}{i}" for i in bodies for a in axes]
    rates += [f"0.000295912208286*({' '.join(pulls[i, a]).removeprefix('+ ')})" for i in bodies for a in axes]
    states = [f"{a}{i}" for i in bodies for a in axes] + [f"v{a}{i}" for i in bodies for a in axes]
    return {"states": states, "field": rates, "start": places.split() + speeds.split(), "end": "20000"}


def lorenz(end):
    return {
        "states": ["x", "y", "z"],
        "field": ["10*(y - x)", "x*(28 - z) - y", "x*y - 2.6666666666666665*z"],
        "start": ["1", "1", "1"],
        "end": end,
    }


def van_der_pol(mu, end):
    return {"states": ["x", "v"], "field": ["v", f"{mu}*(1 - x**2)*v - x"], "start": ["2", "0"], "end": end}


def kepler(start, speed, end):
    """From the pericentre. All numbers are doubles: their rounding would be seen after ten turns."""
    force = "(x**2 + y**2)**(-1.5)"
    return {
        "states": ["x", "y", "u", "v"],
        "field": ["u", "v", f"-x*{force}", f"-y*{force}"],
        "start": [start, "0", "0", speed],
        "end": end,
    }


def energy(state):
    x, y, u, v = state
    return (u * u + v * v) / 2 - (x * x + y * y) ** mpf("-0.5")


SCENES = {
    "pendulum section": {
        "states": ["x", "v"],
        "field": ["v", "-sin(x)"],
        "start": ["2", "0"],
        "end": "400",
        "guard": "x",
        "either": True,
    },
    "van der Pol": van_der_pol("5", "30"),
    "impact oscillator": {
        "states": ["x", "v"],
        "field": ["v", "cos(1.3*t) - 0.1*v - x"],
        "start": ["0", "1"],
        "end": "400",
        "guard": "x - 0.5",
        "either": False,
        "reset": ["x", "-0.8*v"],
    },
    "Kepler, e = 0.595": kepler("0.375", "2.0625", "60"),
    "Kepler, e = 0.992": kepler("0.009765625", "14.28125", "90"),
    "Lorenz": lorenz("5"),
    "outer planets": planets(),
    "Lorenz to t = 50": lorenz("50"),
    "van der Pol, μ = 100": van_der_pol("100", "100"),
    # The orbit of Arenstorf around earth and moon: Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I (1993), II.0.
    "Arenstorf": {
        "states": ["x", "y", "u", "v"],
        "field": [
            "u",
            "v",
            "x + 2*v - 0.987722529*(x + 0.012277471)*((x + 0.012277471)**2 + y**2)**(-1.5)"
            " - 0.012277471*(x - 0.987722529)*((x - 0.987722529)**2 + y**2)**(-1.5)",
            "y - 2*u - 0.987722529*y*((x + 0.012277471)**2 + y**2)**(-1.5)"
            " - 0.012277471*y*((x - 0.987722529)**2 + y**2)**(-1.5)",
        ],
        "start": ["0.994", "0", "0", "-2.00158510637908252240537862224"],
        "end": "17.0652165601579625588917206249",
    },
}


def scene(record):
    """One record: the scene, with its answer."""
    with mp.workdps(WORKING):
        found = {"scene": record["scene"], **SCENES[record["scene"]]}
        state, times = follow(found)
        if record["scene"] == "pendulum section":
            quarter = ellipk(sin(mpf(1)) ** 2)
            assert all(abs(t - (2 * k + 1) * quarter) < mpf(10) ** -30 for k, t in enumerate(times))
        if record["scene"].startswith("Kepler"):
            first, last = (energy([mpf(x) for x in state]) for state in (found["start"], state))
            assert abs(first - last) < mpf(10) ** -28
        answer = times[-1:] or state
        return {**found, "events": len(times), "answer": [nstr(x, PRINTED) for x in answer]}
