"""The Python face: robots that can be asked, results that show themselves in a notebook."""
