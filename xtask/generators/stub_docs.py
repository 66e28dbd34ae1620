"""Writes the docstrings of the native module into its stub, where editors look for them: `python stub_docs.py [--check]`.

It needs the package installed. With --check it changes nothing, and ends with 1 if the stub is not up to date.
"""

import ast
import inspect
import sys
from pathlib import Path

STUB = Path(__file__).resolve().parents[2] / "crates/both/python-package/python/nonsmooth/_native.pyi"


def documented(text, module):
    """The text of a stub with the docstrings of a module. Those that it has already are replaced."""
    tree = ast.parse(text)
    lines = text.split("\n")
    # From the end, so that line numbers stay right.
    for node, found in reversed(list(_pairs(tree.body, module))):
        doc = inspect.cleandoc(found.__doc__ or "")
        # What Python itself says of any object that can be called.
        doc = "" if doc == "Call self as a function." else doc
        _write(lines, node, doc)
    return "\n".join(lines)


def _pairs(body, owner):
    """The classes and functions of a stub, each with the object of the module. Of overloads the first one is documented."""
    seen = set()
    for node in body:
        if not isinstance(node, (ast.ClassDef, ast.FunctionDef)) or node.name in seen or (node.name.startswith("_") and node.name != "__call__"):
            continue
        seen.add(node.name)
        found = inspect.getattr_static(owner, node.name, None)
        found = getattr(found, "__func__", found)
        if found is None:
            continue
        yield node, found
        if isinstance(node, ast.ClassDef):
            yield from _pairs(node.body, getattr(owner, node.name))


def _write(lines, node, doc):
    """Puts a docstring at the beginning of a body."""
    first = node.body[0]
    has_doc = isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant) and isinstance(first.value.value, str)
    indent = " " * (node.col_offset + 4)
    new = _literal(doc, indent) if doc else []
    if has_doc:
        end = first.end_lineno
        rest = node.body[1:]
        if not new and not rest and lines[first.lineno - 2].rstrip().endswith(":"):
            lines[first.lineno - 2 : end] = [f"{lines[first.lineno - 2].rstrip()} ..."]
            return
        lines[first.lineno - 1 : end] = new or ([] if rest else [f"{indent}..."])
        return
    if not new:
        return
    is_dots = isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant) and first.value.value is ...
    if is_dots and first.lineno == node.body[-1].lineno and lines[first.lineno - 1].rstrip().endswith(": ..."):
        line = lines[first.lineno - 1]
        lines[first.lineno - 1 : first.lineno] = [line.rstrip()[: -len(" ...")], *new]
    else:
        begin = min(own.lineno for own in (first, *getattr(first, "decorator_list", [])))
        lines[begin - 1 : begin - 1] = new


def _literal(doc, indent):
    """A docstring as lines of source."""
    escaped = doc.replace("\\", "\\\\").replace('"""', '\\"\\"\\"')
    own = escaped.split("\n")
    if len(own) == 1 and not own[0].endswith('"'):
        return [f'{indent}"""{own[0]}"""']
    return [f'{indent}"""{own[0]}', *(f"{indent}{line}".rstrip() for line in own[1:]), f'{indent}"""']


def main(arguments):
    from nonsmooth import _native

    text = STUB.read_text()
    new = documented(text, _native)
    if new == text:
        return 0
    if "--check" in arguments:
        print(f"{STUB} has other docstrings than the native module: python xtask/generators/stub_docs.py renews them")
        return 1
    STUB.write_text(new)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
