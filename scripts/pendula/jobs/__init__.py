"""Jobs that call the general rooms of `replication` with what these must know of the paper."""
