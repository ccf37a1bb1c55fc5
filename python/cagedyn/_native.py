"""The shared library: loaded, declared by its own header, its failures as exceptions."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Any

import cffi  # type: ignore[import-untyped]
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def _declarations() -> str:
    """What the header declares, without what is for a preprocessor or C++."""
    text = Path(__file__).with_name("cagedyn.h").read_text(encoding="utf-8")
    text = re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)
    text = re.sub(r"#ifdef __cplusplus.*?#endif", "", text, flags=re.DOTALL)
    constants = re.findall(r"#define (CAGEDYN_\w+) (-?\d+)", text)
    plain = "\n".join(line for line in text.splitlines() if not line.startswith("#"))
    return plain + "\n".join(f"#define {name} {value}" for name, value in constants)


def _path() -> str:
    chosen = os.environ.get("CAGEDYN_LIBRARY")
    if chosen:
        return chosen
    # Its ending is that of the system, whatever the Python that built it.
    for path in Path(__file__).parent.glob("_library.*"):
        return str(path)
    raise ImportError("the library of cagedyn is not installed: pip install ./python, or set CAGEDYN_LIBRARY")


ffi = cffi.FFI()
ffi.cdef(_declarations())
lib: Any = ffi.dlopen(_path())


def text(pointer: Any) -> str:
    """A string of the library."""
    return str(ffi.string(pointer).decode())


def version() -> str:
    """Version of the library that is loaded."""
    return text(lib.cagedyn_version())


class Error(Exception):
    """A call that the library refused or could not finish: a one-line message that names the place, the value and what is allowed."""

    def __init__(self, status: int, message: str) -> None:
        super().__init__(message)
        #: Its code, one of `CAGEDYN_ERR_...`.
        self.status = status
        #: Its name, for example "ERR_BAD_SCENE".
        self.name = text(lib.cagedyn_status_name(status))

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.status, str(self)), self.__dict__

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.name}, {str(self)!r})"


def last_error() -> Error:
    """The failure of the last call in this thread."""
    return Error(lib.cagedyn_error_status(), text(lib.cagedyn_error_message()))


def check(status: int) -> None:
    """Raises the failure of a call that returned its status."""
    if status != 0:
        raise last_error()


def counted(count: int) -> int:
    """The count or index that a call returned, or its failure."""
    if count < 0:
        raise last_error()
    return int(count)


def made(handle: Any, free: Any) -> Any:
    """A handle that is freed with its last reference, or the failure of what should have made it."""
    if handle == ffi.NULL:
        raise last_error()
    return ffi.gc(handle, free)


def numbers(array: Any) -> tuple[Any, int, Array]:
    """Pointer and length of a row of numbers, and what keeps them alive."""
    array = np.ascontiguousarray(array, dtype=np.float64)
    if array.ndim != 1:
        raise ValueError(f"an array of one dimension is needed, not one of shape {array.shape}")
    return ffi.cast("double *", array.ctypes.data), array.size, array


def filled(count: int, fill: Any) -> Array:
    """`count` numbers that `fill(pointer, length)` writes."""
    array = np.zeros(count)
    check(fill(ffi.cast("double *", array.ctypes.data), count))
    return array
