// Every formula carries its LaTeX; KaTeX typesets it once, when the page is read.
"use strict";
for (const element of document.querySelectorAll("[data-tex]"))
  katex.render(element.dataset.tex, element, {
    displayMode: element.classList.contains("display"),
    throwOnError: false,
    strict: "error",
  });
