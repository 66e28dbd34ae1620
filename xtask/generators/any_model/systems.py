"""The models of certificates: systems with modes and guards, and maps."""

import re

from certificate_file import Refuted

from .flows import Field
from .formulas import Balls, check_names, constant, polynomial, read, substituted
from .sets import column, list_of


# How often a box is halved on which a condition may be 0: balls are wider than what they hold, the less so the narrower they are.
HALVINGS = 6
LABEL = re.compile(r"[^\W\d][\w -]*")


def halves(hull):
    """The two halves of a hull along its widest side."""
    own = list_of(hull)
    widest = max(range(len(own)), key=lambda axis: float(own[axis].rad()))
    low, middle, high = own[widest].lower(), own[widest].mid(), own[widest].upper()
    return [column([*own[:widest], side, *own[widest + 1 :]]) for side in (low.union(middle), middle.union(high))]


def check_label(label):
    """Refuses what is no name of a mode or a surface: letters, digits, spaces and signs, with a letter first."""
    if not isinstance(label, str) or not LABEL.fullmatch(label):
        raise Refuted(f"{label!r} names no mode and no surface")


def at(list_, place):
    """The entry of a list at a place of a line, which counts from 0."""
    if type(place) is not int or not 0 <= place < len(list_):
        raise Refuted(f"{place!r} is the place of nothing")
    return list_[place]


class Guard:
    """A surface of a mode."""

    def __init__(self, line):
        self.surface = line["surface"]
        check_label(self.surface)
        self.text, self.tree = line["guard"], read(line["guard"])
        self.side_after = line["side_after"]
        if self.side_after not in (1.0, -1.0, None):
            raise Refuted(f"no direction of {self.surface}: {self.side_after!r}")
        self.bounds_flow, self.stops = line["bounds_flow"], line["stops"]
        if not isinstance(self.bounds_flow, bool) or not isinstance(self.stops, bool):
            raise Refuted(f"{self.surface} neither bounds its flow nor does not")
        self.condition = None if line["condition"] is None else read(line["condition"])
        self.mode = line["mode"]
        self.after = None if line["after"] is None else [read(text) for text in line["after"]]

    def observes(self, own_mode):
        """True if its events change nothing."""
        return not (self.stops or self.bounds_flow) and self.mode == own_mode and self.after is None


class System:
    """A hybrid system. The time and parameters that are intervals are components of the state."""

    def __init__(self, line):
        self.states = line["states"]
        self.line = line
        names = [name for name, _ in line["parameters"]]
        check_names(names)
        check_names(self.states, names)
        self.trees = {name: read(text) for name, text in line["parameters"]}
        self.parameters = {name: constant(tree) for name, tree in self.trees.items()}
        self.fields, self.guards = {}, {}
        for mode in line["modes"]:
            name, field = mode["mode"], [read(text) for text in mode["field"]]
            check_label(name)
            if name in self.fields or len(field) != len(self.states):
                raise Refuted(f"the mode {name} stands twice, or has another number of rates than states")
            self.fields[name] = Field(self.states, self.parameters, field)
            self.guards[name] = [Guard(guard) for guard in mode["guards"]]
        for guard in (guard for guards in self.guards.values() for guard in guards):
            if guard.mode not in self.fields or guard.after is not None and len(guard.after) != len(self.states):
                raise Refuted(f"{guard.surface} leads to no mode, or to another number of states")

    def vanishes(self, tree):
        """True if a formula is 0 for all values of its variables."""
        return not polynomial(substituted(tree, self.trees))

    def begins_on(self, guard):
        """For each guard of the mode after an event, whether it is 0 at all states after it because this guard was."""
        after = dict(zip(self.states, guard.after)) if guard.after is not None else {}
        own = guard.tree
        found = []
        for other in self.guards[guard.mode]:
            composed = substituted(other.tree, after)
            found.append(self.vanishes(composed) or self.vanishes(("-", composed, own)))
        return found

    def text(self):
        """The equations, in a line."""
        modes = "; ".join(
            f"{mode['mode']}: "
            + ", ".join(f"{x}' = {text}" for x, text in zip(self.states, mode["field"]))
            + "".join(f", {guard_text(guard)}" for guard in mode["guards"])
            for mode in self.line["modes"]
        )
        return modes + with_parameters(self.line["parameters"])


def guard_text(line):
    """A guard, in words."""
    way = {1.0: "rises through", -1.0: "falls through", None: "is"}[line["side_after"]]
    text = f"{line['surface']} where {line['guard']} {way} 0"
    if line["condition"] is not None:
        text += f" if {line['condition']} > 0"
    if line["stops"]:
        return text + " stops"
    if line["after"] is not None:
        text += f" sets ({', '.join(line['after'])})"
    return text + f" in {line['mode']}" + (", which it bounds" if line["bounds_flow"] else "")


def with_parameters(parameters):
    return " with " + ", ".join(f"{name} = {text}" for name, text in parameters) if parameters else ""


class SectionMap:
    """From a chart to the states after an event, of which formulas are read."""

    def __init__(self, line, systems):
        self.system, self.line, self.number = at(systems, line["system"]), line, line["system"]
        self.mode, self.variables = line["mode"], line["variables"]
        check_names(self.variables, self.system.trees)
        if self.mode not in self.system.fields or len(line["states"]) != len(self.system.states):
            raise Refuted("a chart without its mode, or with another number of states")
        self.states = [read(text) for text in line["states"]]
        self.surface, self.count = line["surface"], line["count"]
        surfaces = [guard.surface for guards in self.system.guards.values() for guard in guards]
        if self.surface not in surfaces:
            raise Refuted(f"no surface {self.surface!r}")
        if type(self.count) is not int or self.count < 1:
            raise Refuted(f"{self.count!r} events")
        self.read = [read(text) for text in line["read"]]
        self.dimension = len(self.read)
        if self.dimension > len(self.variables):
            raise Refuted("more is read than there are variables")
        self.chart = Field(self.variables, self.system.parameters, self.states)
        self.end = Field(self.system.states, self.system.parameters, self.read)
        chart = dict(zip(self.system.states, self.states))
        self.on = [self.system.vanishes(substituted(guard.tree, chart)) for guard in self.system.guards[self.mode]]

    def text(self):
        return (
            f"of system {self.number} from mode {self.mode}, ({', '.join(self.system.states)}) = ({', '.join(self.line['states'])}) to event {self.count} of"
            f" {self.surface}, read as ({', '.join(self.line['read'])})"
        )


class FormulaMap:
    """A map that is formulas, applied some times."""

    def __init__(self, line, _systems):
        self.variables, self.line = line["variables"], line
        trees = {name: read(text) for name, text in line["parameters"]}
        check_names([name for name, _ in line["parameters"]])
        check_names(self.variables, trees)
        self.formulas = [read(text) for text in line["formulas"]]
        self.dimension, self.times = line["dimension"], line["times"]
        if len(self.formulas) != len(self.variables) or not 0 < self.dimension <= len(self.variables):
            raise Refuted("a map with another number of formulas than variables")
        if type(self.times) is not int or self.times < 1:
            raise Refuted(f"a map that is applied {self.times!r} times")
        if any(self.formulas[k] != ("name", self.variables[k]) for k in range(self.dimension, len(self.variables))):
            raise Refuted("parameters that do not stay what they are")
        self.field = Field(self.variables, {name: constant(tree) for name, tree in trees.items()}, self.formulas)
        self.sets = {}
        for own in line.get("sets", []):
            if not isinstance(own, list) or len(own) != 2 or not isinstance(own[1], list):
                raise Refuted(f"{own!r} is no set: a name, and a list of formulas")
            name, conditions = own
            check_label(name)
            if name in self.sets or not conditions or not all(isinstance(text, str) for text in conditions):
                raise Refuted(f"the set {name} stands twice, or has no conditions that are texts")
            self.sets[name] = [read(text) for text in conditions]

    def conditions_at(self, name, hull):
        """The values of the conditions of a set at all points of a hull."""
        if name not in self.sets:
            raise Refuted(f"no set {name!r}")
        return self.field.values(self.sets[name], list_of(hull), Balls)

    def holds(self, name, hull, halvings=HALVINGS):
        """True if all points of a hull are in a set, for certain."""
        if all(value > 0 for value in self.conditions_at(name, hull)):
            return True
        return halvings > 0 and all(self.holds(name, half, halvings - 1) for half in halves(hull))

    def set_of(self, hull):
        """The first set that holds all points of a hull, or None."""
        return next((name for name in self.sets if self.holds(name, hull)), None)

    def text(self):
        formulas = ", ".join(self.line["formulas"])
        sets = "".join(
            f', "{name}": where ' + " and ".join(f"{text} > 0" for text in conditions) for name, conditions in self.line.get("sets", [])
        )
        return f"({', '.join(self.variables)}) -> ({formulas}), {self.times} times{with_parameters(self.line['parameters'])}{sets}"
