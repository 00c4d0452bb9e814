"""What the inverse kinematics in MATLAB is written with."""

from __future__ import annotations

from symdh.codegen.inverse.breaking import Layout
from symdh.codegen.inverse.script import Script
from symdh.codegen.names import words

SCRIPT = Script(
    goal="goal({}, {})",
    start="start({})",
    parameter="p.{}",
    infinity="Inf",
    layout=Layout(more=" ...", end=";"),
)

#: What the function that holds the branches calls, and names itself.
OWN = words(
    """
    goal start search unknown freed
    ik_angles ik_line ik_pair ik_propose ik_shift ik_shifts ik_slide ik_turn ik_turns ik_unknown
    """
)
