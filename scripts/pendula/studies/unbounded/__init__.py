"""The infinite chain: only its sites in motion are integrated.

From the bottom: `sums` (the unknowns), `bulk` (the states behind the fronts), `transfer`,
`extremes` and `thermal` (the thermal states that they are compared with, and their largest
amplitudes), `active_sites` (a long run on the sites in motion), `front` and `transverse` (the
predicted speeds of the two fronts), `long_runs` (ensembles), `measured` (growth of norms, speeds,
states); `settings` holds the choices of the configuration.
"""
