"""Is a student's answer right: exact equality, and the usual slips by name."""

from symdh.kinematics.answers.judge import judge
from symdh.kinematics.answers.verdicts import (
    JudgedClaim,
    JudgedEntry,
    JudgedSheet,
    Verdict,
)

__all__ = ["JudgedClaim", "JudgedEntry", "JudgedSheet", "Verdict", "judge"]
