"""symdh: from a Denavit-Hartenberg table to a derivation, a handout and numeric code.

The names below are imported when they are first used, so that ``symdh --help`` never waits for
sympy.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from symdh._version import __version__
from symdh.errors import (
    DerivationError,
    LimitError,
    OutputError,
    ReadError,
    SymdhError,
    TableError,
    UnsupportedError,
)

if TYPE_CHECKING:
    from symdh.interface import (
        Choices,
        Derivation,
        Drawing,
        ForwardKinematics,
        Robot,
        derive,
        draw,
        forward_kinematics,
        load,
        loads,
    )
    from symdh.robot import Convention, Joint, JointType, Limits, Motion, Units

_HOME = {
    "Choices": "symdh.interface",
    "Derivation": "symdh.interface",
    "Drawing": "symdh.interface",
    "ForwardKinematics": "symdh.interface",
    "Robot": "symdh.interface",
    "derive": "symdh.interface",
    "draw": "symdh.interface",
    "forward_kinematics": "symdh.interface",
    "load": "symdh.interface",
    "loads": "symdh.interface",
    "Convention": "symdh.robot",
    "Joint": "symdh.robot",
    "JointType": "symdh.robot",
    "Limits": "symdh.robot",
    "Motion": "symdh.robot",
    "Units": "symdh.robot",
}

__all__ = [
    "Choices",
    "Convention",
    "Derivation",
    "DerivationError",
    "Drawing",
    "ForwardKinematics",
    "Joint",
    "JointType",
    "LimitError",
    "Limits",
    "Motion",
    "OutputError",
    "ReadError",
    "Robot",
    "SymdhError",
    "TableError",
    "Units",
    "UnsupportedError",
    "__version__",
    "derive",
    "draw",
    "forward_kinematics",
    "load",
    "loads",
]


def __getattr__(name: str) -> Any:
    if name in _HOME:
        return getattr(import_module(_HOME[name]), name)
    raise AttributeError(f"module 'symdh' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)
