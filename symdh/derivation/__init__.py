"""Results -> a document of typed blocks, independent of any output format.

`symdh.derivation.derive.derive` makes the whole document. Nothing is imported here: a command that
shows one transform has no use for the chapters.
"""
