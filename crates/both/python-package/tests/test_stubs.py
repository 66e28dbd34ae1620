"""The stub of the native module has everything that the module has, and nothing else."""

import ast
import doctest
import importlib.util
import inspect
from pathlib import Path

import passive_hopper
import pytest
import nonsmooth
from nonsmooth import _native, hybrid, labelling
from passive_hopper import datasets, motions

STUB = ast.parse((Path(nonsmooth.__file__).parent / "_native.pyi").read_text())
CLASSES = {node.name: node for node in STUB.body if isinstance(node, ast.ClassDef)}


def names(body):
    found = set()
    for node in body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            found.add(node.name)
        elif isinstance(node, ast.AnnAssign):
            found.add(node.target.id)
    return found


def public(names):
    return {name for name in names if not name.startswith("_")}


def arguments(function):
    own = function.args
    return [arg.arg for arg in own.posonlyargs + own.args + own.kwonlyargs if arg.arg not in ("self", "cls")]


def test_the_stub_has_all_names_of_the_module():
    assert public(names(STUB.body)) == public(vars(_native)) - {"annotations"}


@pytest.mark.parametrize("name", sorted(CLASSES))
def test_the_stub_of_a_class_has_all_its_names(name):
    own = getattr(_native, name)
    assert public(names(CLASSES[name].body)) == public(vars(own))


def signatures():
    for node in STUB.body:
        if isinstance(node, ast.FunctionDef) and not node.decorator_list:
            yield node.name, node, getattr(_native, node.name)
        for method in node.body if isinstance(node, ast.ClassDef) else []:
            plain = (
                isinstance(method, ast.FunctionDef) and not method.decorator_list and not method.name.startswith("_")
            )
            if plain:
                yield f"{node.name}.{method.name}", method, getattr(getattr(_native, node.name), method.name)
            elif isinstance(method, ast.FunctionDef) and method.name == "__init__":
                yield node.name, method, getattr(_native, node.name)


@pytest.mark.parametrize(
    "name, stub, function", list(signatures()), ids=lambda part: part if isinstance(part, str) else ""
)
def test_arguments_have_the_names_of_the_module(name, stub, function):
    found = [parameter for parameter in inspect.signature(function).parameters if parameter != "self"]
    assert arguments(stub) == found


def test_docstrings_of_the_stub_are_those_of_the_module():
    place = Path(__file__).resolve().parents[4] / "xtask/generators/stub_docs.py"
    spec = importlib.util.spec_from_file_location("stub_docs", place)
    generator = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(generator)
    text = generator.STUB.read_text()
    assert generator.documented(text, _native) == text, "python xtask/generators/stub_docs.py renews them"


@pytest.mark.parametrize("module", [passive_hopper, nonsmooth, hybrid, labelling])
def test_every_public_name_is_documented(module):
    for name in module.__all__:
        own = getattr(module, name)
        if not isinstance(own, int):
            assert own.__doc__, name


@pytest.mark.parametrize("place", [passive_hopper, nonsmooth, nonsmooth.systems, nonsmooth.runs, nonsmooth.returns, nonsmooth.basins, nonsmooth.boundaries, nonsmooth.stability, nonsmooth.along, datasets, hybrid, labelling, motions, *(getattr(_native, name) for name in sorted(public(vars(_native))) if getattr(_native, name).__doc__)], ids=lambda place: place.__name__ if hasattr(place, "__name__") else "constant")  # fmt: skip
def test_examples_run(place):
    pytest.importorskip("xarray")
    if isinstance(place, int):
        return
    for test in doctest.DocTestFinder(recurse=False).find(place, place.__name__, globs={}):
        assert doctest.DocTestRunner().run(test).failed == 0, test.name
    if inspect.ismodule(place):
        for name, own in vars(place).items():
            if inspect.isfunction(own) and own.__module__ == place.__name__:
                for test in doctest.DocTestFinder(recurse=False).find(own, name, globs={}):
                    assert doctest.DocTestRunner().run(test).failed == 0, name
