"""An article on a replication, from one source as PDF, as a page and as Markdown."""
