"""Numbers for symbols as Python users give them."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from sympy import Expr, Rational, Symbol

from symdh.table.names import canonical_name

#: What numbers may be keyed by, and be: ``{"a1": 0.5}`` or ``{Symbol("a1", real=True): half}``.
Values = Mapping[str, float] | Mapping[Symbol, Expr] | Mapping[str | Symbol, float | Expr]
NO_VALUES: Values = MappingProxyType({})


def exact_values(values: Values) -> dict[Symbol, Expr]:
    """Return numbers as sympy's exact ones, by symbol."""
    return {
        Symbol(canonical_name(key), real=True) if isinstance(key, str) else key: (
            value if isinstance(value, Expr) else Rational(value)
        )
        for key, value in values.items()
    }
