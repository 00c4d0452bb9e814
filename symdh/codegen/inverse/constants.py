"""What the templates of every language have in common."""

from __future__ import annotations

from types import MappingProxyType

from symdh.codegen.facts import Facts
from symdh.codegen.inverse.program import Program

#: What the helpers go by, as literals; mostly the same as in `symdh.kinematics.inverse`.
NUMBERS = MappingProxyType(
    {
        # Conditioned better than this, an equation is taken without a look at the others.
        "good": "1e-3",
        # A condition, or a distance from the boundary, that may cost an answer.
        "doubtful": "1e-5",
        # Coefficients smaller than this part of their size leave an unknown free.
        "free_line": "1e-12",
        "free_pair": "1e-24",
        # How far beyond the reach a target counts as on its boundary.
        "boundary": "1e-9",
        # Parts of the reach: what an answer may miss by, what is rounding of a formula, and what
        # Newton's method is worth trying on.
        "tolerance": "1e-9",
        "rounding": "1e-13",
        "near": "0.05",
        # What misses by less than this part after Newton's method may hide an answer.
        "missed": "1e-3",
        # Two answers closer than this, in radians and parts of the reach, are one.
        "same": "1e-6",
    }
)

#: What a comment says of each kind of equation.
SENTENCES = MappingProxyType(
    {
        "line": "A s + B c + C = 0",
        "pair": "two equations A s + B c + C = 0",
        "slide": "A q + C = 0",
        "square": "A q^2 + B q + C = 0",
        "roots": "f0 + f1 c + f2 s + f3 cos 2x + f4 sin 2x = 0",
    }
)

#: The helper that gives an unknown its values, once the best equation is kept.
SETTLE = MappingProxyType(
    {"line": "turns", "pair": "turn", "slide": "shift", "square": "shifts", "roots": "angles"}
)


def held_joints(facts: Facts, program: Program) -> str:
    """Return the names of the locked joints for a sentence; empty where there are none."""
    held = [joint.name for k, joint in enumerate(facts.joints) if k not in program.free]
    return " and ".join(held)
