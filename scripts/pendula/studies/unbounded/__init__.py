"""The infinite chain: only its sites in motion are integrated.

From the bottom: `bulk` (the state behind the front), `transfer`, `extremes` and `thermal` (the
thermal states that it is compared with, and their largest amplitudes), `active_sites` (a long run
on the sites in motion), `front` (the predicted speed), `long_runs` (ensembles, and maxima over
half-widths and time windows), `measured` (growth of norms, speeds, the bulk behind the front);
`settings` holds the choices of the configuration.
"""
