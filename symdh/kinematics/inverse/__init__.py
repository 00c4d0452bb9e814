"""Inverse kinematics: equations from moved links, rules, and a tree of branches.

`symdh.kinematics.inverse.inverse.inverse_kinematics` does all of it. Nothing is imported here: most
commands have no use for it.
"""
