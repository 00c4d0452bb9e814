"""What the inverse kinematics in Julia is written with."""

from __future__ import annotations

from symdh.codegen.inverse.breaking import Layout
from symdh.codegen.inverse.script import Script
from symdh.codegen.names import words

SCRIPT = Script(
    goal="goal[{}, {}]",
    start="start[{}]",
    parameter="{}",
    infinity="Inf",
    layout=Layout(behind_signs=True),
)

#: What the functions that hold names of the table call, and name themselves; names that end with
#: an exclamation mark are nobody else's.
OWN = words(
    """
    AbstractMatrix Bool Float64 Vector abs2 collect foreach isempty map nothing size sortperm sum
    zeros
    JOINT_LIMITS IK_FOUND IK_IS_ANGLE IK_NO_LINE IK_NO_PAIR IK_NO_SLIDE IK_TWISTS IkSearch
    each free freed goal ik ik_apart ik_circle_roots ik_free ik_goal ik_improved
    ik_is_within_limits ik_least_squares ik_line ik_miss ik_pair ik_polished ik_slide ik_step
    ik_wave ik_wrapped limits order parameters reach search seed start within
    """
)
