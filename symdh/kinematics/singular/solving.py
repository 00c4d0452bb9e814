"""Where a factor vanishes, when it depends on one joint alone."""

from __future__ import annotations

from sympy import Expr, Integer, Symbol, acos, atan2, pi, sqrt

from symdh.kinematics.singular.trig_ring import Element, TrigRing


def joint_angles(ring: TrigRing, element: Element) -> list[int]:
    """Return the places in `TrigRing.angles` that an element depends on."""
    return [
        k
        for k in range(len(ring.angles))
        if any(powers[2 * k] or powers[2 * k + 1] for powers in element)
    ]


def zeros(ring: TrigRing, element: Element, variable: Symbol) -> tuple[Expr, ...]:
    """Return the values of a variable at which an element vanishes, if it is the only one in it.

    Angles are radians, up to whole turns. Empty when there is no such closed form: the element is
    of higher degree, or has other variables.

    Notes
    -----
    ``A c + B s + C = 0`` has the solutions ``atan2(B, A) +- acos(-C / sqrt(A^2 + B^2))``.
    """
    if variable in ring.others:
        return _slide_zero(ring, element, 2 * len(ring.angles) + ring.others.index(variable))
    (k,) = (k for k, angle in enumerate(ring.angles) if variable in angle.free_symbols)
    parts = _linear_parts(ring, element, (2 * k, 2 * k + 1))
    if parts is None:
        return ()
    gear = ring.angles[k].coeff(variable)
    return tuple(angle / gear for angle in _angles(*parts))


def _slide_zero(ring: TrigRing, element: Element, generator: int) -> tuple[Expr, ...]:
    parts = _linear_parts(ring, element, (generator,))
    return () if parts is None else (-parts[-1] / parts[0],)


def _linear_parts(
    ring: TrigRing, element: Element, generators: tuple[int, ...]
) -> list[Expr] | None:
    """Return the coefficients of some generators, then the rest; None where it is not linear."""
    parts = [ring.ring.zero] * (len(generators) + 1)
    for powers, coefficient in element.terms():
        own = [powers[g] for g in generators]
        if sum(own) > 1:
            return None
        place = own.index(1) if 1 in own else len(generators)
        rest = tuple(0 if g in generators else p for g, p in enumerate(powers))
        parts[place] = parts[place] + ring.ring.from_dict({rest: coefficient})
    return [ring.expression(part) for part in parts]


def _angles(a: Expr, b: Expr, c: Expr) -> tuple[Expr, ...]:
    """Solve ``a cos x + b sin x + c = 0``."""
    if c.is_zero and b.is_zero:
        return (-pi / 2, pi / 2)
    if c.is_zero and a.is_zero:
        return (Integer(0), pi)
    if c.is_zero:
        first = atan2(-a, b)
        return (first, first + pi)
    if b.is_zero and c in (a, -a):
        return (pi,) if c == a else (Integer(0),)
    if a.is_zero and c in (b, -b):
        return (-pi / 2,) if c == b else (pi / 2,)
    middle, half = atan2(b, a), acos(-c / sqrt(a**2 + b**2))
    return (middle + half, middle - half)
