"""One file to deposit: code, environment, datasets and figures, with checksums and metadata."""
