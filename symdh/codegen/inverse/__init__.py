"""Closed-form inverse kinematics as code: the steps of a solution as a program of branches.

`found` searches the closed form, `steps` turns its steps into nodes, `placing` orders these into a
`program` that belongs to no language, and `writing` writes that program with a language's names;
the templates of the language lay it out. C and C++ have one template in several dialects
(`dialect`); what compiled languages have in common is in `compiled`. `judging` looks at the answers
of code that was run.
"""
