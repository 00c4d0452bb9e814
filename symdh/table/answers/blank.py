"""The answer file that a student fills in."""

from __future__ import annotations

from symdh.robot import Robot

_HEAD = """\
# Answers to: {title}
#
# Put an expression in place of each _ and check the file:
#
#     symdh answer TABLE THIS_FILE
#
# Cosines and sines of joint angles may be written c1, s12. Any form of an answer counts that is
# equal to the right one. What stays _ counts as blank. A part may be taken out; single entries
# are named px, r11, T01[1,4]; T(0, 2), T02 and 0T2 are one thing; J is the Jacobian, 6 rows.
# Rows read off a figure go under `rows:`, as {{theta: ..., d: ..., a: ..., alpha: ...}}.

name: _
"""
_NUMBERS = """\
# Numbers, rounded as you like from three digits on; lengths {length}.
numbers:
"""
_MATRIX = "  - [_, _, _, _]\n" * 4


def blank_answers(robot: Robot) -> str:
    """Return an answer file with a blank for every entry.

    It asks for each link and for the pose of the whole chain, and for the pose in numbers where
    the table has the numbers for it.
    """
    title = robot.title or robot.name
    parts = [_HEAD.format(title=title)]
    parts += [f"A{i}:\n{_MATRIX}" for i in range(1, robot.n + 1)]
    plain = not robot.base and not robot.tool and robot.n < 10
    pose = f"T0{robot.n}" if plain else "pose"
    parts.append(f"{pose}:\n{_MATRIX}")
    if robot.values and all(s in robot.values for s in robot.parameters):
        parts.append(_numbers(robot, pose))
    return "\n".join(parts)


def _numbers(robot: Robot, pose: str) -> str:
    length = f"in {robot.units.length.value}" if robot.units.length else "as in the table"
    missing = [s.name for s in robot.variables if s not in robot.values]
    at = ", ".join(f"{name}: 0" for name in missing)
    lines = [_NUMBERS.format(length=length)]
    if at:
        lines.append(f"  at: {{{at}}}\n")
    lines.append(f"  {pose}:\n" + "    - [_, _, _, _]\n" * 4)
    return "".join(lines)
