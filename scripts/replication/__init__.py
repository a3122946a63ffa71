"""Replication of any paper: claims and verdicts, accepted results, report, archive."""
