"""A table as URDF: links and joints without shapes and masses, of which a table says nothing.

The frame of link i lies on joint i, where the joint's own constants have been applied: in a
modified table it is frame i itself. The last joint is fixed and leads to the tool.
"""

from __future__ import annotations

from dataclasses import dataclass
from xml.sax.saxutils import quoteattr

from sympy import Expr

from symdh._version import __version__
from symdh.codegen.fingerprint import fingerprint
from symdh.codegen.names import comment_text
from symdh.kinematics.chain import link_word
from symdh.motion import Word, rotation, translation
from symdh.render.interchange.exported import Exported
from symdh.render.interchange.numbers import (
    Numbers,
    roll_pitch_yaw,
    short,
    sign_and_offset,
    triple,
)
from symdh.robot import Axis, Convention, Joint, JointType, Robot
from symdh.templating import render

BASE, TOOL = "base_link", "tool0"

#: A prismatic joint must have limits in URDF; this stands where the table has none, in metres.
FAR = 1000


@dataclass(frozen=True, slots=True)
class UrdfJointText:
    """One joint as text, safe to put into a tag."""

    name: str
    type: str
    parent: str
    child: str
    xyz: str
    rpy: str
    axis: str | None = None
    lower: str | None = None
    upper: str | None = None


def urdf(robot: Robot) -> Exported:
    """Write a table as URDF.

    Raises
    ------
    UnsupportedError
        When a parameter has no value, or a joint moves a multiple of its variable.
    """
    writer = _Writer(robot)
    joints = [writer.joint(i, joint) for i, joint in enumerate(robot.joints, start=1)]
    joints.append(writer.tool())
    text = render(
        "interchange/arm.urdf.jinja",
        name=quoteattr(robot.name),
        version=__version__,
        table=fingerprint(robot)[:16],
        original=comment_text(robot.name).replace("--", "__"),
        convention=robot.convention.value,
        links=[BASE, *(joint.child for joint in joints)],
        joints=joints,
    )
    return Exported(text, (*writer.numbers.notes, *writer.notes))


class _Writer:
    """Goes along the chain; what a row leaves behind its joint goes before the next one."""

    def __init__(self, robot: Robot) -> None:
        self.robot = robot
        self.numbers = Numbers(robot)
        self.notes: list[str] = []
        self.taken = {variable.name for variable in robot.variables}
        self.pending: Word = robot.base
        self.parent = BASE

    def joint(self, i: int, joint: Joint) -> UrdfJointText:
        """Write the joint of row i."""
        child = f"link_{i}"
        if joint.variable is None:
            self.pending += link_word(self.robot, i)
            return self._text(self._free(f"fixed_{i}"), "fixed", child)
        sign, offset = sign_and_offset(joint, i, "URDF")
        before, after = _around(joint, offset, self.robot.convention)
        self.pending += before
        axis = f"0 0 {sign}"
        text = self._text(joint.variable.name, self._type(joint), child, axis, self._limits(joint))
        self.pending = after
        return text

    def tool(self) -> UrdfJointText:
        """Write the fixed joint to the tool."""
        self.pending += self.robot.tool
        return self._text(self._free("tool"), "fixed", TOOL)

    def _free(self, name: str) -> str:
        """Return a name for a fixed joint that no variable has."""
        while name in self.taken:
            name += "_"
        return name

    def _type(self, joint: Joint) -> str:
        if joint.type is JointType.REVOLUTE and self.numbers.limits(joint) is None:
            return "continuous"
        return joint.type.value

    def _limits(self, joint: Joint) -> tuple[str, str] | None:
        limits = self.numbers.limits(joint)
        if limits is not None:
            return short(limits[0]), short(limits[1])
        if joint.type is JointType.REVOLUTE:
            return None
        self.notes.append(
            f"{joint.variable} has no limits in the table and URDF wants some: {FAR} m each way"
        )
        return f"-{FAR}", f"{FAR}"

    def _text(
        self,
        name: str,
        kind: str,
        child: str,
        axis: str | None = None,
        limits: tuple[str, str] | None = None,
    ) -> UrdfJointText:
        pose = self.numbers.matrix(self.pending)
        lower, upper = limits or (None, None)
        text = UrdfJointText(
            name=name,
            type=kind,
            parent=self.parent,
            child=child,
            xyz=triple((pose[0, 3], pose[1, 3], pose[2, 3])),
            rpy=triple(roll_pitch_yaw(pose)),
            axis=axis,
            lower=lower,
            upper=upper,
        )
        self.parent, self.pending = child, ()
        return text


def _around(joint: Joint, offset: Expr, convention: Convention) -> tuple[Word, Word]:
    """Return the constant motions of a row before and behind its variable one.

    What a row does about and along z it may do in any order, so all of its constants go first.
    """
    revolute = joint.type is JointType.REVOLUTE
    along_z = (
        rotation(Axis.Z, offset if revolute else joint.theta),
        translation(Axis.Z, joint.d if revolute else offset),
    )
    along_x = (translation(Axis.X, joint.a), rotation(Axis.X, joint.alpha))
    if convention is Convention.STANDARD:
        return along_z, along_x
    return along_x + along_z, ()
