"""Reading certificates: lines of JSON, each key once, all numbers finite, all bytes in a digest."""

import json
import math


class Refuted(Exception):
    """What the certificate says is false."""


class Unconfirmed(Exception):
    """The checker cannot confirm what the certificate says."""


class Undecided(Exception):
    """A sign that the balls leave open: with narrower or longer numbers it may be decided."""


def once(pairs):
    """An object whose keys differ: of two equal ones a reader may take either."""
    found = dict(pairs)
    if len(found) < len(pairs):
        raise ValueError("a key stands twice")
    return found


def finite(text):
    number = float(text)
    if not math.isfinite(number):
        raise ValueError(f"{text} is no number of a certificate")
    return number


def no_constant(text):
    raise ValueError(f"{text} is no number of a certificate")


def format_of(path):
    """What the first line of a file says that it is, or None."""
    with open(path, "rb") as file:
        try:
            header = json.loads(file.readline().decode("utf-8"))
            return header.get("format") if isinstance(header, dict) else None
        except ValueError:
            return None


def lines_of(path, digest, wrong_field):
    """The header, then (number of the line, object). All bytes go into the digest. `wrong_field` says why fields are wrong, or None."""
    with open(path, "rb") as file:
        for number, text in enumerate(file, 1):
            digest.update(text)
            try:
                line = json.loads(
                    text.decode("utf-8"), object_pairs_hook=once, parse_float=finite, parse_constant=no_constant
                )
            except (ValueError, RecursionError) as error:
                raise Refuted(f"line {number}: no JSON ({error})")
            if not isinstance(line, dict):
                raise Refuted(f"line {number}: no object")
            kind = None if number == 1 else line.get("kind")
            if number > 1 and not isinstance(kind, str):
                raise Refuted(f"line {number}: its kind is no text")
            wrong = wrong_field(kind, line)
            if wrong:
                raise Refuted(f"line {number}: {wrong}")
            yield number, line


def guarded(number, action, *arguments):
    """`action`, whose errors then name the line."""
    try:
        return action(*arguments)
    except (Refuted, Unconfirmed, Undecided) as error:
        raise type(error)(f"line {number}: {error}")
    except (KeyError, TypeError, ValueError, ArithmeticError, IndexError, AttributeError, RecursionError) as error:
        raise Refuted(f"line {number}: a field is missing or wrong ({type(error).__name__}: {error})")
