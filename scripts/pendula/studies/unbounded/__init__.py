"""The infinite chain: only its sites in motion are integrated.

Modules, each based on the ones before: `sums` (the unknowns), `bulk` (the states behind the
fronts), `transfer` and `thermal` (thermal states, for comparison), `active_sites` (a long run on
the sites in motion), `front` (the predicted speed of the first front), `long_runs` (ensembles),
`measured` (speeds, powers, the law of growth), `transverse` (the predicted speed of the second
front), `noise` (the second front with noise), `variations` (all numbers of long runs, with other
choices); `settings` has the choices of the configuration.
"""
