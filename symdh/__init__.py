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
    from symdh.interface.arm import (
        ForwardKinematics,
        Robot,
        forward_kinematics,
        load,
        loads,
    )
    from symdh.interface.documents import Choices, Derivation, Drawing, derive, draw
    from symdh.interface.inverse import Answer, InverseKinematics, inverse_kinematics
    from symdh.interface.motion import (
        GeometricJacobian,
        Singularities,
        jacobian,
        singularities,
    )
    from symdh.robot import Convention, Joint, JointType, Limits, Motion, Units

_HOME = {
    "ForwardKinematics": "symdh.interface.arm",
    "Robot": "symdh.interface.arm",
    "forward_kinematics": "symdh.interface.arm",
    "load": "symdh.interface.arm",
    "loads": "symdh.interface.arm",
    "Choices": "symdh.interface.documents",
    "Derivation": "symdh.interface.documents",
    "Drawing": "symdh.interface.documents",
    "derive": "symdh.interface.documents",
    "draw": "symdh.interface.documents",
    "Answer": "symdh.interface.inverse",
    "InverseKinematics": "symdh.interface.inverse",
    "inverse_kinematics": "symdh.interface.inverse",
    "GeometricJacobian": "symdh.interface.motion",
    "Singularities": "symdh.interface.motion",
    "jacobian": "symdh.interface.motion",
    "singularities": "symdh.interface.motion",
    "Convention": "symdh.robot",
    "Joint": "symdh.robot",
    "JointType": "symdh.robot",
    "Limits": "symdh.robot",
    "Motion": "symdh.robot",
    "Units": "symdh.robot",
}

__all__ = [
    "Answer",
    "Choices",
    "Convention",
    "Derivation",
    "DerivationError",
    "Drawing",
    "ForwardKinematics",
    "GeometricJacobian",
    "InverseKinematics",
    "Joint",
    "JointType",
    "LimitError",
    "Limits",
    "Motion",
    "OutputError",
    "ReadError",
    "Robot",
    "Singularities",
    "SymdhError",
    "TableError",
    "Units",
    "UnsupportedError",
    "__version__",
    "derive",
    "draw",
    "forward_kinematics",
    "inverse_kinematics",
    "jacobian",
    "load",
    "loads",
    "singularities",
]


def __getattr__(name: str) -> Any:
    if name in _HOME:
        return getattr(import_module(_HOME[name]), name)
    raise AttributeError(f"module 'symdh' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)
