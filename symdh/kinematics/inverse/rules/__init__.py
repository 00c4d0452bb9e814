"""The rules that solve for an unknown, one a file."""
