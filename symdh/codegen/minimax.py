"""Coefficients of sine and cosine in generated C; tools/fit_sincos.py writes this file.

For an angle x = k pi/2 + r with abs(r) <= pi/4, and z = r**2:
sin r = r + r z (S0 + S1 z + ...), cos r = 1 - z/2 + z**2 (C0 + C1 z + ...).
"""

from __future__ import annotations

#: In three; integers times a part of 33 bits are exact.
DOUBLE_HALF_PI = (
    1.5707963267341256,
    6.077100506303966e-11,
    2.0222662487959506e-21,
)

#: Relative error at most 3.7e-18.
DOUBLE_SIN = (
    -0.1666666666666663,
    0.00833333333332184,
    -0.00019841269829358525,
    2.7557313538512027e-06,
    -2.505073438869179e-08,
    1.5895433242910503e-10,
)

#: Error at most 4.8e-20.
DOUBLE_COS = (
    0.0416666666666666,
    -0.0013888888888874474,
    2.4801587289671445e-05,
    -2.755731440097008e-07,
    2.0875729268209167e-09,
    -1.1359933328297211e-11,
)

#: In three; integers times a part of 15 bits are exact.
FLOAT_HALF_PI = (
    1.57073974609375,
    5.657970905303955e-05,
    9.92093629470503e-10,
)

#: Relative error at most 4.0e-9.
FLOAT_SIN = (
    -0.16666655242443085,
    0.008332189172506332,
    -0.0001951829035533592,
)

#: Error at most 1.1e-10.
FLOAT_COS = (
    0.04166664555668831,
    -0.00138873013202101,
    2.4430670237052254e-05,
)
