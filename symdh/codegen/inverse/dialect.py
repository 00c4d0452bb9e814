"""How the inverse kinematics is spelt in C of either precision, and in C++.

The template ``c/ik.c.jinja`` serves them all: C++ has it in a namespace, templated on the scalar.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from symdh.codegen.inverse.breaking import broken
from symdh.codegen.inverse.constants import NUMBERS, SENTENCES, SETTLE, SINGLE_NUMBERS
from symdh.codegen.precision import DOUBLE, Precision

#: The functions of <math.h> that the template calls.
_CALLED = ("atan2", "ceil", "cos", "fabs", "fmax", "sin", "sqrt")


@dataclass(frozen=True)
class Dialect:
    """What the template ``c/ik.c.jinja`` gets as ``say``.

    Attributes
    ----------
    real : str
        The type of the numbers.
    name : str
        What functions begin with.
    local : str
        What stands before a function that is nobody else's.
    search, unknown, params : str
        Types.
    struct_begin, struct_end : str
        Around the members of a type; ``{}`` stands for its name.
    explicit : str
        Behind a function's name where its arguments do not tell the type of the numbers.
    fk, fk_jacobian : str
        The functions that this one goes by.
    most : str
        The most answers.
    none : str
        A null pointer.
    pi, infinity : str
    math : mapping of str to str
        Functions of <math.h>.
    bounds : mapping of str to str
        What the helpers go by (see `symdh.codegen.inverse.constants`).
    told : mapping of str to str
        The same for people, of the precision that is named, in C++ of double.
    number, cast : callable
        Write a literal of a double, and an integer as a number.
    """

    real: str
    name: str
    local: str
    search: str
    unknown: str
    params: str
    struct_begin: str
    struct_end: str
    explicit: str
    fk: str
    fk_jacobian: str
    most: str
    none: str
    pi: str
    infinity: str
    math: Mapping[str, str]
    bounds: Mapping[str, str]
    told: Mapping[str, str]
    number: Callable[[str], str]
    cast: Callable[[str], str]

    def context(self) -> dict[str, object]:
        """Return what the template needs beside ``ik``, ``fields`` and ``head``."""
        return {
            "say": self,
            "bound": self.bounds,
            "sentences": SENTENCES,
            "settle": SETTLE,
            "wrap": broken,
        }


def c_dialect(stem: str, precision: Precision) -> Dialect:
    """Return the dialect of C, behind the stem of an arm, in one precision."""
    suffix, real = precision.suffix, precision.name
    numbers = NUMBERS if precision is DOUBLE else SINGLE_NUMBERS
    return Dialect(
        real=real,
        name=f"{stem}_ik",
        local="static ",
        search=f"{stem}_ik_search",
        unknown=f"{stem}_ik_unknown",
        params=f"{stem}_params",
        struct_begin=f"typedef struct {stem}_ik_{{}} {{{{",
        struct_end=f"}}}} {stem}_ik_{{}};",
        explicit="",
        fk=f"{stem}_fk",
        fk_jacobian=f"{stem}_fk_jacobian",
        most=f"{stem}_IK_MAX",
        none="NULL",
        pi=f"{stem}_ik_PI",
        infinity=f"({real})HUGE_VAL" if suffix else "HUGE_VAL",
        math={call: call + suffix for call in _CALLED},
        bounds={key: text + suffix for key, text in numbers.items()},
        told=numbers,
        number=lambda text: text + suffix,
        cast=lambda text: f"({real}){text}",
    )


def cpp_dialect() -> Dialect:
    """Return the dialect of C++, inside a namespace of its own."""
    return Dialect(
        real="Scalar",
        name="ik",
        local="template <class Scalar>\n",
        search="ik_search<Scalar>",
        unknown="ik_unknown<Scalar>",
        params="Params<Scalar>",
        struct_begin="template <class Scalar>\nstruct ik_{} {{",
        struct_end="}};",
        explicit="<Scalar>",
        fk="ik_fk",
        fk_jacobian="ik_fk_jacobian",
        most="ik_max",
        none="nullptr",
        pi="ik_bounds<Scalar>::pi",
        infinity="std::numeric_limits<Scalar>::infinity()",
        math={call: f"std::{call}" for call in _CALLED},
        bounds={key: f"ik_bounds<Scalar>::{key}" for key in NUMBERS},
        told=NUMBERS,
        number=lambda text: f"Scalar({text})",
        cast=lambda text: f"Scalar({text})",
    )
