// Formulas are those that the pages mark, and no others; pages are plain without MathJax.
window.MathJax = {
  messageStyle: 'none',
  showMathMenu: false,
  tex2jax: {
    inlineMath: [['\\(', '\\)']],
    displayMath: [['\\[', '\\]']],
    processEscapes: true,
    ignoreClass: '.*',
    processClass: 'arithmatex',
  },
  SVG: {scale: 86},
};
