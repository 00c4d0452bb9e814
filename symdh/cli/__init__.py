"""The command line: reads options, calls one function, prints and writes what comes back."""
