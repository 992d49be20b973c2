"""What can go wrong. How a solve ended is no exception but `Result.status`, except in the one-line functions."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._core import Result

__all__ = [
    "ArgumentError",
    "Error",
    "FileError",
    "FormatError",
    "InternalError",
    "NotSolved",
    "RangeError",
    "StateError",
    "UnsupportedError",
]


class Error(Exception):
    """Every exception that is mlcp's own; the message names the argument and the index."""


class ArgumentError(Error, ValueError):
    """A value is not legal: NaN, lo > hi, an asymmetric matrix."""


class RangeError(Error, ValueError, IndexError):
    """An index is out of range, or a length does not match."""


class StateError(Error, RuntimeError):
    """The call does not fit the state of the object, e.g. results before a solve."""


class FileError(Error, OSError):
    """A file cannot be opened, read or written."""


class FormatError(Error, ValueError):
    """A snapshot is damaged or from an unknown version, a problem folder is not one."""


class UnsupportedError(Error, NotImplementedError):
    """Legal, but this build or this method cannot do it."""


class InternalError(Error, RuntimeError):
    """A defect of the library: please report it with a snapshot."""


class NotSolved(Error, RuntimeError):
    """A one-line function has no array to return.

    Attributes
    ----------
    result : Result
        What the solve left: status, errors, certificates, the last iterate.
    """

    def __init__(self, result: Result) -> None:
        super().__init__(f"{result.status.value}: the largest error is {result.errors.largest:.1e}")
        self.result = result

    def __reduce__(self) -> tuple[type[NotSolved], tuple[Result]]:
        return type(self), (self.result,)
