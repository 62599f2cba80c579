"""From verdicts to pages: pure functions that turn claims and evidence into HTML, Markdown and SVG."""
