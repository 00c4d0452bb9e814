"""Inverse kinematics in closed form: equations from moved links, rules, and a tree of branches."""
