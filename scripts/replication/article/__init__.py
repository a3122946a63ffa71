"""An article on a replication, made from one source as PDF, HTML page and Markdown."""
