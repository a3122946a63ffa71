"""The report of a run as one page of HTML: its document, its words, its results, its page."""
