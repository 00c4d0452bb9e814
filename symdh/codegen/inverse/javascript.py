"""What the inverse kinematics in JavaScript is written with."""

from __future__ import annotations

from symdh.codegen.inverse.breaking import Layout
from symdh.codegen.inverse.script import Script
from symdh.codegen.names import words

SCRIPT = Script(
    goal="goal[{}][{}]",
    start="start[{}]",
    parameter="{}",
    infinity="Infinity",
    layout=Layout(indent="  ", end=";"),
)

#: What the section calls its functions, constants and arguments, and the globals that it reads.
OWN = words(
    """
    Array
    ik ik_free seed limits parameters search goal start reach answers far order name JOINT_LIMITS
    IK_FOUND IK_IS_ANGLE IK_NONE IK_NO_LINE IK_NO_PAIR IK_NO_SLIDE IK_TWISTS
    ikAngles ikApart ikBranches ikCircleRoots ikError ikGoal ikImproved ikIsWithinLimits
    ikLeastSquares ikLine ikMoveIntoLimits ikPair ikPolished ikPropose ikRescue ikShift ikShifts
    ikSlide ikStep ikTurn ikTurns ikWave ikWrapped
    """
)
