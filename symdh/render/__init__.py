"""Documents and results in LaTeX, Typst, HTML, text, JSON. `formats` lists the document formats."""
