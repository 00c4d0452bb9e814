"""Documents and results as LaTeX, terminal text and JSON. `formats` lists the document formats."""
