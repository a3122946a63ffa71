"""What is made of cases and sweeps that a user brings: checks, figures and a page.

It stands above the studies and uses them, since a user asks of a case what the studies ask of the
paper's: until when it can be trusted, and what the theorems say of it.
"""
