"""The report of a run as one page of HTML: a module a section, and what draws the page."""
