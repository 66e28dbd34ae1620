"""Numbers with their derivatives with respect to some variables, over any numbers that have functions."""

from flint import arb_series

from certificate_file import Unconfirmed

from .formulas import Balls


class Dual:
    """A value and its derivatives."""

    __slots__ = ("value", "parts")

    def __init__(self, value, parts):
        self.value, self.parts = value, parts

    def __neg__(self):
        return Dual(-self.value, [-part for part in self.parts])

    def __add__(self, other):
        if isinstance(other, Dual):
            return Dual(self.value + other.value, [a + b for a, b in zip(self.parts, other.parts)])
        return Dual(self.value + other, self.parts)

    def __sub__(self, other):
        if isinstance(other, Dual):
            return Dual(self.value - other.value, [a - b for a, b in zip(self.parts, other.parts)])
        return Dual(self.value - other, self.parts)

    def __mul__(self, other):
        if self is other:
            return Dual(self.value * self.value, [2 * self.value * part for part in self.parts])
        if isinstance(other, Dual):
            parts = [a * other.value + self.value * b for a, b in zip(self.parts, other.parts)]
            return Dual(self.value * other.value, parts)
        return Dual(self.value * other, [part * other for part in self.parts])

    def __radd__(self, other):
        return self + other

    def __rsub__(self, other):
        return -self + other

    def __rmul__(self, other):
        return self * other


class Duals:
    """Functions of duals over a kind of numbers."""

    def __init__(self, kind):
        self.kind = kind

    def number(self, value):
        return self.kind.number(value)

    def function(self, name, x):
        if not isinstance(x, Dual):
            return self.kind.function(name, x)
        f, q = self.kind.function, self.kind.quotient
        one = x.value * 0 + 1
        value = f(name, x.value)
        rate = {
            "sqrt": lambda: q(one, 2 * value),
            "exp": lambda: value,
            "ln": lambda: q(one, x.value),
            "sin": lambda: f("cos", x.value),
            "cos": lambda: -f("sin", x.value),
            "tan": lambda: 1 + value * value,
            "asin": lambda: q(one, f("sqrt", 1 - x.value * x.value)),
            "acos": lambda: -q(one, f("sqrt", 1 - x.value * x.value)),
            "atan": lambda: q(one, 1 + x.value * x.value),
            "sinh": lambda: f("cosh", x.value),
            "cosh": lambda: f("sinh", x.value),
            "tanh": lambda: 1 - value * value,
            "sech": lambda: -value * f("tanh", x.value),
            "asinh": lambda: q(one, f("sqrt", 1 + x.value * x.value)),
            "acosh": lambda: q(one, f("sqrt", x.value * x.value - 1)),
            "atanh": lambda: q(one, 1 - x.value * x.value),
        }[name]()
        return Dual(value, [rate * part for part in x.parts])

    def quotient(self, a, b):
        if not isinstance(b, Dual):
            if not isinstance(a, Dual):
                return self.kind.quotient(a, b)
            return Dual(self.kind.quotient(a.value, b), [self.kind.quotient(part, b) for part in a.parts])
        top = a.value if isinstance(a, Dual) else a
        value = self.kind.quotient(top, b.value)
        own = a.parts if isinstance(a, Dual) else [0] * len(b.parts)
        return Dual(value, [self.kind.quotient(p - value * r, b.value) for p, r in zip(own, b.parts)])


class Series:
    """Power series in balls. Numbers may stand among them."""

    @staticmethod
    def number(value):
        return value

    @staticmethod
    def function(name, x):
        if not isinstance(x, arb_series):
            return Balls.function(name, x)
        if name in ("sinh", "cosh", "tanh", "sech"):
            up = Series.function("exp", x)
            down = Series.quotient(up * 0 + 1, up)
            sine, cosine = (up - down) / 2, (up + down) / 2
            return {
                "sinh": lambda: sine,
                "cosh": lambda: cosine,
                "tanh": lambda: Series.quotient(sine, cosine),
                "sech": lambda: Series.quotient(cosine * 0 + 1, cosine),
            }[name]()
        if name in ("asinh", "acosh", "atanh"):
            log = lambda y: Series.function("ln", y)
            if name == "atanh":
                return (log(1 + x) - log(1 - x)) / 2
            return log(x + Series.function("sqrt", x * x + (1 if name == "asinh" else -1)))
        Balls.function(name, x[0])
        return getattr(x, {"ln": "log"}.get(name, name))()

    @staticmethod
    def quotient(a, b):
        first = b[0] if isinstance(b, arb_series) else b
        if not (first != 0):
            raise Unconfirmed(f"a division by {first}")
        return a / b
