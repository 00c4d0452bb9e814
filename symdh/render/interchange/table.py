"""A robot as text, value by value: the table in JSON, and what the formats of rows lay out."""

from __future__ import annotations

import json
from dataclasses import dataclass, fields

from symdh.render.interchange.exported import Exported
from symdh.render.table_yaml import angle_text, length_text
from symdh.render.table_yaml import table_yaml as yaml_text
from symdh.robot import Convention, Joint, JointType, Motion, MotionKind, Robot, in_name_order
from symdh.table import ANGLE, symbol_dimension

ORDERS = {
    Convention.STANDARD: ("theta", "d", "a", "alpha"),
    Convention.MODIFIED: ("alpha", "a", "d", "theta"),
}
"""The parameters in the order in which a row makes its motions."""

_ANGLES = ("theta", "alpha")


@dataclass(frozen=True, slots=True)
class TableText:
    """A table whose every value is text, as it stands in a file; see `symdh.robot.Robot`."""

    name: str
    title: str | None
    convention: str
    units: dict[str, str]
    joints: list[dict[str, str]]
    base: list[str]
    tool: list[str]
    values: dict[str, str]
    limits: dict[str, list[str]]

    def sections(self) -> dict[str, object]:
        """Return the keys of the table that say something, in their order."""
        found = {field.name: getattr(self, field.name) for field in fields(self)}
        return {key: value for key, value in found.items() if value}


def table_text(robot: Robot) -> TableText:
    """Write every value of a robot as the text that stands for it in a table."""
    units = {"angle": robot.units.angle, "length": robot.units.length}
    return TableText(
        name=robot.name,
        title=robot.title,
        convention=robot.convention.value,
        units={key: unit.value for key, unit in units.items() if unit is not None},
        joints=[_row(joint, robot) for joint in robot.joints],
        base=[_motion(motion, robot) for motion in robot.base],
        tool=[_motion(motion, robot) for motion in robot.tool],
        values=_values(robot),
        limits=_limits(robot),
    )


def table_yaml(robot: Robot) -> Exported:
    """Write a table as YAML."""
    return Exported(yaml_text(robot))


def table_json(robot: Robot) -> Exported:
    """Write a table as JSON; every value is text, as in YAML, and symdh reads it as a table."""
    return Exported(json.dumps(table_text(robot).sections(), indent=2, ensure_ascii=False) + "\n")


def _row(joint: Joint, robot: Robot) -> dict[str, str]:
    """Write one row; its type and variable only where they could not be read off it."""
    row = {}
    for key in ORDERS[robot.convention]:
        write = angle_text if key in _ANGLES else length_text
        row[key] = write(getattr(joint, key), robot.units.angle)
    if joint.type is not _type_read_off(joint):
        row["type"] = joint.type.value
    home = joint.theta if joint.type is JointType.REVOLUTE else joint.d
    if joint.variable is not None and home.free_symbols != {joint.variable}:
        row["variable"] = joint.variable.name
    return row


def _type_read_off(joint: Joint) -> JointType:
    if joint.theta.free_symbols:
        return JointType.REVOLUTE
    return JointType.PRISMATIC if joint.d.free_symbols else JointType.FIXED


def _motion(motion: Motion, robot: Robot) -> str:
    write = angle_text if motion.kind is MotionKind.ROTATION else length_text
    return (
        f"{motion.kind.value}{motion.axis.name.lower()}({write(motion.amount, robot.units.angle)})"
    )


def _values(robot: Robot) -> dict[str, str]:
    values = {}
    for symbol in in_name_order(robot.values):
        write = angle_text if symbol_dimension(robot, symbol) == ANGLE else length_text
        values[symbol.name] = write(robot.values[symbol])
    return values


def _limits(robot: Robot) -> dict[str, list[str]]:
    limits = {}
    for joint in robot.joints:
        bounds = robot.limits.get(joint.variable) if joint.variable else None
        if joint.variable is not None and bounds is not None:
            write = angle_text if joint.type is JointType.REVOLUTE else length_text
            limits[joint.variable.name] = [write(bounds.lower), write(bounds.upper)]
    return limits
