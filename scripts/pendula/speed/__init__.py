"""Speed against error: this project's solvers and other people's on the paper's cases."""
