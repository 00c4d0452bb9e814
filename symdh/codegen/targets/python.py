"""Python: one module that needs NumPy alone, ``fk(q)`` of shape (..., n) to (..., 4, 4)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from sympy import Symbol

from symdh.codegen.environment import render
from symdh.codegen.facts import Facts, facts_of
from symdh.codegen.forward import forward_routine
from symdh.codegen.graph import Op
from symdh.codegen.listing import Listing, Local, write_listing
from symdh.codegen.literals import literal
from symdh.codegen.names import PYTHON_KEYWORDS, Scope, comment_text, file_stem, words
from symdh.codegen.targets import GeneratedFile
from symdh.robot import Robot

_FUNCTIONS = {
    Op.SIN: "np.sin",
    Op.COS: "np.cos",
    Op.TAN: "np.tan",
    Op.ASIN: "np.arcsin",
    Op.ACOS: "np.arccos",
    Op.ATAN: "np.arctan",
    Op.ATAN2: "np.arctan2",
    Op.SQRT: "np.sqrt",
    Op.ABS: "np.abs",
    Op.POW: "np.power",
}

#: Written down, because the list of the running Python changes with its version.
_BUILTINS = words(
    """
    ValueError abs aiter all anext any ascii bin bool breakpoint bytearray bytes callable chr
    classmethod compile complex copyright credits delattr dict dir divmod enumerate eval exec exit
    filter float format frozenset getattr globals hasattr hash help hex id input int isinstance
    issubclass iter len license list locals map max memoryview min next object oct open ord pow
    print property quit range repr reversed round set setattr slice sorted staticmethod str sum
    super tuple type vars zip
    """
)

#: Names that the template of the module uses itself.
_OWN = frozenset({"fk", "np", "npt", "q", "T", "N_JOINTS", "JOINT_NAMES", "JOINT_LIMITS"})

_RESERVED = PYTHON_KEYWORDS | _BUILTINS | _OWN


@dataclass(frozen=True, slots=True)
class _Parameter:
    """A keyword argument of ``fk``; `default` is None where a caller must give a value."""

    name: str
    default: str | None
    original: str


def generate(robot: Robot) -> tuple[GeneratedFile, ...]:
    """Generate ``NAME.py`` (see `symdh.codegen.generate`)."""
    scope = Scope(_RESERVED.__contains__)
    symbols = scope.take_symbols([*robot.parameters, *robot.variables])
    listing = write_listing(forward_routine(robot), _FUNCTIONS, symbols, scope)
    facts = facts_of(robot)
    parameters = [
        _Parameter(
            name=symbols[parameter],
            default=literal(robot.values[parameter]) if parameter in robot.values else None,
            original=comment_text(parameter.name),
        )
        for parameter in robot.parameters
    ]
    stem = file_stem(robot.name)
    text = render(
        "python/module.py.jinja",
        stem=stem,
        facts=facts,
        joint_lines=facts.joint_table("q[..., {}]"),
        parameters=parameters,
        required=[parameter for parameter in parameters if parameter.default is None],
        joint_names=[f'"{joint.name}"' for joint in facts.joints],
        joint_limits=[_limits(joint.limits) for joint in facts.joints],
        locals=[*_reads(facts, listing, symbols), *listing.locals],
        entries=[entry for entry in listing.entries if entry.text != "0.0"],
    )
    return (GeneratedFile(f"{stem}.py", text),)


def _reads(facts: Facts, listing: Listing, symbols: Mapping[Symbol, str]) -> list[Local]:
    """Return the locals that joint variables are read into."""
    return [
        Local(symbols[joint.symbol], f"q[..., {place}]")
        for place, joint in enumerate(facts.joints)
        if joint.symbol in listing.inputs
    ]


def _limits(limits: tuple[str, str] | None) -> str:
    return f"({', '.join(limits)})" if limits else "None"
