"""The exceptions of these packages: one family, each also of the kind that Python has for it."""


class NonsmoothError(Exception):
    """The base of all exceptions of `nonsmooth` and `passive_hopper`, but for TypeErrors of arguments and what a function of the caller raises."""


class InputError(NonsmoothError, ValueError):
    """An argument has a value that makes no sense. The message has the value, and says which ones do."""


class ComputationError(NonsmoothError, ArithmeticError):
    """A computation cannot go on: a value is not finite, or a limit is reached. The message says where."""


class UndecidedError(ComputationError):
    """What happens cannot be decided: a hop with 1024 bits, or an event of a hybrid system that rounding hides."""


class TracingError(NonsmoothError, TypeError):
    """A function has no formulas: it asks for the value of a symbol, or calls what formulas do not have."""
