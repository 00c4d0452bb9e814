"""Robot -> straight-line programs -> source files in an engineer's language.

Importing this package is cheap: sympy and jinja2 are loaded when something is generated.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from symdh.codegen.targets import TARGETS, GeneratedFile, Target
from symdh.errors import UnsupportedError

if TYPE_CHECKING:
    from symdh.robot import Robot

__all__ = ["TARGETS", "GeneratedFile", "Target", "generate"]


def generate(robot: Robot, target: str, **options: object) -> tuple[GeneratedFile, ...]:
    """Generate pose and Jacobian of a robot, base to tool, in one language.

    Parameters
    ----------
    robot : Robot
    target : str
        Name of one of `TARGETS`.
    **options
        Of that target: ``trig``, ``precision`` and ``batch`` for C; ``lock``, the joint variables
        that the inverse kinematics holds at what the seed says, and ``ik=False``, which leaves it
        out, for targets that have it.

    Returns
    -------
    tuple of GeneratedFile
        The same robot gives the same text, always.

    Raises
    ------
    UnsupportedError
        When there is no such target, the target has no such option, or the table holds something
        that has no code: a function outside the table's own, an amount that is not a real number.
    """
    for candidate in TARGETS:
        if candidate.name == target:
            return candidate.generate(robot, **options)
    names = ", ".join(candidate.name for candidate in TARGETS)
    raise UnsupportedError(f"there is no target {target!r}; there are {names}")
