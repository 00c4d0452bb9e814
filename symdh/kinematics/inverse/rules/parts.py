"""Names for a known part: once the joints at the ends of the chain are found, what is between.

With theta_1 .. theta_i found, the pose ``(A_1 .. A_i)^-1 T`` is known, and its entries get names;
the joints that are left solve ``E = A_{i+1} .. A_n``, a problem of its own. For an arm with a
spherical wrist these are the Euler angles of the hand.
"""

from __future__ import annotations

from symdh.kinematics.inverse.ring import PARTS, Element, Pose
from symdh.kinematics.inverse.solution import Rule, Step
from symdh.kinematics.inverse.state import State

#: Fewer joints than this leave entries that are short as they are.
_FOUND = 2


def name_part(state: State) -> None:
    """Name the pose of the part that is still open, where two more joints have been found."""
    last = next((step.part for step in reversed(state.steps) if step.part), None)
    before = last or (0, state.ring.arm.robot.n)
    i, j = _open_part(state)
    moving = state.ring.arm.moving
    found = sum(1 for row in moving if before[0] < row <= i or j < row <= before[1])
    left = sum(1 for row in moving if i < row <= j)
    count = sum(1 for step in state.steps if step.part)
    if found < _FOUND or left < (_FOUND + 1 if count else _FOUND) or count == PARTS:
        return
    entries = _entries(_known_pose(state, before, (i, j)))
    first = state.ring.first_name + 12 * count
    definitions = tuple(
        (first + k, entry) for k, entry in enumerate(entries) if _gets_a_name(state, entry)
    )
    if not definitions:
        return
    state.take(Step(-1, Rule.NAMES, definitions=definitions, part=(i, j)))
    for generator, _ in definitions:
        entries[generator - first] = state.ring.gens[generator]
    pose = Pose([entries[3 * r : 3 * r + 3] for r in range(3)], entries[9:])
    state.parts[i, j] = pose
    state.pool.add_part(i, j, pose)


def _open_part(state: State) -> tuple[int, int]:
    """Return i and j with A_{i+1} .. A_j the part between the joints that are found."""
    ring = state.ring
    moving = ring.arm.moving
    known = [ring.unknown_of(row) in state.known for row in moving]
    front = next((k for k, found in enumerate(known) if not found), len(moving))
    back = next((k for k, found in enumerate(reversed(known)) if not found), len(moving))
    i = moving[front - 1] if front else 0
    j = moving[len(moving) - back] - 1 if back else ring.arm.robot.n
    return i, j


def _known_pose(state: State, before: tuple[int, int], now: tuple[int, int]) -> Pose:
    """Take the joints found since then off the pose that was known before."""
    ring = state.ring
    pose = state.parts.get(before, ring.goal_pose)
    (i_0, j_0), (i, j) = before, now
    pose = ring.times(ring.inverse_product(i_0, i), pose) if i > i_0 else pose
    return ring.times(pose, ring.inverse_product(j, j_0)) if j < j_0 else pose


def _entries(pose: Pose) -> list[Element]:
    return [entry for row in pose.rotation for entry in row] + pose.position


def _gets_a_name(state: State, entry: Element) -> bool:
    """Say whether an entry is given by the task, and worth a name."""
    return len(entry) > 1 and state.pool.is_given(entry) and not state.vanishes(entry)
