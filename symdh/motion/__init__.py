"""The algebra of elementary motions: words, fusing, inverses, and their exact matrices."""

from symdh.motion.matrices import elementary, inverse_transform, transform
from symdh.motion.runs import Run, Station, cut_runs, is_rotation
from symdh.motion.words import Word, fuse, fuse_to_turn, inverse, rotation, rotations, translation

__all__ = [
    "Run",
    "Station",
    "Word",
    "cut_runs",
    "elementary",
    "fuse",
    "fuse_to_turn",
    "inverse",
    "inverse_transform",
    "is_rotation",
    "rotation",
    "rotations",
    "transform",
    "translation",
]
