"""What Newton's equations (1) do where the amplitude equations (4) approximate them."""
