"""What a replication of any paper needs: claims and verdicts, accepted results, report, archive."""
