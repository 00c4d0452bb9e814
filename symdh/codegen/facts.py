"""What every generated file says about its table, whatever its language."""

from __future__ import annotations

from dataclasses import dataclass

from sympy import Symbol

from symdh._version import __version__
from symdh.codegen.fingerprint import fingerprint
from symdh.codegen.literals import literal
from symdh.codegen.names import comment_text
from symdh.robot import Convention, Joint, JointType, Robot

_FORMULAS = {
    Convention.STANDARD: "A_i = Rz(theta_i) Tz(d_i) Tx(a_i) Rx(alpha_i)",
    Convention.MODIFIED: "A_i = Rx(alpha_{i-1}) Tx(a_{i-1}) Rz(theta_i) Tz(d_i)",
}


@dataclass(frozen=True, slots=True)
class JointFact:
    """A joint variable: its name in the table, what it is, and its limits as literals."""

    symbol: Symbol
    name: str
    kind: str
    unit: str
    limits: tuple[str, str] | None


@dataclass(frozen=True)
class Facts:
    """What a generated file says about its table; safe to print in a comment.

    Attributes
    ----------
    name, version, table, convention, formula, length_unit : str
        `table` is the hash of the table, 16 hex digits.
    joints : tuple of JointFact
        In the order of ``q``.
    """

    name: str
    version: str
    table: str
    convention: str
    formula: str
    length_unit: str
    joints: tuple[JointFact, ...]

    def joint_table(self, element: str, first: int = 0) -> list[str]:
        """Return one aligned line a joint, led by the element of ``q``: ``q[{}]``, say.

        Elements are counted from `first`.
        """
        rows = [
            (element.format(place), j.name, j.kind, j.unit, " to ".join(j.limits or ()))
            for place, j in enumerate(self.joints, first)
        ]
        widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
        return [
            "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
            for row in rows
        ]


def facts_of(robot: Robot) -> Facts:
    """Collect what a generated file says about its table."""
    length = robot.units.length
    unit = length.value if length is not None else "the table's unit of length"
    return Facts(
        name=comment_text(robot.name),
        version=__version__,
        table=fingerprint(robot)[:16],
        convention=robot.convention.value,
        formula=_FORMULAS[robot.convention],
        length_unit=unit,
        joints=tuple(
            _joint_fact(robot, joint, joint.variable, unit)
            for joint in robot.joints
            if joint.variable is not None
        ),
    )


def _joint_fact(robot: Robot, joint: Joint, variable: Symbol, length_unit: str) -> JointFact:
    limits = robot.limits.get(variable)
    return JointFact(
        symbol=variable,
        name=comment_text(variable.name),
        kind=joint.type.value,
        unit="rad" if joint.type is JointType.REVOLUTE else length_unit,
        limits=(literal(limits.lower), literal(limits.upper)) if limits is not None else None,
    )
