"""The C header after a preprocessor is what readers of C declarations take."""

import subprocess
from pathlib import Path

import cffi
import pytest

HEADER = Path(__file__).parents[2] / "include" / "cagedyn.h"


def preprocessed():
    return subprocess.run(["cc", "-E", "-P", str(HEADER)], check=True, capture_output=True, text=True).stdout


def test_pycparser():
    pycparser = pytest.importorskip("pycparser")
    names = [
        node.name
        for node in pycparser.CParser().parse(preprocessed()).ext
        if isinstance(node, pycparser.c_ast.Decl) and node.name.startswith("cagedyn_")
    ]
    assert len(names) == len(set(names)) > 90


def test_cffi():
    text = preprocessed()
    ffi = cffi.FFI()
    ffi.cdef(text[text.index("typedef struct cagedyn_") :])
    assert ffi.typeof("cagedyn_sim *").kind == "pointer"
