"""Jobs that call the general functions of `replication` with data of the paper."""
