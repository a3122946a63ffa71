"""The chain without ends: only its sites in motion are integrated.

From the bottom: `bulk` (the state behind the front), `transfer`, `thermal` and `extremes` (the
thermal states that it is compared with, and their largest amplitudes), `active_sites` (a long run
on the sites in motion), `front` (the speed of linear spreading, and measured speeds), `long_runs`
(ensembles as datasets, how their norms grow, and maxima over half-widths and time windows);
`settings` says what is run.
"""
