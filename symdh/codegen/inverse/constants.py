"""What the templates of every language have in common."""

from __future__ import annotations

from types import MappingProxyType

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
        # How far beside its limit a joint variable counts as within.
        "beside": "1e-6",
        # Larger than this, in absolute value, nothing is a pose or a joint value.
        "huge": "1e100",
        # The part of a squared column of the Jacobian below which the rest of it is rounding.
        "lost": "1e-18",
        # What is as exact as it will get: a rotation, a root, a coefficient that is zero.
        "exact": "1e-15",
        # By how much a root of a polynomial may leave the unit circle, and what is divided by.
        "circle": "2e-4",
        "tiny": "1e-60",
        # Damping of Newton's method: the first, and what is no damping any more.
        "damping": "1e-6",
        "undamped": "1e-7",
        # How far off the first pose is that is solved in place of a singular one, as a part of
        # the reach and in radians, and by what the next ones are further off.
        "aside": "1e-6",
        "further": "10.0",
    }
)

#: The same in single precision. What stands for rounding is that of a float, 24 bits, with as much
#: room as a double gets; what is a distance between answers is about the square root of that. Where
#: a condition costs digits, of which a float has seven, the better equation is sought earlier.
SINGLE_NUMBERS = MappingProxyType(
    {
        "good": "5e-2",
        "doubtful": "1e-2",
        "free_line": "3e-5",
        "free_pair": "1e-9",
        "boundary": "1e-5",
        "tolerance": "1e-5",
        "rounding": "1e-6",
        "near": "0.05",
        "missed": "1e-3",
        "same": "1e-3",
        "beside": "1e-5",
        "huge": "1e9",
        "lost": "1e-10",
        "exact": "5e-7",
        "circle": "3e-2",
        "tiny": "1e-30",
        "damping": "1e-3",
        "undamped": "1e-4",
        "aside": "2e-4",
        "further": "5.0",
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
