"""The article on this replication, from one source as PDF, as a page and as Markdown."""
