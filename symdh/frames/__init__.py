"""Joint axes or frames in space -> Denavit-Hartenberg rows.

`assign` gives the table of a mechanism, `assign_frames` also tells how each frame came about;
`mechanism_of` goes the other way, from a table to the axes that it stands for; `read_frames`
measures frames that are given as matrices.
"""

from symdh.frames.assign import assign, assign_frames
from symdh.frames.faults import AssignmentError, Fault
from symdh.frames.located import mechanism_of
from symdh.frames.reading import pose_of_matrix, read_frames
from symdh.frames.story import Assignment

__all__ = [
    "Assignment",
    "AssignmentError",
    "Fault",
    "assign",
    "assign_frames",
    "mechanism_of",
    "pose_of_matrix",
    "read_frames",
]
