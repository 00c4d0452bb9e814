"""Where an arm is singular: determinants in a polynomial ring, their factors, what they mean."""

from symdh.kinematics.singular.naming import Kind, Meaning
from symdh.kinematics.singular.singularities import (
    MAX_JOINTS,
    Factor,
    Singularities,
    singularities,
)

__all__ = ["MAX_JOINTS", "Factor", "Kind", "Meaning", "Singularities", "singularities"]
