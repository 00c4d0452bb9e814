"""Where an arm is singular: determinants in a polynomial ring, their factors, what they mean."""

from symdh.kinematics.singular.naming import Kind, Meaning
from symdh.kinematics.singular.singularities import Factor, Singularities, singularities

__all__ = ["Factor", "Kind", "Meaning", "Singularities", "singularities"]
