"""Constants of the Rust sources, found by name in whichever file they stand."""

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
NUMBER = re.compile(r"(?<![\w.])-?\s?(?:0x[0-9a-fA-F_]+|\d[\d_]*(?:\.[\d_]*)?(?:e-?\d+)?)")


def constant(name, kind, crate):
    """The text on the right of `const NAME: … kind … =`, without comments."""
    pattern = re.compile(rf"\bconst {name}\s*:[^=]*{kind}[^=]*=(.*?);", re.S)
    found = []
    for path in sorted((ROOT / "crates").glob(f"*/{crate}/src/**/*.rs")):
        source = re.sub(r"//[^\n]*", "", path.read_text(encoding="utf-8"))
        # The length of an array type has a semicolon, and stands before the equals sign.
        found += pattern.findall(source)
    if len(found) != 1:
        raise LookupError(f"the sources of {crate} have {len(found)} constants {name}; the generator needs exactly one")
    return found[0]


def numbers(name, kind="f64", crate="passive-hopper"):
    """The numbers of a constant, in their order: whole numbers as int, others as float."""
    values = []
    for token in NUMBER.findall(constant(name, kind, crate)):
        token = token.replace("_", "").replace(" ", "")
        whole = re.fullmatch(r"-?(?:0x[0-9a-fA-F]+|\d+)", token)
        values.append(int(token, 0) if whole else float(token))
    return values
