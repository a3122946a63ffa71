"""The chain without ends: only its sites in motion are integrated.

From the bottom: `window` (the sites in motion), `checkpoint`, `spread` (a long run in pieces),
`members` (ensembles), `window_map` (maxima over windows), `linear_front` (the speed of linear
spreading), `fronts` (measured speeds), `sea` (the state behind the front), `thermal` (what it is
compared with), `powers` (growth laws), `dataset`, `thermal_dataset`, `scale`; `studies` says what
is run.
"""
