"""What a run made, compared with the accepted baseline: numbers, pictures, and a page of both."""
