"""Documents and results as LaTeX, Typst, HTML, text and JSON; `formats` lists the documents' formats."""
