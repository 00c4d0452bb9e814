"""A student's answers to a table: which things are named, and what stands there."""

from symdh.table.answers.blank import blank_answers
from symdh.table.answers.model import (
    AnswerSheet,
    Claim,
    Entry,
    Jacobian,
    Link,
    Pose,
    RowClaim,
    Subject,
)
from symdh.table.answers.reader import read_answers

__all__ = [
    "AnswerSheet",
    "Claim",
    "Entry",
    "Jacobian",
    "Link",
    "Pose",
    "RowClaim",
    "Subject",
    "blank_answers",
    "read_answers",
]
