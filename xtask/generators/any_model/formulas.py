"""Formulas as texts: read into trees, evaluated with any numbers, and compared as polynomials.

A tree is ("number", text), ("name", name), ("negative", a), (operator, a, b) with one of + - * / ^, ("power", a, n) with an
integer n, or (function, a).
"""

import math
import re
from fractions import Fraction

from flint import acb, arb

from certificate_file import Refuted, Unconfirmed

TOKEN = re.compile(
    r" *(?:(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)|(?P<name>[^\W\d]\w*)|(?P<sign>\*\*|[-+*/^(),]))"
)
FUNCTIONS = (
    "sqrt exp ln sin cos tan asin acos atan sinh cosh tanh sech asinh acosh atanh abs sign atan2 min max f64".split()
)
# A power with a larger exponent is not written out as a product.
LARGEST_POWER = 64


def read(text):
    """The tree of a text."""
    if not isinstance(text, str):
        raise Refuted(f"{text!r} is no formula")
    tokens, at = [], 0
    text = text.rstrip()
    while at < len(text):
        match = TOKEN.match(text, at)
        if match is None:
            raise Refuted(f"no formula: {text!r}, at {text[at:at + 10]!r}")
        tokens.append((match.lastgroup, match[match.lastgroup]))
        at = match.end()
    reader = _Reader(tokens, text)
    tree = reader.sum()
    if reader.at < len(tokens):
        raise Refuted(f"no formula: {text!r}, which has more behind its end")
    return tree


class _Reader:
    def __init__(self, tokens, text):
        self.tokens, self.text, self.at = tokens, text, 0

    def sign(self, *wanted):
        """The next token, if it is one of these signs."""
        if self.at < len(self.tokens) and self.tokens[self.at][0] == "sign" and self.tokens[self.at][1] in wanted:
            self.at += 1
            return self.tokens[self.at - 1][1]
        return None

    def need(self, sign):
        if not self.sign(sign):
            raise Refuted(f"no formula: {self.text!r} has no {sign!r} where one belongs")

    def sum(self):
        tree = self.product()
        while sign := self.sign("+", "-"):
            tree = (sign, tree, self.product())
        return tree

    def product(self):
        tree = self.signed()
        while sign := self.sign("*", "/"):
            tree = (sign, tree, self.signed())
        return tree

    def signed(self):
        if self.sign("-"):
            return ("negative", self.signed())
        if self.sign("+"):
            return self.signed()
        return self.power()

    def power(self):
        tree = self.operand()
        if self.sign("^", "**"):
            exponent = self.signed()
            n = whole(exponent)
            return ("^", tree, exponent) if n is None else ("power", tree, n)
        return tree

    def operand(self):
        if self.sign("("):
            tree = self.sum()
            self.need(")")
            return tree
        if self.at == len(self.tokens):
            raise Refuted(f"no formula: {self.text!r} ends too soon")
        kind, word = self.tokens[self.at]
        self.at += 1
        if kind == "number":
            return ("number", word)
        if kind != "name":
            raise Refuted(f"no formula: {self.text!r}, at {word!r}")
        if word not in FUNCTIONS:
            return ("name", word)
        self.need("(")
        tree = self.sum()
        self.need(")")
        if word == "f64":
            return ("double", tree)
        return (word, tree)


CONSTANTS = ("pi", "π", "e")
NAME = re.compile(r"[^\W\d]\w*")


def check_names(names, others=()):
    """Refuses names that are none, that stand twice, or that mean something else already: a function, a constant, one of `others`."""
    for place, name in enumerate(names):
        if not isinstance(name, str) or not NAME.fullmatch(name):
            raise Refuted(f"{name!r} is no name")
        if name in FUNCTIONS or name in CONSTANTS or name in names[:place] or name in others:
            raise Refuted(f"the name {name} has another meaning")


def substituted(tree, values):
    """The tree with trees in the place of names."""
    if tree[0] == "name":
        return values.get(tree[1], tree)
    if tree[0] == "number":
        return tree
    if tree[0] == "power":
        return ("power", substituted(tree[1], values), tree[2])
    return (tree[0], *(substituted(part, values) for part in tree[1:]))


def constant(tree):
    """The value of a formula without names, as a ball."""
    return Program([tree], [], {}).run([], Balls)[0]


class Balls:
    """Real numbers in balls."""

    @staticmethod
    def number(value):
        return value

    @staticmethod
    def function(name, x):
        found = {
            "sqrt": "sqrt", "exp": "exp", "ln": "log", "sin": "sin", "cos": "cos", "tan": "tan", "asin": "asin",
            "acos": "acos", "atan": "atan", "sinh": "sinh", "cosh": "cosh", "tanh": "tanh", "sech": "sech",
            "asinh": "asinh", "acosh": "acosh", "atanh": "atanh",
        }.get(name)
        if found is None:
            raise Unconfirmed(f"no derivatives of {name}")
        value = getattr(x, found)()
        if not value.is_finite():
            raise Unconfirmed(f"{name} of {x} has no value")
        return value

    @staticmethod
    def quotient(a, b):
        value = a / b
        if not value.is_finite():
            raise Unconfirmed(f"a division by {b}")
        return value


class Complex(Balls):
    """Complex numbers in balls, on which functions are analytic: no branch cut and no pole is met."""

    @staticmethod
    def number(value):
        return acb(value)

    @staticmethod
    def function(name, x):
        if name in ("sqrt", "ln"):
            value = x.sqrt(analytic=True) if name == "sqrt" else x.log(analytic=True)
        elif name in ("exp", "sin", "cos", "tan", "sinh", "cosh", "tanh", "sech"):
            value = getattr(x, name)()
        else:
            # The cuts of these lie on the axes, at a distance of at least 1 from 0.
            inside = {"asin": x.real, "acos": x.real, "atanh": x.real, "atan": x.imag, "asinh": x.imag}.get(name)
            if inside is None or not abs(inside) < 1:
                raise Unconfirmed(f"{name} of {x} may have a cut")
            value = getattr(x, name)()
        if not value.is_finite():
            raise Unconfirmed(f"{name} of {x} has no bound")
        return value


class Program:
    """Trees as a list of operations, in which equal parts stand once and constants are computed once."""

    def __init__(self, trees, variables, constants):
        self.operations, self.known, self.places = [], {}, {}
        self.variables, self.constants = {name: place for place, name in enumerate(variables)}, constants
        self.outputs = [self._place(tree) for tree in trees]

    def _place(self, tree):
        """The place of a part among the operations."""
        name = tree[0]
        if name == "number":
            return self._constant(arb(tree[1]), tree)
        if name == "double":
            sign, number = (-1, tree[1][1]) if tree[1][0] == "negative" else (1, tree[1])
            if number[0] != "number":
                raise Refuted("f64 of no number")
            value = sign * float(number[1])
            if not math.isfinite(value):
                raise Refuted(f"f64({number[1]}) is no number")
            return self._constant(arb(value), tree)
        if name == "name":
            if tree[1] in self.variables:
                return self._new(("variable", self.variables[tree[1]]))
            known = {"pi": arb.pi, "π": arb.pi, "e": arb.const_e}
            if tree[1] in self.constants:
                return self._constant(self.constants[tree[1]], tree)
            if tree[1] in known:
                return self._constant(known[tree[1]](), tree)
            raise Refuted(f"no variable or parameter has the name {tree[1]}")
        if name == "power":
            parts = (self._place(tree[1]),)
            operation = ("power", *parts, tree[2])
        else:
            parts = tuple(self._place(part) for part in tree[1:])
            operation = (name, *parts)
        if all(part in self.known for part in parts):
            return self._constant(_value(operation, self.known, Balls), operation)
        return self._new(operation)

    def _constant(self, value, key):
        place = self._new(("constant", key))
        self.known[place] = value
        return place

    def _new(self, operation):
        if operation not in self.places:
            self.places[operation] = len(self.operations)
            self.operations.append(operation)
        return self.places[operation]

    def run(self, x, kind):
        """The values of the trees for values of the variables."""
        found = []
        for place, operation in enumerate(self.operations):
            if place in self.known:
                found.append(kind.number(self.known[place]))
            elif operation[0] == "variable":
                found.append(x[operation[1]])
            else:
                found.append(_value(operation, found, kind))
        return [found[place] for place in self.outputs]


def _value(operation, found, kind):
    """The value of an operation on values before it."""
    name, a = operation[0], found[operation[1]]
    if name == "power":
        return power(a, operation[2], kind)
    if name == "negative":
        return -a
    if len(operation) == 2:
        return kind.function(name, a)
    b = found[operation[2]]
    if name == "+":
        return a + b
    if name == "-":
        return a - b
    if name == "*":
        return a * b
    if name == "/":
        return kind.quotient(a, b)
    return kind.function("exp", b * kind.function("ln", a))


def whole(tree):
    """The integer that a tree is, or None."""
    if tree[0] == "negative":
        below = whole(tree[1])
        return None if below is None else -below
    if tree[0] == "number" and Fraction(tree[1]).denominator == 1 and abs(Fraction(tree[1])) <= LARGEST_POWER:
        return int(Fraction(tree[1]))
    return None


def power(a, exponent, kind):
    if exponent < 0:
        return kind.quotient(kind.number(arb(1)), power(a, -exponent, kind))
    if exponent == 0:
        return a * 0 + 1
    half = power(a, exponent // 2, kind) if exponent > 1 else None
    square = half * half if half is not None else None
    if exponent == 1:
        return a
    return square * a if exponent % 2 else square


def polynomial(tree):
    """The normal form of a tree: {monomial: coefficient}, with what is no polynomial as variables of their own."""
    name = tree[0]
    if name == "number":
        return _cleared({(): Fraction(tree[1])})
    if name == "name":
        return {((tree[1], 1),): Fraction(1)}
    if name == "negative":
        return {monomial: -factor for monomial, factor in polynomial(tree[1]).items()}
    if name in "+-" and len(tree) == 3:
        found = dict(polynomial(tree[1]))
        sign = 1 if name == "+" else -1
        for monomial, factor in polynomial(tree[2]).items():
            found[monomial] = found.get(monomial, 0) + sign * factor
        return _cleared(found)
    if name == "*":
        return _times(polynomial(tree[1]), polynomial(tree[2]))
    if name == "/":
        below = polynomial(tree[2])
        if set(below) == {()}:
            return _times(polynomial(tree[1]), {(): 1 / below[()]})
        return _times(polynomial(tree[1]), {((("inverse", _key(below)), 1),): Fraction(1)})
    if name == "power":
        found = {(): Fraction(1)}
        for _ in range(abs(tree[2])):
            found = _times(found, polynomial(tree[1]))
        return found if tree[2] >= 0 else {((("inverse", _key(found)), 1),): Fraction(1)}
    return {(((name, *(_key(polynomial(part)) for part in tree[1:])), 1),): Fraction(1)}


def _times(a, b):
    found = {}
    for own, factor in a.items():
        for other, by in b.items():
            powers = dict(own)
            for variable, exponent in other:
                powers[variable] = powers.get(variable, 0) + exponent
            monomial = tuple(sorted(powers.items(), key=repr))
            found[monomial] = found.get(monomial, 0) + factor * by
    return _cleared(found)


def _cleared(found):
    return {monomial: factor for monomial, factor in found.items() if factor != 0}


def _key(found):
    return tuple(sorted(found.items(), key=repr))
