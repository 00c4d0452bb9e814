"""The algebra of elementary motions: words, fusing, inverses, and their exact matrices."""

from symdh.motion.matrices import elementary, inverse_transform, transform
from symdh.motion.words import Word, fuse, fuse_to_turn, inverse, rotation, rotations, translation

__all__ = [
    "Word",
    "elementary",
    "fuse",
    "fuse_to_turn",
    "inverse",
    "inverse_transform",
    "rotation",
    "rotations",
    "transform",
    "translation",
]
