"""How the name of a symbol splits into a letter and a subscript: theta1, L_tool, errno."""

from __future__ import annotations

import re

#: Greek letters that a table may spell out or type; the key is the canonical spelling.
GREEK = {
    "alpha": "α",
    "beta": "β",
    "gamma": "γ",
    "delta": "δ",
    "epsilon": "ε",
    "zeta": "ζ",
    "eta": "η",
    "theta": "θ",
    "iota": "ι",
    "kappa": "κ",
    "lambda": "λ",
    "mu": "μ",
    "nu": "ν",
    "xi": "ξ",
    "omicron": "ο",
    "pi": "π",
    "rho": "ρ",
    "sigma": "σ",
    "tau": "τ",
    "upsilon": "υ",
    "phi": "φ",
    "chi": "χ",
    "psi": "ψ",
    "omega": "ω",
    "Gamma": "Γ",
    "Delta": "Δ",
    "Theta": "Θ",
    "Lambda": "Λ",
    "Xi": "Ξ",
    "Pi": "Π",
    "Sigma": "Σ",
    "Upsilon": "Υ",
    "Phi": "Φ",
    "Psi": "Ψ",
    "Omega": "Ω",
}


def split_name(name: str) -> tuple[str, str]:
    """Split a symbol's name into its letter (or word) and its subscript.

    ``theta1`` -> ``("theta", "1")``, ``L_tool`` -> ``("L", "tool")``, ``beta`` -> ``("beta", "")``.
    """
    found = re.fullmatch(r"([A-Za-z]+)_?(.*?)_*", name, re.DOTALL)
    if not found:
        return name, ""
    return found[1], found[2].replace("_", ",")
