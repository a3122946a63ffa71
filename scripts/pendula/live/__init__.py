"""The page that integrates the cases of the paper in a browser."""
